// SPDX-License-Identifier: MIT
#include "compiler/bytecode/curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace lsys {

namespace {

/// The slope of the line from a point to the next one.
double slope_between(const CurveKnot& from, const CurveKnot& to) {
    return (static_cast<double>(to.y) - static_cast<double>(from.y)) /
           (static_cast<double>(to.x) - static_cast<double>(from.x));
}

} // namespace

void set_slopes(std::span<CurveKnot> points) {
    const std::size_t last = points.size() - 1;
    points[0].slope = slope_between(points[0], points[1]);
    points[last].slope = slope_between(points[last - 1], points[last]);
    for (std::size_t i = 1; i < last; ++i) {
        const double slope_before = slope_between(points[i - 1], points[i]);
        const double slope_after = slope_between(points[i], points[i + 1]);
        const bool same_sign =
            (slope_before > 0.0 && slope_after > 0.0) || (slope_before < 0.0 && slope_after < 0.0);
        points[i].slope = same_sign ? (slope_before + slope_after) / 2.0 : 0.0;
    }
    for (std::size_t i = 0; i < last; ++i) {
        const double secant_slope = slope_between(points[i], points[i + 1]);
        if (secant_slope == 0.0) {
            points[i].slope = 0.0;
            points[i + 1].slope = 0.0;
            continue;
        }
        const double alpha = points[i].slope / secant_slope;
        const double beta = points[i + 1].slope / secant_slope;
        const double squared_length = alpha * alpha + beta * beta;
        if (squared_length > 9.0) {
            const double factor = 3.0 / std::sqrt(squared_length);
            points[i].slope *= factor;
            points[i + 1].slope *= factor;
        }
    }
}

float curve_value(std::span<const CurveKnot> points, float x) {
    if (std::isnan(x)) {
        return x;
    }
    if (x <= points.front().x) {
        return points.front().y;
    }
    if (x >= points.back().x) {
        return points.back().y;
    }
    const auto after =
        std::upper_bound(points.begin(), points.end(), x,
                         [](float value, const CurveKnot& point) { return value < point.x; });
    const CurveKnot& a = *(after - 1);
    const CurveKnot& b = *after;
    const double width = static_cast<double>(b.x) - static_cast<double>(a.x);
    const double t = (static_cast<double>(x) - static_cast<double>(a.x)) / width;
    const double s = 1.0 - t;
    const double from = (1.0 + 2.0 * t) * s * s * static_cast<double>(a.y);
    const double to = t * t * (3.0 - 2.0 * t) * static_cast<double>(b.y);
    const double bend = t * s * s * width * a.slope - t * t * s * width * b.slope;
    return static_cast<float>(from + to + bend);
}

} // namespace lsys
