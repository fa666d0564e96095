// SPDX-License-Identifier: MIT
// The one interpreter of expressions: a stack machine over instructions whose values and arithmetic
// are defined by a Domain. With numbers as values it evaluates an expression. With approximations
// of numbers (known or not, constant or affine, monotone or not) it finds properties of the result
// before the inputs are known: abstract interpretation (Cousot and Cousot 1977). A new operation is
// a row of opcodes.def; domains treat its result as unknown unless they have a case for it.
//
// A Domain has a type Value and these functions; UnknownDomain has all of them.
//   bool enter()                    called before each instruction; false stops the run
//   Value literal(float)            the value of a literal
//   Value formal(i), global(i), step(), steps(), branch_draw(i)     the values of other leaves
//   Value unary(opcode, x)          an opcode from Negate to Mod that takes one value
//   Value binary(opcode, x, y)      an opcode from Negate to Mod that takes two values
//   Value curve(i, x)               the value of curve i
//   Value mix(x, y, t)              arithmetic::mix()
//   bool random_draw(opcode, x, y, i, at)   replaces x by draw i of the range [x, y) or of a
//                                   distribution with arguments x and y; false stops the run
//   bool take(x, at)                receives the operand x of Emit or Test; false stops the run
//   kRunsOneSide                    a constant: whether the condition of every choice is known
//     bool holds(x)                 if true: whether condition x holds; only that side is run
//     Value choice(x, y, z)         if false: both sides are run; y if x is not 0, else z
//     first_side(x), second_side(x) if false: called with condition x before that side is run
// `at` points to the instruction being run.
#pragma once

#include "compiler/bytecode/instructions.h"
#include "compiler/bytecode/verify.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace lsys {

/// The domain in which every value is unknown; other domains derive from it.
template <typename Unknown>
struct UnknownDomain {
    using Value = Unknown;
    static constexpr bool kRunsOneSide = false;

    static bool enter() { return true; }
    static Value literal(float /*value*/) { return {}; }
    static Value formal(std::uint32_t /*index*/) { return {}; }
    static Value global(std::uint32_t /*index*/) { return {}; }
    static Value step() { return {}; }
    static Value steps() { return {}; }
    static Value branch_draw(std::uint32_t /*branch*/) { return {}; }
    static Value unary(Opcode /*opcode*/, const Value& /*x*/) { return {}; }
    static Value binary(Opcode /*opcode*/, const Value& /*x*/, const Value& /*y*/) { return {}; }
    static Value curve(std::uint32_t /*index*/, const Value& /*x*/) { return {}; }
    static Value mix(const Value& /*x*/, const Value& /*y*/, const Value& /*t*/) { return {}; }
    static Value choice(const Value& /*x*/, const Value& /*y*/, const Value& /*z*/) { return {}; }
    static void first_side(const Value& /*x*/) {}
    static void second_side(const Value& /*x*/) {}
    static bool random_draw(Opcode /*opcode*/,
                            Value& x,
                            const Value& /*y*/,
                            std::uint32_t /*index*/,
                            const std::uint32_t* /*at*/) {
        x = {};
        return true;
    }
    static bool take(const Value& /*x*/, const std::uint32_t* /*at*/) { return true; }
};

/// Max stack depth of the verified code at `first`.
[[nodiscard]] inline std::size_t stack_room(std::span<const std::uint32_t> words,
                                            std::uint32_t first) {
    std::size_t depth = 0;
    std::size_t room = 0;
    for (const Instruction each : InstructionRange(words, first)) {
        const OpcodeInfo& row = info(each.opcode);
        depth = depth - row.pops + row.pushes;
        room = std::max(room, depth);
    }
    return room;
}

/// Number of slots that the verified code at `first` sets.
[[nodiscard]] inline std::size_t slot_count(std::span<const std::uint32_t> words,
                                            std::uint32_t first) {
    std::size_t slots = 0;
    for (const Instruction each : InstructionRange(words, first)) {
        slots = each.opcode == Opcode::SetLocal ? std::max<std::size_t>(slots, each.operand + 1U)
                                                : slots;
    }
    return slots;
}

/// Runs the verified instructions at `at` up to End. Returns false if the domain stopped the run.
/// `stack` has room for Bytecode::stack_depth or stack_room() values, `slots` for
/// Bytecode::local_count or slot_count(). Slots that this code reads without setting them must be
/// set by the caller.
template <typename Domain>
[[gnu::always_inline]] inline bool interpret(const std::uint32_t* at,
                                             Domain& domain,
                                             typename Domain::Value* stack,
                                             typename Domain::Value* slots) {
    auto* top = stack; // one past the top
    for (;; ++at) {
        if (!domain.enter()) {
            return false;
        }
        const Opcode opcode = opcode_of(*at);
        const std::uint32_t operand = operand_of(*at);
        switch (opcode) {
        case Opcode::Literal:
            *top++ = domain.literal(std::bit_cast<float>(*++at));
            break;
        case Opcode::Formal:
            *top++ = domain.formal(operand);
            break;
        case Opcode::Global:
            *top++ = domain.global(operand);
            break;
        case Opcode::Step:
            *top++ = domain.step();
            break;
        case Opcode::Steps:
            *top++ = domain.steps();
            break;
        // Frequent operations have their own cases, so that an inlined binary() is one operation.
        case Opcode::Multiply:
            --top;
            top[-1] = domain.binary(Opcode::Multiply, top[-1], top[0]);
            break;
        case Opcode::Add:
            --top;
            top[-1] = domain.binary(Opcode::Add, top[-1], top[0]);
            break;
        case Opcode::Subtract:
            --top;
            top[-1] = domain.binary(Opcode::Subtract, top[-1], top[0]);
            break;
        case Opcode::Local:
            *top++ = slots[operand];
            break;
        case Opcode::SetLocal:
            slots[operand] = std::move(*--top);
            break;
        case Opcode::Curve:
            top[-1] = domain.curve(operand, top[-1]);
            break;
        case Opcode::Mix:
            top -= 2;
            top[-1] = domain.mix(top[-1], top[0], top[1]);
            break;
        case Opcode::If:
            if constexpr (Domain::kRunsOneSide) {
                at += domain.holds(*--top) ? 0 : operand;
            } else {
                domain.first_side(top[-1]);
            }
            break;
        case Opcode::Else:
            if constexpr (Domain::kRunsOneSide) {
                at += operand;
            } else {
                domain.second_side(top[-2]);
            }
            break;
        case Opcode::EndIf:
            if constexpr (!Domain::kRunsOneSide) {
                top -= 2;
                top[-1] = domain.choice(top[-1], top[0], top[1]);
            }
            break;
        case Opcode::Swap:
            std::swap(top[-1], top[-2]);
            break;
        case Opcode::Range:
        case Opcode::Normal:
        case Opcode::Binomial:
            --top;
            if (!domain.random_draw(opcode, top[-1], top[0], operand, at)) {
                return false;
            }
            break;
        case Opcode::Poisson:
            if (!domain.random_draw(opcode, top[-1], top[-1], operand, at)) {
                return false;
            }
            break;
        case Opcode::BranchDraw:
            *top++ = domain.branch_draw(operand);
            break;
        case Opcode::Emit:
        case Opcode::Test:
            --top;
            if (!domain.take(top[0], at)) {
                return false;
            }
            break;
        case Opcode::End:
            return true;
        default:
            if (pops_of(opcode) == 2) {
                --top;
                top[-1] = domain.binary(opcode, top[-1], top[0]);
            } else {
                top[-1] = domain.unary(opcode, top[-1]);
            }
            break;
        }
    }
}

} // namespace lsys
