// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/sweep_machine.h"

#include "compiler/bytecode/arithmetic.h"
#include "compiler/bytecode/curve.h"
#include "compiler/bytecode/distributions.h"
#include "runtime/base/random.h"
#include "runtime/derive/engine/eval.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace lsys {

namespace {

using Operation = SweepOperation;
using Bases = const float* const*;

bool is_valid_draw(Opcode opcode, float x, float y) {
    return opcode == Opcode::Range ? check_range(x, y) == Fault::None
                                   : check_distribution(opcode, x, y) == DistributionFault::None;
}

/// `condition != 0 ? first : second` without a jump. The bits of +0 and -0 are 0 but for the sign.
float select(float condition, float first, float second) {
    const std::uint32_t is_second = std::bit_cast<std::uint32_t>(condition) << 1 == 0 ? 1 : 0;
    const std::uint32_t mask = is_second - 1; // all bits set for the first
    const auto other = std::bit_cast<std::uint32_t>(second);
    return std::bit_cast<float>(((std::bit_cast<std::uint32_t>(first) ^ other) & mask) ^ other);
}

float operand(Bases bases, SweepOperand at) {
    return bases[at.base][at.index];
}

float next(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    return at[1].run(at + 1, result, bases, machine);
}

// Opcodes with a sweep function of their own; others call arithmetic::apply().
struct Add {
    static constexpr Opcode kOpcode = Opcode::Add;
    static float of(float x, float y) { return x + y; }
};
struct Subtract {
    static constexpr Opcode kOpcode = Opcode::Subtract;
    static float of(float x, float y) { return x - y; }
};
struct Multiply {
    static constexpr Opcode kOpcode = Opcode::Multiply;
    static float of(float x, float y) { return x * y; }
};
struct Divide {
    static constexpr Opcode kOpcode = Opcode::Divide;
    static float of(float x, float y) { return x / y; }
};
struct Less {
    static constexpr Opcode kOpcode = Opcode::Less;
    static float of(float x, float y) { return arithmetic::truth(x < y); }
};
struct LessEqual {
    static constexpr Opcode kOpcode = Opcode::LessEqual;
    static float of(float x, float y) { return arithmetic::truth(x <= y); }
};
struct Greater {
    static constexpr Opcode kOpcode = Opcode::Greater;
    static float of(float x, float y) { return arithmetic::truth(x > y); }
};
struct GreaterEqual {
    static constexpr Opcode kOpcode = Opcode::GreaterEqual;
    static float of(float x, float y) { return arithmetic::truth(x >= y); }
};
struct Equal {
    static constexpr Opcode kOpcode = Opcode::Equal;
    static float of(float x, float y) { return arithmetic::truth(x == y); }
};
struct NotEqual {
    static constexpr Opcode kOpcode = Opcode::NotEqual;
    static float of(float x, float y) { return arithmetic::truth(x != y); }
};
struct And {
    static constexpr Opcode kOpcode = Opcode::And;
    static float of(float x, float y) { return arithmetic::logical_and(x, y); }
};
struct Or {
    static constexpr Opcode kOpcode = Opcode::Or;
    static float of(float x, float y) { return arithmetic::logical_or(x, y); }
};
struct Min {
    static constexpr Opcode kOpcode = Opcode::Min;
    static float of(float x, float y) { return arithmetic::minimum(x, y); }
};
struct Max {
    static constexpr Opcode kOpcode = Opcode::Max;
    static float of(float x, float y) { return arithmetic::maximum(x, y); }
};

template <typename Arithmetic>
float binary_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    return next(at, Arithmetic::of(result, operand(bases, at->x)), bases, machine);
}
template <typename Arithmetic>
float swapped_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    return next(at, Arithmetic::of(operand(bases, at->x), result), bases, machine);
}
template <typename Arithmetic>
float both_step(const Operation* at, float /*result*/, Bases bases, SweepMachine& machine) {
    return next(at, Arithmetic::of(operand(bases, at->x), operand(bases, at->y)), bases, machine);
}

struct BinaryFunctions {
    Opcode opcode;
    SweepFunction binary;
    SweepFunction swapped;
    SweepFunction both;
};
template <typename... Arithmetic>
constexpr std::array<BinaryFunctions, sizeof...(Arithmetic)> functions_of() {
    return {{{Arithmetic::kOpcode, binary_step<Arithmetic>, swapped_step<Arithmetic>,
              both_step<Arithmetic>}...}};
}
constexpr auto kBinaryFunctions = functions_of<Add,
                                               Subtract,
                                               Multiply,
                                               Divide,
                                               Less,
                                               LessEqual,
                                               Greater,
                                               GreaterEqual,
                                               Equal,
                                               NotEqual,
                                               And,
                                               Or,
                                               Min,
                                               Max>();

