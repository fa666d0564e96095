// SPDX-License-Identifier: MIT
// Exponential function, logarithm and power from additions, multiplications, divisions and square
// roots alone, so that results are equal on every machine, as in trigonometry.h. The error is below
// 0.52 units in the last place, so a result that is a binary64 is exact: power(3, 5) = 243. NaN,
// infinities and zeros count as in IEEE 754-2019, section 9.2.1.
#pragma once

namespace lsys {

/// e to the power of `exponent`.
[[nodiscard]] double exponential(double exponent);

/// The natural logarithm; NaN for negative numbers.
[[nodiscard]] double logarithm(double number);

/// The logarithm to base 2 and the power of 2, with an error below two units in the last place.
[[nodiscard]] double binary_logarithm(double number);
[[nodiscard]] double power_of_two(double exponent);

/// `base` to the power of `exponent`; NaN if `base` is negative and `exponent` not whole.
[[nodiscard]] double power(double base, double exponent);

} // namespace lsys
