// SPDX-License-Identifier: MIT
#include "compiler/bytecode/curve.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <vector>

namespace lsys {

namespace {

std::vector<CurveKnot> curve(std::vector<CurveKnot> points) {
    set_slopes(points);
    return points;
}

} // namespace

TEST_CASE("a curve of two points is the line through them") {
    const std::vector<CurveKnot> line = curve({{0.0F, 1.0F}, {2.0F, 5.0F}});
    for (const float x : {0.0F, 0.25F, 1.0F, 1.5F, 2.0F}) {
        CHECK(curve_value(line, x) == 1.0F + 2.0F * x);
    }
    CHECK(curve_value(line, -3.0F) == 1.0F);
    CHECK(curve_value(line, 7.0F) == 5.0F);
    CHECK(curve_value(line, std::numeric_limits<float>::infinity()) == 5.0F);
    CHECK(std::isnan(curve_value(line, std::nanf(""))));
}

TEST_CASE("a curve passes through its points and stays between neighbouring ones") {
    const std::vector<CurveKnot> points = curve(
        {{0.0F, 0.0F}, {1.0F, 0.1F}, {1.5F, 4.0F}, {3.0F, 4.0F}, {4.0F, -1.0F}, {9.0F, 0.0F}});
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        CHECK(curve_value(points, points[i].x) == points[i].y);
        const float low = std::min(points[i].y, points[i + 1].y);
        const float high = std::max(points[i].y, points[i + 1].y);
        const bool rises = points[i].y < points[i + 1].y;
        float last = points[i].y;
        for (int k = 1; k <= 1000; ++k) {
            const float t = static_cast<float>(k) / 1000.0F;
            const float x = points[i].x + t * (points[i + 1].x - points[i].x);
            const float y = curve_value(points, x);
            CHECK(y >= low);
            CHECK(y <= high);
            CHECK((rises ? y >= last : y <= last));
            last = y;
        }
    }
}

TEST_CASE("slopes are those of Fritsch and Carlson") {
    const std::vector<CurveKnot> points =
        curve({{0.0F, 0.0F}, {1.0F, 0.0F}, {2.0F, 1.0F}, {3.0F, 3.0F}, {4.0F, 3.5F}});
    CHECK(points[0].slope == 0.0);
    CHECK(points[1].slope == 0.0);
    CHECK(points[2].slope == 1.5);
    CHECK(points[3].slope == 1.25);
    CHECK(points[4].slope == 0.5);
    // A steep point has (alpha, beta) = (10, 1), which the method scales to a circle of radius 3.
    const std::vector<CurveKnot> steep = curve({{0.0F, 0.0F}, {1.0F, 19.0F}, {2.0F, 20.0F}});
    CHECK(steep[1].slope == Approx(10.0 * 3.0 / std::hypot(10.0, 1.0)));
    CHECK(steep[2].slope == Approx(1.0 * 3.0 / std::hypot(10.0, 1.0)));
}

} // namespace lsys
