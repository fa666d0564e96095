// SPDX-License-Identifier: MIT
// Arithmetic on vectors in binary64. Every product and sum is rounded by itself, in the order
// written here; the bits of answers are defined, so the order of operations is part of the
// definition.
#pragma once

#include "runtime/environment/environment.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace lsys {

[[nodiscard]] inline Vector3 plus(const Vector3& a, const Vector3& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
[[nodiscard]] inline Vector3 minus(const Vector3& a, const Vector3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline Vector3 times(const Vector3& a, double factor) {
    return {a[0] * factor, a[1] * factor, a[2] * factor};
}
[[nodiscard]] inline double dot(const Vector3& a, const Vector3& b) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}
[[nodiscard]] inline Vector3 cross(const Vector3& a, const Vector3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline double squared_length(const Vector3& a) {
    return dot(a, a);
}

/// Each component divided by the length; 0 0 0 if the square of the length is 0.
[[nodiscard]] inline Vector3 normalised(const Vector3& a) {
    const double length = std::sqrt(squared_length(a));
    return length > 0.0 ? Vector3{a[0] / length, a[1] / length, a[2] / length} : Vector3{};
}

[[nodiscard]] inline bool is_finite(const Vector3& a) {
    return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

/// std::floor() without a call of a library: the base instructions of x86-64 have none for it.
/// NaN stays NaN.
[[nodiscard]] inline double fast_floor(double value) {
    constexpr double kWhole = 0x1p52; // numbers from here on are whole
    if (!(std::abs(value) < kWhole)) {
        return value;
    }
    const auto towards_zero = static_cast<double>(static_cast<std::int64_t>(value));
    return towards_zero > value ? towards_zero - 1.0 : towards_zero;
}

/// The answer (number, x, y, z) in binary32, with 0 for -0 and infinity beyond the range.
inline void write_answer(double number, const Vector3& direction, float* answer) {
    constexpr auto kMax = static_cast<double>(std::numeric_limits<float>::max());
    const double bounded = std::abs(number) <= kMax ? number : std::copysign(HUGE_VAL, number);
    answer[0] = static_cast<float>(bounded) + 0.0F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        answer[axis + 1] = static_cast<float>(direction[axis]) + 0.0F;
    }
}

} // namespace lsys
