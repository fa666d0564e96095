// SPDX-License-Identifier: MIT
// The tables of 64 powers of two and of 65 sines and cosines are computed at the first use, by the
// functions of slow_functions.h, in about 2 ms.
#include "runtime/base/exact_functions.h"

#include "grammar/base/double_double.h"
#include "grammar/base/trigonometry.h"
#include "runtime/base/slow_functions.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

namespace lsys {

namespace {

/// `value` rounded to binary64; nullopt if an error of up to `error` could change the rounding (Ziv
/// 1991).
std::optional<double> rounded(const DoubleDouble& value, double error) {
    const double up = value.high + (value.low + error);
    const double down = value.high + (value.low - error);
    return up == down ? std::optional(up) : std::nullopt;
}

DoubleDouble double_double(const WideFixedPoint& number) {
    const double high = lsys::rounded(number, 0);
    const WideFixedPoint back = WideFixedPoint::from(high);
    return {high, back < number || back.words == number.words ? lsys::rounded(number - back, 0)
                                                              : -lsys::rounded(back - number, 0)};
}

constexpr std::uint32_t kSteps = 64; // steps of a table: pi/256 rad = 45/64 degrees, or log(2)/64

struct Tables {
    std::array<DoubleDouble, kSteps + 1> sines;   // sines of i * pi/256
    std::array<DoubleDouble, kSteps + 1> cosines; // cosines of i * pi/256
    std::array<DoubleDouble, kSteps> powers;      // 2^(i/64)

