// SPDX-License-Identifier: MIT
// Logarithms and powers of numbers near a few numbers, whose logarithms and powers are in tables
// (Tang 1990). The tables are computed at compile time, by series in double-double arithmetic.
#include "grammar/base/exponentials.h"

#include "grammar/base/double_double.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace lsys {

namespace {

constexpr int kSteps = 64; // of a table, per unit or per power of two

/// a / b with a relative error below 2^-100. Precondition: a and b are of moderate size.
constexpr DoubleDouble quotient(double a, const DoubleDouble& b) {
    const double rough = a / b.high;
    const DoubleDouble back = exact_product(rough, b.high);
    const double rest = (a - back.high) - back.low - rough * b.low;
    return ordered_sum(rough, rest / b.high);
}

constexpr DoubleDouble sum(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble high = exact_sum(a.high, b.high);
    return ordered_sum(high.high, high.low + (a.low + b.low));
}

/// The logarithm of a number from 0.7 to 1.43: 2 (f + f^3/3 + f^5/5 + ...) with f = (m-1) / (m+1).
constexpr DoubleDouble series_logarithm(double number) {
    const DoubleDouble f = quotient(number - 1.0, exact_sum(number, 1.0)); // at most 0.18
    const DoubleDouble square = product(f, f);
    DoubleDouble series;
    for (int n = 47; n >= 1; n -= 2) {
        series = sum(product(series, square), quotient(1.0, {static_cast<double>(n), 0.0}));
    }
    const DoubleDouble half = product(f, series);
    return {2.0 * half.high, 2.0 * half.low};
}

constexpr DoubleDouble kLog2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

/// 2^(i/64): the series of the exponential function.
constexpr DoubleDouble series_power_of_two(int i) {
    const DoubleDouble exponent = product(kLog2, {static_cast<double>(i) / kSteps, 0.0});
    DoubleDouble series{1.0, 0.0};
    for (int n = 30; n >= 1; --n) {
        const DoubleDouble part = product(exponent, quotient(1.0, {static_cast<double>(n), 0.0}));
        series = sum(DoubleDouble{1.0, 0.0}, product(part, series));
    }
    return series;
}

constexpr int kFirst = 45; // 45/64 < sqrt(1/2)
constexpr int kLast = 91;  // 91/64 > sqrt(2)

struct Tables {
    std::array<DoubleDouble, kLast - kFirst + 1> logarithms{}; // of i/64
    std::array<double, kLast - kFirst + 1> inverses{};         // of i/64
    std::array<DoubleDouble, kSteps> powers{};                 // 2^(i/64)
};

constexpr Tables kTables = [] {
    Tables tables;
    for (int i = kFirst; i <= kLast; ++i) {
        const auto row = static_cast<std::size_t>(i - kFirst);
        tables.logarithms[row] = series_logarithm(static_cast<double>(i) / kSteps);
        tables.inverses[row] = kSteps / static_cast<double>(i);
    }
    for (int i = 0; i < kSteps; ++i) {
        tables.powers[static_cast<std::size_t>(i)] = series_power_of_two(i);
    }
    return tables;
}();

constexpr int kMantissaBits = 52;
constexpr int kBias = 1023;

/// A positive number as part * 2^exponent, with a part from sqrt(1/2) to sqrt(2).
struct Scaled {
    double part = 1.0;
    int exponent = 0;
};

Scaled scaled(double number) {
    int exponent = 0;
    if (number < std::numeric_limits<double>::min()) { // subnormal
        number *= 0x1p54;
        exponent = -54;
    }
    constexpr std::uint64_t kMantissa = (std::uint64_t{1} << kMantissaBits) - 1;
    const auto bits = std::bit_cast<std::uint64_t>(number);
    exponent += static_cast<int>(bits >> kMantissaBits) - kBias;
    const double part =
        std::bit_cast<double>((bits & kMantissa) | (std::uint64_t{kBias} << kMantissaBits));
    return part > std::numbers::sqrt2 ? Scaled{0.5 * part, exponent + 1} : Scaled{part, exponent};
}

/// The logarithm of a number from sqrt(1/2) to sqrt(2), with a relative error below 2^-63: with the
/// nearest c = i/64 of the table, it is log(c) + log(1 + z), z = (number - c) / c.
DoubleDouble precise_logarithm(double number) {
    const double i = nearest_whole(number * kSteps);
    const double c = i * (1.0 / kSteps);
    const double difference = number - c; // exact, at most 2^-7
    // z = high + low. The first has 26 bits and c has 7, so that their product is exact.
    const auto row = static_cast<std::size_t>(static_cast<int>(i) - kFirst);
    const double inverse = kTables.inverses[row];
    constexpr double kVeltkampFactor = 0x1p27 + 1.0;
    const double rough = difference * inverse;
    const double scaled_rough = kVeltkampFactor * rough;
    const double high = scaled_rough - (scaled_rough - rough);
    const double low = (difference - high * c) * inverse;
    // -z^2/2: the square of `high` is exact; the other terms are below 2^-34 z.
    const double z = high + low; // at most 0.0113
    const double square = z * z;
    const double tail =
        z * square *
        (((1.0 / 3.0 - z * (1.0 / 4.0)) + square * (1.0 / 5.0 - z * (1.0 / 6.0))) +
         square * square * ((1.0 / 7.0 - z * (1.0 / 8.0)) + square * (1.0 / 9.0 - z * 0.1)));
    const DoubleDouble& table = kTables.logarithms[row];
    const DoubleDouble first = ordered_sum(high, -0.5 * high * high);
    const DoubleDouble all = exact_sum(table.high, first.high);
    return ordered_sum(
        all.high, all.low + (first.low + table.low + (tail + (low - low * (high + 0.5 * low)))));
}

/// The logarithm of a positive finite number, with a relative error below 2^-62.
DoubleDouble precise_logarithm(const Scaled& number) {
    // log(2) = kHigh + kLow; kHigh has 33 bits, so that its product with an exponent is exact.
    constexpr double kHigh = 0x1.62e42feep-1;
    constexpr double kLow = 0x1.a39ef35793c76p-33;
    const DoubleDouble part = precise_logarithm(number.part);
    const DoubleDouble all = exact_sum(number.exponent * kHigh, part.high);
    return ordered_sum(all.high, all.low + (part.low + number.exponent * kLow));
}

/// e to the power of a sum. Precondition: |exponent.high| <= 750.
double exponential_of(const DoubleDouble& exponent) {
    // log(2)/64 = kHigh + kLow; kHigh has 36 bits, so that its product with the number of steps, of
    // at most 17 bits, is exact.
    constexpr double kHigh = 0x1.62e42fefap-7;
    constexpr double kLow = 0x1.cf79abc9e3b3ap-46;
    constexpr double kStepsPerUnit = 0x1.71547652b82fep+6;
    const double steps = nearest_whole(exponent.high * kStepsPerUnit);
    const double high = exponent.high - steps * kHigh; // exact
    const double low = exponent.low - steps * kLow;
    const double r = high + low; // at most 0.0055
    const double square = r * r;
    const double growth =
        high +
        (low + square * ((0.5 + r * (1.0 / 6.0)) + square * ((1.0 / 24.0 + r * (1.0 / 120.0)) +
                                                             square * (1.0 / 720.0)))); // e^r - 1
    const auto whole = static_cast<int>(steps);
    const DoubleDouble& power = kTables.powers[static_cast<std::size_t>(whole & (kSteps - 1))];
    const double value = power.high + (power.low + power.high * growth);
    const int scale = whole >> 6;
    if (scale < -kBias + 2 || scale > kBias - 1) { // the result may be subnormal or infinite
        return std::ldexp(value, scale);
    }
    return value *
           std::bit_cast<double>(static_cast<std::uint64_t>(scale + kBias) << kMantissaBits);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMaxExponent = 710.0;  // e^709.79 is infinite
constexpr double kMinExponent = -746.0; // e^-745.2 is 0

bool is_positive(double number) {
    return number > 0.0 && number < kInfinity;
}

/// power() for a base of 0, infinity or NaN, an exponent of infinity or NaN, or a negative base.
double special_power(double base, double exponent) {
    const double size = std::abs(base);
    if (std::isnan(base) || std::isnan(exponent)) {
        return base + exponent;
    }
    if (std::isinf(exponent)) {
        return size == 1.0 ? 1.0 : (size > 1.0) == (exponent > 0.0) ? kInfinity : 0.0;
    }
    const bool is_odd = std::abs(std::fmod(exponent, 2.0)) == 1.0;
    const double sign = std::signbit(base) && is_odd ? -1.0 : 1.0;
    if (!is_positive(size)) {
        return sign * ((size == 0.0) == (exponent < 0.0) ? kInfinity : 0.0);
    }
    const bool is_whole = std::fmod(exponent, 1.0) == 0.0;
    return is_whole ? sign * power(size, exponent) : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

double exponential(double exponent) {
    if (!(exponent >= kMinExponent && exponent <= kMaxExponent)) {
        return std::isnan(exponent) ? exponent : exponent > 0.0 ? kInfinity : 0.0;
    }
    return exponential_of({exponent, 0.0});
}

double logarithm(double number) {
    if (!is_positive(number)) {
        return number == 0.0  ? -kInfinity
               : number < 0.0 ? std::numeric_limits<double>::quiet_NaN()
                              : number; // infinity or NaN
    }
    return precise_logarithm(scaled(number)).high;
}

double binary_logarithm(double number) {
    if (!is_positive(number)) {
        return logarithm(number);
    }
    const Scaled known = scaled(number);
    return known.exponent + precise_logarithm(known.part).high / std::numbers::ln2;
}

double power_of_two(double exponent) {
    return power(2.0, exponent);
}

double power(double base, double exponent) {
    if (base == 1.0 || exponent == 0.0) {
        return 1.0;
    }
    if (!is_positive(base) || !(std::abs(exponent) < kInfinity)) {
        return special_power(base, exponent);
    }
    const DoubleDouble logarithm = precise_logarithm(scaled(base));
    const double rough = logarithm.high * exponent;
    if (!(rough >= kMinExponent && rough <= kMaxExponent)) {
        return rough > 0.0 ? kInfinity : 0.0;
    }
    const DoubleDouble exact = exact_product(logarithm.high, exponent);
    return exponential_of({exact.high, exact.low + logarithm.low * exponent});
}

} // namespace lsys
