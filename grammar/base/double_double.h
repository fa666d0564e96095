// SPDX-License-Identifier: MIT
// Arithmetic on sums of two binary64, which have about 106 bits (Dekker 1971), and rounding to whole
// numbers without a function of the mathematical library.
#pragma once

namespace lsys {

/// high + low, with |low| at most half a unit in the last place of high.
struct DoubleDouble {
    double high = 0.0;
    double low = 0.0;
};

/// Exact sum. Precondition: |a| >= |b| or a = 0 (Dekker 1971).
[[nodiscard]] constexpr DoubleDouble ordered_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

/// Exact sum (Knuth 1969).
[[nodiscard]] constexpr DoubleDouble exact_sum(double a, double b) {
    const double sum = a + b;
    const double of_b = sum - a;
    return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// Exact product, if neither overflows nor underflows (Dekker 1971, by Veltkamp's splitting).
[[nodiscard]] constexpr DoubleDouble exact_product(double a, double b) {
    constexpr double kVeltkampFactor = 0x1p27 + 1.0;
    constexpr auto kHighHalf = [](double x) {
        const double scaled = kVeltkampFactor * x;
        return scaled - (scaled - x);
    };
    const double a_high = kHighHalf(a);
    const double a_low = a - a_high;
    const double b_high = kHighHalf(b);
    const double b_low = b - b_high;
    const double product = a * b;
    return {product,
            ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

/// The product with a relative error below 2^-101.
[[nodiscard]] constexpr DoubleDouble product(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = exact_product(a.high, b.high);
    return ordered_sum(high.high, high.low + (a.high * b.low + a.low * b.high));
}

/// A number of magnitude below 2^51 rounded to a whole number.
[[nodiscard]] inline double nearest_whole(double x) {
    constexpr double kShift = 0x1.8p52;
    return (x + kShift) - kShift;
}

} // namespace lsys