    Tables() {
        for (std::uint32_t i = 0; i <= kSteps; ++i) {
            sines[i] = double_double(slow_sine(table_angle(i)));
            cosines[i] = double_double(slow_cosine(table_angle(i)));
        }
        for (std::uint32_t i = 0; i < kSteps; ++i) {
            powers[i] = double_double(table_power(i));
        }
    }
};

const Tables& tables() {
    static const Tables kTables;
    return kTables;
}

/// An angle: quarter * pi/2 + step * pi/256 + rest rad, with -64 <= step <= 64 and
/// |rest| <= pi/512 (1 + 2^-30).
struct TableAngle {
    std::uint32_t quarter = 0; // 0 to 3
    int step = 0;
    DoubleDouble rest;
    double error = 0.0; // max absolute error of `rest`
};

TableAngle angle_of_steps(double steps, DoubleDouble rest, double error) {
    constexpr std::int32_t kQuarter = 128; // steps per quarter turn
    const auto whole = static_cast<std::int32_t>(steps);
    const std::int32_t quarter = (whole + kQuarter / 2) >> 7;
    return {static_cast<std::uint32_t>(quarter) & 3U, whole - quarter * kQuarter, rest, error};
}

/// Precondition: |angle| <= 2^12 rad.
TableAngle table_angle_of(double angle) {
    // pi/256 = kHigh + kMiddle + kLow; the products of the first two, of 33 bits each, with the
    // number of steps, of at most 19 bits, are exact.
    constexpr double kHigh = 0x1.921fb544p-7;
    constexpr double kMiddle = 0x1.0b4611a6p-41;
    constexpr double kLow = 0x1.3198a2e037073p-76;
    constexpr double kStepsPerRadian = 0x1.45f306dc9c883p+6;
    const double steps = nearest_whole(angle * kStepsPerRadian);
    // The first difference is exact: a multiple of 2^-60, below 2^-6.
    const DoubleDouble rest = exact_sum(angle - steps * kHigh, -(steps * kMiddle));
    const DoubleDouble all = ordered_sum(rest.high, rest.low - steps * kLow);
    return angle_of_steps(steps, all, 0x1p-108);
}

/// Precondition: |degrees| <= 2^40; the rest of a step is 0 or at least 2^-60 degrees.
TableAngle table_angle_of_degrees(double degrees) {
    constexpr double kStep = 45.0 / 64.0;                                         // degrees
    constexpr DoubleDouble kRadians{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62}; // pi/180
    const double steps = nearest_whole(degrees * (1.0 / kStep));
    const double rest = degrees - steps * kStep; // exact
    const DoubleDouble product = exact_product(rest, kRadians.high);
    return angle_of_steps(steps, ordered_sum(product.high, product.low + rest * kRadians.low), 0.0);
}

struct TableSineCosine {
    DoubleDouble sine;
    DoubleDouble cosine;
};

/// Sine and cosine of step * pi/256 + rest, with a relative error below 2^-65 besides the error of
/// `rest`. The small terms are added in binary64: those of the cosine are below 2^-15.7 and have an
/// error below 2^-67; those of the sine are below 2^-24.6 and have an error below 2^-75. If `step`
/// is not 0, the sine is at least half of the table's sine of that step.
TableSineCosine sine_cosine_near_step(int step, const DoubleDouble& rest) {
    const Tables& known = tables();
    const auto index = static_cast<std::size_t>(step < 0 ? -step : step);
    const double sign = step < 0 ? -1.0 : 1.0;
    const DoubleDouble sine{sign * known.sines[index].high, sign * known.sines[index].low};
    const DoubleDouble& cosine = known.cosines[index];
    const double x = rest.high;
    const double square = x * x;
    const double sine_tail =
        rest.low * (1.0 - 0.5 * square) +
        x * square * (-1.0 / 6.0 + square * (1.0 / 120.0 - square * (1.0 / 5040.0)));
    const double cosine_tail =
        square * (-0.5 + square * (1.0 / 24.0 + square * (-1.0 / 720.0 + square / 40320.0))) -
        x * rest.low;
    const DoubleDouble small = ordered_sum(x, sine_tail); // sine of `rest`
    const auto combined = [&](const DoubleDouble& main, const DoubleDouble& other, double way) {
        const DoubleDouble product = exact_product(way * other.high, small.high);
        const DoubleDouble sum = exact_sum(main.high, product.high);
        const double low = sum.low + (product.low + main.low + main.high * cosine_tail +
                                      way * (other.high * small.low + other.low * small.high));
        return ordered_sum(sum.high, low);
    };
    return {combined(sine, cosine, 1.0), combined(cosine, sine, -1.0)};
}

ExactSineCosine turned(double sine, double cosine, std::uint32_t quarters) {
    return after_quarter_turns(ExactSineCosine{sine, cosine}, quarters);
}

std::optional<ExactSineCosine> fast_sine_cosine(const TableAngle& angle) {
    constexpr double kRelativeError = 0x1p-64;
    const TableSineCosine values = sine_cosine_near_step(angle.step, angle.rest);
    const auto round = [&](const DoubleDouble& value) {
        return rounded(value, std::abs(value.high) * kRelativeError + angle.error);
    };
    const std::optional<double> sine = round(values.sine);
    const std::optional<double> cosine = round(values.cosine);
    if (!sine || !cosine) {
        return std::nullopt;
    }
    return turned(*sine, *cosine, angle.quarter);
}

ExactSineCosine
slow_sine_cosine(const WideFixedPoint& angle, bool is_negative, std::uint32_t quarters) {
    const double sine = lsys::rounded(slow_sine(angle), 0);
    return turned(is_negative ? -sine : sine, lsys::rounded(slow_cosine(angle), 0), quarters);
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// 2^exponent. Precondition: 2^exponent is a normal binary64.
double power_of_two(std::int64_t exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52U);
}

/// Precondition: -708 <= x <= 709. The relative error before rounding is below 2^-66: only the
/// small terms, whose sum is below 2^-16, are added in binary64.
std::optional<double> fast_exp(double x) {
    // log(2)/64 = kHigh + kMiddle + kLow; the products of the first two, of 36 bits each, with the
    // number of steps, of at most 17 bits, are exact.
    constexpr double kHigh = 0x1.62e42fefap-7;
    constexpr double kMiddle = 0x1.cf79abc9ep-46;
    constexpr double kLow = 0x1.d9cc01f97b57ap-85;
    constexpr double kStepsPerUnit = 0x1.71547652b82fep+6;
    const double steps = nearest_whole(x * kStepsPerUnit);
    DoubleDouble rest = exact_sum(x - steps * kHigh, -(steps * kMiddle));
    rest = ordered_sum(rest.high, rest.low - steps * kLow);
    const double r = rest.high;
    const double tail =
        rest.low + rest.low * r +
        r * r *
            (0.5 +
             r * (1.0 / 6.0 +
                  r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0 + r * (1.0 / 5040.0))))));
    const DoubleDouble growth = ordered_sum(r, tail); // exp(rest) - 1
    const auto whole = static_cast<std::int64_t>(steps);
    const DoubleDouble& power = tables().powers[static_cast<std::size_t>(whole & (kSteps - 1))];
    const DoubleDouble product = exact_product(power.high, growth.high);
    const DoubleDouble sum = ordered_sum(power.high, product.high);
    const double low =
        sum.low + (product.low + power.low + (power.high * growth.low + power.low * growth.high));
    const double scale = power_of_two(whole >> 6);
    const std::optional<double> value = rounded(ordered_sum(sum.high, low), sum.high * 0x1p-65);
    return value ? std::optional(*value * scale) : std::nullopt;
}

} // namespace

