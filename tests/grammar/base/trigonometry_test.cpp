// SPDX-License-Identifier: MIT
// Compares the trigonometry of runtime/base with the standard library in long double.
#include "grammar/base/trigonometry.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace lsys;

namespace {

/// Largest error of a function over 100,001 values from -limit to limit.
template <typename Mine, typename Exact>
double max_error(double limit, const Mine& mine, const Exact& exact) {
    double error = 0.0;
    for (int i = -50000; i <= 50000; ++i) {
        const double x = limit * i / 50000.0;
        const auto difference = static_cast<double>(static_cast<long double>(mine(x)) -
                                                    exact(static_cast<long double>(x)));
        error = std::max(error, std::isfinite(difference) ? std::abs(difference) : 1.0);
    }
    return error;
}

} // namespace

TEST_CASE("sine and cosine are those of the standard library") {
    for (const double limit : {1e-3, 0.8, 3.2, 100.0, 1e5}) {
        CAPTURE(limit);
        CHECK(max_error(
                  limit, [](double x) { return sine_cosine(x).sine; },
                  [](long double x) { return std::sin(x); }) < 2.5e-16);
        CHECK(max_error(
                  limit, [](double x) { return sine_cosine(x).cosine; },
                  [](long double x) { return std::cos(x); }) < 2.5e-16);
    }
    CHECK(sine_cosine(0.0).sine == 0.0);
    CHECK(sine_cosine(0.0).cosine == 1.0);
}

TEST_CASE("arc tangent and arc sine are those of the standard library") {
    for (const double x : {0.0, 1e-9, 0.1, 1.0, 7.0, 1e9}) {
        CAPTURE(x);
        CHECK(max_error(
                  3.0, [&](double y) { return arc_tangent(y, x); },
                  [&](long double y) { return std::atan2(y, static_cast<long double>(x)); }) <
              5e-16);
    }
    CHECK(max_error(1.0, arc_sine, [](long double x) { return std::asin(x); }) < 1e-15);
    CHECK(arc_tangent(0.0, 0.0) == 0.0);
    CHECK(arc_tangent(1e-300, 1.0) == 1e-300);
}
