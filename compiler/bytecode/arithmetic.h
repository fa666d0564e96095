// SPDX-License-Identifier: MIT
// The arithmetic of expressions (docs/language.md section 4). Every value is an IEEE binary32. The
// operators + - * / and sqrt round correctly; other functions and powers are computed in binary64
// and rounded once. Constant folding and evaluation use these functions, so both give the same
// result. Angles are degrees.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cmath>

namespace lsys::arithmetic {

[[nodiscard]] constexpr float truth(bool holds) {
    return holds ? 1.0F : 0.0F;
}
[[nodiscard]] inline float logical_not(float x) {
    return truth(x == 0.0F);
}
/// NaN counts as true, since it differs from 0.
[[nodiscard]] inline float logical_and(float x, float y) {
    return truth(x != 0.0F && y != 0.0F);
}
[[nodiscard]] inline float logical_or(float x, float y) {
    return truth(x != 0.0F || y != 0.0F);
}

[[nodiscard]] float power(float x, float y);
/// Sine, cosine and tangent reduce their argument modulo 360 without error. Their results at
/// multiples of 90 are exact, and a zero among them is +0.
[[nodiscard]] float sine(float degrees);
[[nodiscard]] float cosine(float degrees);
[[nodiscard]] float tangent(float degrees);
[[nodiscard]] float arc_sine(float x);
[[nodiscard]] float arc_cosine(float x);
[[nodiscard]] float arc_tangent(float x);
/// The angle of the vector (x, y); the arguments have the order of std::atan2.
[[nodiscard]] float arc_tangent2(float y, float x);
[[nodiscard]] float exponential(float x);
[[nodiscard]] float logarithm(float x);
/// The nearest whole number; halves round away from zero.
[[nodiscard]] inline float nearest(float x) {
    return std::round(x);
}
[[nodiscard]] inline float sign(float x) {
    return x > 0.0F ? 1.0F : x < 0.0F ? -1.0F : x;
}
[[nodiscard]] inline float minimum(float x, float y) {
    return y < x ? y : x;
}
[[nodiscard]] inline float maximum(float x, float y) {
    return y > x ? y : x;
}
/// `from + (to - from) * t` in binary64, rounded once.
[[nodiscard]] inline float mix(float from, float to, float t) {
    const auto start = static_cast<double>(from);
    return static_cast<float>(start + (static_cast<double>(to) - start) * static_cast<double>(t));
}
[[nodiscard]] inline float remainder(float x, float y) {
    return std::fmod(x, y);
}

/// The value of an arithmetic instruction: a row of opcodes.def from Negate to Mod. Unary
/// instructions ignore `y`. Precondition: is_arithmetic(opcode).
[[nodiscard]] float apply(Opcode opcode, float x, float y);
/// Whether the opcode is a row of opcodes.def from Negate to Mod.
[[nodiscard]] bool is_arithmetic(Opcode opcode);

} // namespace lsys::arithmetic
