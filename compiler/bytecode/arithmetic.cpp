// SPDX-License-Identifier: MIT
#include "compiler/bytecode/arithmetic.h"

#include "grammar/base/contract.h"
#include "grammar/base/exponentials.h"
#include "grammar/base/trigonometry.h"

#include <cmath>
#include <numbers>

namespace lsys::arithmetic {

namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

float rounded(double x) {
    return static_cast<float>(x);
}
double wide(float x) {
    return static_cast<double>(x);
}

/// The angle modulo 360, in (-360, 360), without error.
double reduced(float degrees) {
    return std::fmod(wide(degrees), 360.0);
}

/// 0 to 3 for 0, 90, 180 and 270 degrees and angles equal to them modulo 360; -1 for others.
/// Precondition: `angle` is in (-360, 360) or NaN.
int quarter_turns(double angle) {
    const double quarters = angle / 90.0;
    if (quarters != std::floor(quarters)) {
        return -1; // NaN too
    }
    return static_cast<int>(quarters < 0.0 ? quarters + 4.0 : quarters);
}

float no_arithmetic(Opcode opcode) {
    LSYS_CHECK(is_arithmetic(opcode), static_cast<int>(opcode));
    return 0.0F;
}

} // namespace

float power(float x, float y) {
    return rounded(y == 2.0F ? wide(x) * wide(x) : lsys::power(wide(x), wide(y)));
}

float sine(float degrees) {
    const double angle = reduced(degrees);
    switch (quarter_turns(angle)) {
    case 0:
    case 2:
        return 0.0F;
    case 1:
        return 1.0F;
    case 3:
        return -1.0F;
    default:
        return rounded(sine_cosine(angle * kRadiansPerDegree).sine);
    }
}

float cosine(float degrees) {
    const double angle = reduced(degrees);
    switch (quarter_turns(angle)) {
    case 0:
        return 1.0F;
    case 1:
    case 3:
        return 0.0F;
    case 2:
        return -1.0F;
    default:
        return rounded(sine_cosine(angle * kRadiansPerDegree).cosine);
    }
}

float tangent(float degrees) {
    const double angle = reduced(degrees);
    switch (quarter_turns(angle)) {
    case 0:
    case 2:
        return 0.0F;
    case 1:
        return HUGE_VALF;
    case 3:
        return -HUGE_VALF;
    default:
        const SineCosine turn = sine_cosine(angle * kRadiansPerDegree);
        return rounded(turn.sine / turn.cosine);
    }
}

float arc_sine(float x) {
    return rounded(lsys::arc_sine(wide(x)) * kDegreesPerRadian);
}
float arc_cosine(float x) {
    return rounded(lsys::arc_cosine(wide(x)) * kDegreesPerRadian);
}
float arc_tangent(float x) {
    return rounded(lsys::arc_tangent(wide(x), 1.0) * kDegreesPerRadian);
}
float arc_tangent2(float y, float x) {
    return rounded(polar_angle(wide(y), wide(x)) * kDegreesPerRadian);
}
float exponential(float x) {
    return rounded(lsys::exponential(wide(x)));
}
float logarithm(float x) {
    return rounded(lsys::logarithm(wide(x)));
}

bool is_arithmetic(Opcode opcode) {
    return opcode >= Opcode::Negate && opcode <= Opcode::Mod;
}

float apply(Opcode opcode, float x, float y) {
    switch (opcode) {
#define LSYS_OPCODE(identifier, mnemonic, operand, pops, pushes, value, meaning)                   \
    case Opcode::identifier:                                                                       \
        return value;
#include "compiler/bytecode/opcodes.def"
#undef LSYS_OPCODE
    }
    return no_arithmetic(opcode);
}

} // namespace lsys::arithmetic