ExactSineCosine exact_sine_cosine(double angle) {
    if (!std::isfinite(angle)) {
        return {kNaN, kNaN};
    }
    if (std::abs(angle) < 0x1p-27) { // the next terms are below half a unit in the last place
        return {angle, 1.0};
    }
    if (std::abs(angle) <= 0x1p12) {
        if (const auto fast = fast_sine_cosine(table_angle_of(angle))) {
            return *fast;
        }
    }
    const ReducedAngle reduced = reduce_radians(angle);
    return slow_sine_cosine(reduced.angle, reduced.is_negative, reduced.quarters);
}

double exact_sine(double angle) {
    return exact_sine_cosine(angle).sine;
}

double exact_cosine(double angle) {
    return exact_sine_cosine(angle).cosine;
}

ExactSineCosine exact_sine_cosine_of_degrees(double degrees) {
    constexpr double kFullTurn = 360.0;
    constexpr double kQuarterTurn = 90.0;
    if (!std::isfinite(degrees)) {
        return {kNaN, kNaN};
    }
    const double turn = std::abs(degrees) < kFullTurn ? degrees : std::fmod(degrees, kFullTurn);
    const double quarters = nearest_whole(turn / kQuarterTurn);
    const double rest = turn - quarters * kQuarterTurn; // exact: at most 45 degrees
    const auto quarter = static_cast<std::uint32_t>(static_cast<std::int32_t>(quarters)) & 3U;
    constexpr double kTiny = 0x1p-60; // degrees
    if (rest == 0.0) {
        const ExactSineCosine exact = turned(0.0, 1.0, quarter);
        return {exact.sine == 0.0 ? std::copysign(0.0, degrees) : exact.sine, exact.cosine + 0.0};
    }
    if (std::abs(rest) < kTiny) {
        const double sine = slow_small_sine_of_degrees(std::abs(rest));
        return turned(std::copysign(sine, rest), 1.0, quarter);
    }
    TableAngle angle = table_angle_of_degrees(rest);
    angle.quarter = (angle.quarter + quarter) & 3U;
    if (const auto fast = fast_sine_cosine(angle)) {
        return *fast;
    }
    return slow_sine_cosine(radians_of(std::abs(rest)), rest < 0.0, quarter);
}

double exact_sine_of_degrees(double degrees) {
    return exact_sine_cosine_of_degrees(degrees).sine;
}

double exact_cosine_of_degrees(double degrees) {
    return exact_sine_cosine_of_degrees(degrees).cosine;
}

double exact_exp(double exponent) {
    constexpr double kOverflow = 710.0;  // exp(709.79) is already infinite
    constexpr double kUnderflow = 746.0; // exp(-745.2) is already 0
    if (std::isnan(exponent)) {
        return kNaN;
    }
    if (exponent > kOverflow) {
        return std::numeric_limits<double>::infinity();
    }
    if (exponent < -kUnderflow) {
        return 0.0;
    }
    if (std::abs(exponent) < 0x1p-54) {
        return 1.0;
    }
    if (exponent >= -708.0 && exponent <= 709.0) {
        if (const auto fast = fast_exp(exponent)) {
            return *fast;
        }
    }
    return slow_exp(exponent);
}

double exact_atan2(double y, double x) {
    if (std::isnan(y) || std::isnan(x)) {
        return kNaN;
    }
    constexpr double kPi = std::numbers::pi;
    const bool is_behind = std::signbit(x);
    if (y == 0.0) {
        return std::copysign(is_behind ? kPi : 0.0, y);
    }
    if (std::isinf(y)) {
        const double angle = !std::isinf(x) ? kPi / 2.0
                             : is_behind    ? 0x1.2d97c7f3321d2p+1
                                            : kPi / 4.0;
        return std::copysign(angle, y);
    }
    if (std::isinf(x)) {
        return std::copysign(is_behind ? kPi : 0.0, y);
    }
    if (x == 0.0) {
        return std::copysign(kPi / 2.0, y);
    }
    return std::copysign(slow_atan2(std::abs(y), std::abs(x), is_behind), y);
}

} // namespace lsys