/// The row of an opcode, or nullptr.
const BinaryFunctions* functions_of(Opcode opcode) {
    const auto* const found =
        std::find_if(kBinaryFunctions.begin(), kBinaryFunctions.end(),
                     [opcode](const BinaryFunctions& each) { return each.opcode == opcode; });
    return found == kBinaryFunctions.end() ? nullptr : found;
}

float load_step(const Operation* at, float /*result*/, Bases bases, SweepMachine& machine) {
    return next(at, operand(bases, at->x), bases, machine);
}
float end_step(const Operation* /*at*/, float result, Bases /*bases*/, SweepMachine& /*machine*/) {
    return result;
}
float choose_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    return next(at, select(result, operand(bases, at->x), operand(bases, at->y)), bases, machine);
}
float mix_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    return next(at, arithmetic::mix(operand(bases, at->x), operand(bases, at->y), result), bases,
                machine);
}
float range_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    const float low = operand(bases, at->x);
    const float u = operand(bases, at->y);
    float drawn = low + (result - low) * u;
    if (drawn >= result) { // rare: rounded to the end of the range, or an empty range
        drawn = draw_in_range(low, result, u);
    }
    return next(at, drawn, bases, machine);
}
float draw_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    const float x = operand(bases, at->x);
    // An invalid draw is a fault if its value is needed, which SweepSteps::check() finds.
    const float drawn = is_valid_draw(at->opcode, x, result)
                            ? draw_from(at->opcode, x, result, operand(bases, at->y))
                            : 0.0F;
    return next(at, drawn, bases, machine);
}
float negate_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    return next(at, -result, bases, machine);
}
float sqrt_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    return next(at, std::sqrt(result), bases, machine);
}
float unary_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    return next(at, arithmetic::apply(at->opcode, result, 0.0F), bases, machine);
}
float apply_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    return next(at, arithmetic::apply(at->opcode, result, operand(bases, at->x)), bases, machine);
}
float apply_swapped_step(const Operation* at, float result, Bases bases, SweepMachine& machine) {
    return next(at, arithmetic::apply(at->opcode, operand(bases, at->x), result), bases, machine);
}
float apply_both_step(const Operation* at, float /*result*/, Bases bases, SweepMachine& machine) {
    return next(at, arithmetic::apply(at->opcode, operand(bases, at->x), operand(bases, at->y)),
                bases, machine);
}

} // namespace

/// Functions that need more of the machine than its operands.
struct SweepSteps {
    static float store(const Operation* at, float result, Bases bases, SweepMachine& machine) {
        machine.slots_[at->x.index] = result;
        return next(at, result, bases, machine);
    }
    static float emit(const Operation* at, float result, Bases bases, SweepMachine& machine) {
        machine.values_[at->x.index] = result;
        return next(at, result, bases, machine);
    }
    static float pause(const Operation* at, float result, Bases /*bases*/, SweepMachine& machine) {
        machine.paused_ = at + 1;
        return result;
    }
    static float curve(const Operation* at, float result, Bases bases, SweepMachine& machine) {
        const BytecodeCurve& curve = machine.bytecode_.curves[at->x.index];
        return next(at, curve_value(curve.points, result), bases, machine);
    }
    static float check(const Operation* at, float result, Bases bases, SweepMachine& machine) {
        machine.faulty_ =
            machine.faulty_ || (operand(bases, at->y) != 0.0F &&
                                !is_valid_draw(at->opcode, operand(bases, at->x), result));
        return next(at, result, bases, machine);
    }
};

namespace sweep_functions {

SweepFunction load() {
    return load_step;
}
SweepFunction store() {
    return SweepSteps::store;
}
SweepFunction emit() {
    return SweepSteps::emit;
}
SweepFunction end() {
    return end_step;
}
SweepFunction pause() {
    return SweepSteps::pause;
}
SweepFunction choose() {
    return choose_step;
}
SweepFunction mix() {
    return mix_step;
}
SweepFunction curve() {
    return SweepSteps::curve;
}
SweepFunction check() {
    return SweepSteps::check;
}
SweepFunction range() {
    return range_step;
}
SweepFunction draw() {
    return draw_step;
}
SweepFunction unary(Opcode opcode) {
    return opcode == Opcode::Negate ? negate_step : opcode == Opcode::Sqrt ? sqrt_step : unary_step;
}
SweepFunction binary(Opcode opcode) {
    const BinaryFunctions* const found = functions_of(opcode);
    return found != nullptr ? found->binary : apply_step;
}
SweepFunction swapped(Opcode opcode) {
    const BinaryFunctions* const found = functions_of(opcode);
    return found != nullptr ? found->swapped : apply_swapped_step;
}
SweepFunction both(Opcode opcode) {
    const BinaryFunctions* const found = functions_of(opcode);
    return found != nullptr ? found->both : apply_both_step;
}

} // namespace sweep_functions

} // namespace lsys
