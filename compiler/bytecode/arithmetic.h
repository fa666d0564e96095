// The arithmetic of expressions (docs/language.md section 4): every value is an IEEE binary32; + -
// * / and sqrt round correctly, other functions and powers are computed in binary64 and rounded
// once. The compiler folds constants and the runtime evaluates instructions with these same
// functions, so the two cannot differ. Angles are degrees.
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
/// Not a number counts as true: it differs from 0.
[[nodiscard]] inline float logical_and(float x, float y) {
    return truth(x != 0.0F && y != 0.0F);
}
[[nodiscard]] inline float logical_or(float x, float y) {
    return truth(x != 0.0F || y != 0.0F);
}

[[nodiscard]] float power(float x, float y);
/// Reduced exactly modulo 360; exact at multiples of 90, with positive zeros.
[[nodiscard]] float sine(float degrees);
[[nodiscard]] float cosine(float degrees);
[[nodiscard]] float tangent(float degrees);
[[nodiscard]] float arc_sine(float x);
[[nodiscard]] float arc_cosine(float x);
[[nodiscard]] float arc_tangent(float x);
/// The angle of the direction (y, x), in C's order of arguments.
[[nodiscard]] float arc_tangent2(float y, float x);
[[nodiscard]] float exponential(float x);
[[nodiscard]] float logarithm(float x);
/// Half away from zero.
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
[[nodiscard]] inline float remainder(float x, float y) {
    return std::fmod(x, y);
}

/// The value of an instruction that takes one value or two and depends on nothing else: those
/// of opcodes.def from Negate to Mod. Unary ones ignore `y`.
[[nodiscard]] float apply(Opcode opcode, float x, float y);
/// Whether apply() takes this opcode.
[[nodiscard]] bool is_arithmetic(Opcode opcode);

} // namespace lsys::arithmetic
