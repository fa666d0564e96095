// SPDX-License-Identifier: MIT
#include "compiler/growth/growth.h"
#include "grammar/base/exponentials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace lsys {

namespace {

Count from_log2(double log2) {
    return {0, true, log2};
}

/// log2(2^a + 2^b)
double add_logs(double a, double b) {
    const double greater = std::max(a, b);
    return greater + binary_logarithm(1.0 + power_of_two(std::min(a, b) - greater));
}

} // namespace

double Count::approximate_log2() const {
    if (exceeds) {
        return log2;
    }
    return value == 0 ? -std::numeric_limits<double>::infinity()
                      : binary_logarithm(to_double(value));
}

Count operator+(const Count& a, const Count& b) {
    if (!a.exceeds && !b.exceeds) {
        if (const std::optional<Uint128> sum = checked_add(a.value, b.value)) {
            return {*sum, false, 0.0};
        }
    }
    return from_log2(add_logs(a.approximate_log2(), b.approximate_log2()));
}

Count operator*(const Count& a, const Count& b) {
    const auto is_zero = [](const Count& count) { return !count.exceeds && count.value == 0; };
    if (is_zero(a) || is_zero(b)) {
        return {};
    }
    if (!a.exceeds && !b.exceeds) {
        if (const std::optional<Uint128> product = checked_multiply(a.value, b.value)) {
            return {*product, false, 0.0};
        }
    }
    return from_log2(a.approximate_log2() + b.approximate_log2());
}

std::string to_text(const Count& count) {
    if (count.exceeds) {
        return fmt::format("2^{:.0f}", count.log2);
    }
    std::string digits;
    Uint128 rest = count.value;
    for (int place = 0; rest != 0 || place == 0; ++place) {
        if (place != 0 && place % 3 == 0) {
            digits.push_back(',');
        }
        const Uint128Division division = divide(rest, 10);
        digits.push_back(static_cast<char>('0' + division.remainder));
        rest = division.quotient;
    }
    std::reverse(digits.begin(), digits.end());
    return digits;
}

} // namespace lsys
