// SPDX-License-Identifier: MIT
// Compares the exact functions with mpmath: checksums of 1,020,000 results, which
// exact_functions_checksums.py prints, and single results that are hard to round.
#include "runtime/base/exact_functions.h"
#include "runtime/base/slow_functions.h"
#include "runtime/base/wide_fixed_point.h"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

using namespace lsys;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The generator of exact_functions_checksums.py (Steele, Lea & Flood 2014).
class SplitMix {
public:
    explicit SplitMix(std::uint64_t seed) : state_(seed) {}

    /// A number of either sign with a binary exponent from low to high.
    double number(int low, int high) {
        const std::uint64_t bits = next();
        const auto range = static_cast<std::uint64_t>(high - low + 1);
        const int exponent = low + static_cast<int>(next() % range);
        return std::bit_cast<double>((bits >> 63U) << 63U |
                                     static_cast<std::uint64_t>(exponent + 1023) << 52U |
                                     (bits & ((std::uint64_t{1} << 52U) - 1)));
    }

private:
    std::uint64_t next() {
        state_ += 0x9E3779B97F4A7C15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }

    std::uint64_t state_;
};

template <typename Function>
std::uint64_t checksum(int count, std::uint64_t seed, const Function& function) {
    SplitMix numbers(seed);
    std::uint64_t sum = 0;
    for (int i = 0; i < count; ++i) {
        sum = sum * 31 + std::bit_cast<std::uint64_t>(function(numbers));
    }
    return sum;
}

/// Equal, with the sign of a zero.
bool same(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

} // namespace

TEST_CASE("exact functions have the checksums of mpmath's results") {
    constexpr int kCount = 200000;
    CHECK(checksum(kCount, 1, [](SplitMix& n) { return exact_sine(n.number(-40, 40)); }) ==
          0x07BF48A6E14BBF9BU);
    CHECK(checksum(kCount, 2, [](SplitMix& n) { return exact_cosine(n.number(-40, 40)); }) ==
          0x304CD79D0F8FF7FFU);
    CHECK(checksum(kCount, 3, [](SplitMix& n) {
              return exact_sine_of_degrees(n.number(-80, 8));
          }) == 0xA9671E370E371CBEU);
    CHECK(checksum(kCount, 4, [](SplitMix& n) {
              return exact_cosine_of_degrees(n.number(-80, 8));
          }) == 0xCB4A9D561534F28CU);
    CHECK(checksum(kCount, 5, [](SplitMix& n) { return exact_exp(n.number(-60, 8)); }) ==
          0x78FA8111B50721C7U);
    // Arc tangents are 20 times slower; the sum of fewer results is enough.
    CHECK(checksum(20000, 6, [](SplitMix& n) {
              const double y = n.number(-90, 90);
              return exact_atan2(y, n.number(-20, 20));
          }) == 0x6F372D2E9C84A25EU);
}

TEST_CASE("fast and slow results agree where both are made") {
    SplitMix numbers(7);
    for (int i = 0; i < 20000; ++i) {
        const double x = numbers.number(-20, -1);
        const WideFixedPoint fixed = WideFixedPoint::from(std::abs(x));
        REQUIRE(same(exact_sine(x), std::copysign(rounded(slow_sine(fixed), 0), x)));
        REQUIRE(same(exact_cosine(x), rounded(slow_cosine(fixed), 0)));
        REQUIRE(same(exact_exp(x), slow_exp(x)));
    }
}

TEST_CASE("results that are hard to round are right") {
    // Worst cases of Lefevre & Muller (2001) and arguments near multiples of pi/2.
    CHECK(exact_sine(0x1.e0000000001c2p-20) == 0x1.dfffffffff02ep-20);
    CHECK(exact_sine(0x1.598bae9e632f6p-7) == 0x1.598a0aea48996p-7);
    CHECK(exact_cosine(0x1.8000000000009p-23) == 0x1.fffffffffff70p-1);
    CHECK(exact_exp(0x1.83d4bcdebb3f4p+2) == 0x1.ac50b409c8aeep+8);
    CHECK(exact_exp(-0x1.1p-53) == 0x1.fffffffffffffp-1);
    CHECK(exact_cosine(0x1.921fb54442d18p+0) == 0x1.1a62633145c07p-54);
    CHECK(exact_cosine(0x1.6ac5b262ca1ffp+849) ==
          -0x1.14ae72e6ba22fp-61); // nearest of all to a multiple of pi/2
    CHECK(exact_sine(0x1.fffffffffffffp+1023) == 0x1.452fc98b34e97p-8);
}

