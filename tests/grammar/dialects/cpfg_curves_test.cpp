// SPDX-License-Identifier: MIT
// Tables of cpfg's functions, beside a direct evaluation of the spline.
#include "grammar/dialects/cpfg/curves.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

using namespace lsys;

namespace {

CpfgCurve curve_of(std::string_view function_file) {
    const CpfgView view = read_view("function: f.func 5\n", [&](std::string_view) {
        return Result<std::string>(std::string(function_file));
    });
    REQUIRE(view.curves.size() == 1);
    return view.curves[0];
}

/// Knot `j` of the clamped uniform knots of a cubic spline with `count` control points.
int knot(std::size_t count, int j) {
    const int last = static_cast<int>(count) - 1;
    return j < 4 ? 0 : j > last ? last - 2 : j - 3;
}

/// The basis function `k` of `order` at `u`, by the recursion of Cox and de Boor.
double basis(std::size_t count, int k, int order, double u) {
    if (order == 1) {
        return knot(count, k) <= u && u < knot(count, k + 1) ? 1.0 : 0.0;
    }
    double sum = 0.0;
    if (const int width = knot(count, k + order - 1) - knot(count, k); width != 0) {
        sum += (u - knot(count, k)) / width * basis(count, k, order - 1, u);
    }
    if (const int width = knot(count, k + order) - knot(count, k + 1); width != 0) {
        sum += (knot(count, k + order) - u) / width * basis(count, k + 1, order - 1, u);
    }
    return sum;
}

CurvePoint point_at(const std::vector<CurvePoint>& points, double part) {
    CurvePoint sum;
    const double u = part * static_cast<double>(points.size() - 3);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double weight = basis(points.size(), static_cast<int>(k), 4, u);
        sum.x += points[k].x * weight;
        sum.y += points[k].y * weight;
    }
    return sum;
}

/// y where x is within 0.001 of `x`, by halving the parameter's range.
double value_at(const std::vector<CurvePoint>& points, double x) {
    double low = 0.0;
    double high = 1.0;
    for (;;) {
        const double middle = (low + high) / 2.0;
        const CurvePoint found = point_at(points, middle);
        if (std::abs(found.x - x) <= 0.001) {
            return found.y;
        }
        (found.x > x ? high : low) = middle;
    }
}

} // namespace

TEST_CASE("a table of cpfg has the values of the spline") {
    const CpfgCurve curve = curve_of("fver 1 1\nname: leaf\nsamples: 10\nflip: off\npoints: 5\n"
                                     "0 0\n0.1 0.8 2\n0.5 1\n0.7 0.3\n1 0.5\n");
    CHECK(curve.points.size() == 6); // the second point counts twice
    const std::vector<double> table = curve_table(curve);
    REQUIRE(table.size() == 10);
    for (std::size_t i = 0; i < table.size(); ++i) {
        CHECK(table[i] ==
              Approx(value_at(curve.points, static_cast<double>(i) / 9.0)).margin(1e-9));
    }
}

TEST_CASE("the view file gives the samples of an older function file") {
    const CpfgCurve curve =
        curve_of("range: 0.0 1.0\npoints: 4\n0 0\n0.333 0.333\n0.667 0.667\n1 1\n");
    const std::vector<double> table = curve_table(curve);
    REQUIRE(table.size() == 5);
    for (std::size_t i = 0; i < table.size(); ++i) {
        CHECK(table[i] == Approx(static_cast<double>(i) / 4.0).margin(0.002));
    }
}

TEST_CASE("curves without a table, and damaged ones") {
    CHECK(curve_table(curve_of("fver 1 1\nsamples: 2\npoints: 4\n0 0\n0 0\n1 1\n1 1\n")).empty());
    CHECK(curve_table(curve_of("fver 1 1\nsamples: 1e9\npoints: 4\n0 0\n0 0\n1 1\n1 1\n")).size() ==
          5); // samples that the view file of curve_of() sets
    CHECK(curve_of("points: 3\n0 0\n1 nan\n2 2\n").points.empty());
    CHECK(curve_of("points: 2\n0 0 600\n1 1 600\n").points.empty()); // too many points
    // A curve that ends before x = 1.
    const CpfgCurve narrow = curve_of("samples: 5\npoints: 4\n0 0\n0.1 0.1\n0.2 0.2\n0.3 0.3\n");
    CHECK(curve_table(narrow).back() == Approx(0.3).margin(0.001));
}
