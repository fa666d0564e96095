// SPDX-License-Identifier: MIT
// Compares the functions of exponentials.h with the standard library in long double.
#include "grammar/base/exponentials.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

using namespace lsys;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr bool kHasLongerDouble = std::numeric_limits<long double>::digits > 53;

/// The difference of `mine` from `exact` in units in the last place.
double error_of(double mine, long double exact) {
    const auto rounded = static_cast<double>(exact);
    if (!std::isfinite(rounded) || std::fpclassify(rounded) == FP_SUBNORMAL) {
        return mine == rounded ? 0.0 : std::abs(mine - rounded) <= 5e-324 ? 0.6 : 1e9;
    }
    const double unit = std::abs(std::nextafter(rounded, kInfinity) - rounded);
    return static_cast<double>(std::abs(static_cast<long double>(mine) - exact) /
                               static_cast<long double>(unit));
}

bool is_same(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

std::uint64_t bits_of(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

} // namespace

TEST_CASE("exponential, logarithm and power have an error below 0.52 units in the last place") {
    if (!kHasLongerDouble) {
        return;
    }
    std::mt19937_64 random(1); // NOLINT(bugprone-random-generator-seed,cert-msc51-cpp)
    const auto between = [&random](double low, double high) {
        return low + (high - low) * (static_cast<double>(random() >> 11U) * 0x1p-53);
    };
    double of_exponential = 0.0;
    double of_logarithm = 0.0;
    double of_power = 0.0;
    for (int i = 0; i < 300'000; ++i) {
        const double x = between(-700.0, 700.0) * (i % 3 == 0 ? 1e-3 : 1.0);
        of_exponential = std::max(of_exponential,
                                  error_of(exponential(x), std::exp(static_cast<long double>(x))));
        const double near_one = between(0.5, 2.0);
        const double number = i % 2 == 0 ? near_one : std::ldexp(near_one, i % 2000 - 1000);
        of_logarithm = std::max(
            of_logarithm, error_of(logarithm(number), std::log(static_cast<long double>(number))));
        const double base = i % 2 == 0 ? between(0.0, 4.0) : std::ldexp(near_one, i % 200 - 100);
        const double exponent = between(-7.0, 7.0);
        of_power = std::max(of_power, error_of(power(base, exponent),
                                               std::pow(static_cast<long double>(base),
                                                        static_cast<long double>(exponent))));
    }
    CHECK(of_exponential < 0.52);
    CHECK(of_logarithm < 0.52);
    CHECK(of_power < 0.52);
}

TEST_CASE("powers that are binary64 are exact") {
    for (int base = 2; base <= 60; ++base) {
        double exact = 1.0;
        for (int exponent = 1; exact * base < 0x1p53; ++exponent) {
            exact *= base;
            CAPTURE(base, exponent);
            CHECK(power(base, exponent) == exact);
            CHECK(power(-base, exponent) == (exponent % 2 == 0 ? exact : -exact));
            CHECK(power(1.0 / 64.0, -exponent) == std::ldexp(1.0, 6 * exponent));
        }
    }
    for (int i = 1; i < 5000; ++i) {
        CHECK(power(static_cast<double>(i) * i, 0.5) == i);
    }
    CHECK(exponential(0.0) == 1.0);
    CHECK(exponential(1.0) == 0x1.5bf0a8b145769p+1);
    CHECK(exponential(-745.0) == 0x1p-1074);
    CHECK(logarithm(1.0) == 0.0);
    CHECK(logarithm(2.0) == 0x1.62e42fefa39efp-1);
    CHECK(power_of_two(-1074.0) == 0x1p-1074);
    CHECK(power_of_two(1023.0) == 0x1p1023);
    for (int exponent = -1074; exponent <= 1023; ++exponent) {
        CAPTURE(exponent);
        CHECK(binary_logarithm(std::ldexp(1.0, exponent)) == exponent);
        CHECK(power_of_two(exponent) == std::ldexp(1.0, exponent));
    }
    CHECK(std::abs(binary_logarithm(1.0 + 0x1p-40) * 0x1p40 - 0x1.71547652b82fep+0) < 1e-11);
}

TEST_CASE("exponentials of zeros, infinities and NaN are those of IEEE 754") {
    const std::array<double, 17> values{0.0,    -0.0, 1.0,       -1.0,       0.5,   -0.5,
                                        2.0,    -2.0, 3.0,       -3.0,       1e300, -1e300,
                                        1e-300, 1.5,  kInfinity, -kInfinity, kNaN};
    for (const double base : values) {
        for (const double exponent : values) {
            CAPTURE(base, exponent);
            const double expected = std::pow(base, exponent);
            const double mine = power(base, exponent);
            CHECK((is_same(mine, expected) ||
                   (std::isnormal(expected) && std::abs(mine / expected - 1.0) < 1e-15)));
        }
        CAPTURE(base);
        if (std::abs(base) > 1e5 || !std::isfinite(base) || base == 0.0) {
            CHECK(is_same(exponential(base), std::exp(base)));
            CHECK(
                ((std::isfinite(base) && base > 0.0) || is_same(logarithm(base), std::log(base))));
        }
        CHECK(std::isnan(logarithm(base)) == (std::isnan(base) || base < 0.0));
    }
}

TEST_CASE("exponentials have the same bits on every machine") {
    std::uint64_t hash = 0;
    const auto add = [&hash](double value) {
        hash = (hash ^ bits_of(value)) * 0x9e3779b97f4a7c15U;
        hash ^= hash >> 29U;
    };
    for (int i = 1; i <= 20'000; ++i) {
        const double x = i * 0.0123;
        add(exponential(x - 100.0));
        add(logarithm(x));
        add(power(x, 2.4));
        add(power(0.97, x));
    }
    CHECK(hash == 0xbf8b2c7778743e2bU);
}