TEST_CASE("angles in degrees with a rational sine or cosine are exact") {
    for (const double turns : {-720.0, -360.0, 0.0, 360.0, 3.6e7}) {
        CHECK(exact_sine_of_degrees(turns + 30.0) == 0.5);
        CHECK(exact_sine_of_degrees(turns + 90.0) == 1.0);
        CHECK(exact_sine_of_degrees(turns + 180.0) == 0.0);
        CHECK(exact_sine_of_degrees(turns + 270.0) == -1.0);
        CHECK(exact_cosine_of_degrees(turns + 60.0) == 0.5);
        CHECK(exact_cosine_of_degrees(turns + 120.0) == -0.5);
        CHECK(same(exact_cosine_of_degrees(turns + 90.0), 0.0));
        CHECK(same(exact_cosine_of_degrees(turns + 270.0), 0.0));
        CHECK(exact_cosine_of_degrees(turns + 180.0) == -1.0);
    }
    CHECK(same(exact_sine_of_degrees(-180.0), -0.0));
    // sin(a) = cos(90 - a), also where the results are near 0.
    for (int i = -3000; i <= 3000; ++i) {
        const double degrees = i * 0.4375;
        REQUIRE(exact_sine_of_degrees(degrees) == exact_cosine_of_degrees(90.0 - degrees));
    }
}

TEST_CASE("special values of exact functions are those of IEEE 754") {
    constexpr double kPi = std::numbers::pi;
    CHECK(same(exact_sine(-0.0), -0.0));
    CHECK(exact_cosine(-0.0) == 1.0);
    CHECK(same(exact_sine(0x1p-1074), 0x1p-1074));
    CHECK(std::isnan(exact_sine(kInfinity)));
    CHECK(std::isnan(exact_cosine_of_degrees(-kInfinity)));
    CHECK(std::isnan(exact_sine_of_degrees(std::nan(""))));
    CHECK(exact_sine_of_degrees(0x1p-1074) == 0.0); // pi/180 of it rounds to 0
    CHECK(exact_sine_of_degrees(0x1p-1068) == 0x1p-1074);

    CHECK(exact_exp(0.0) == 1.0);
    CHECK(exact_exp(1.0) == std::numbers::e);
    CHECK(exact_exp(-kInfinity) == 0.0);
    CHECK(exact_exp(kInfinity) == kInfinity);
    CHECK(std::isnan(exact_exp(std::nan(""))));
    CHECK(exact_exp(0x1.62e42fefa39efp+9) == 0x1.fffffffffff2ap+1023); // the last finite one
    CHECK(exact_exp(0x1.62e42fefa39fp+9) == kInfinity);
    CHECK(exact_exp(-0x1.74910d52d3051p+9) == 0x1p-1074); // the last one above 0
    CHECK(exact_exp(-0x1.74910d52d3052p+9) == 0.0);

    CHECK(same(exact_atan2(0.0, 1.0), 0.0));
    CHECK(same(exact_atan2(-0.0, 0.0), -0.0));
    CHECK(exact_atan2(0.0, -0.0) == kPi);
    CHECK(exact_atan2(-0.0, -1.0) == -kPi);
    CHECK(exact_atan2(-3.0, 0.0) == -kPi / 2.0);
    CHECK(exact_atan2(1.0, kInfinity) == 0.0);
    CHECK(exact_atan2(1.0, -kInfinity) == kPi);
    CHECK(exact_atan2(kInfinity, 1.0) == kPi / 2.0);
    CHECK(exact_atan2(-kInfinity, kInfinity) == -kPi / 4.0);
    CHECK(exact_atan2(kInfinity, -kInfinity) == 0x1.2d97c7f3321d2p+1);
    CHECK(exact_atan2(1.0, 1.0) == kPi / 4.0);
    CHECK(exact_atan2(0x1p-1074, 0x1p+1023) == 0.0);
    CHECK(exact_atan2(0x1p-1074, 1.0) == 0x1p-1074);
    CHECK(exact_atan2(0x1.8p-1073, 0x1p+1) == 0x1p-1074); // just below 1.5 * 2^-1074
    CHECK(std::isnan(exact_atan2(std::nan(""), 1.0)));
}
