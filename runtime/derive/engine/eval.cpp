// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/eval.h"

#include "compiler/bytecode/arithmetic.h"
#include "compiler/bytecode/distributions.h"
#include "compiler/bytecode/interpret.h"
#include "compiler/bytecode/verify.h"
#include "grammar/base/contract.h"

#include <array>
#include <cmath>
#include <vector>

namespace lsys {

float RangeDraws::draw_branch(std::uint32_t branch) {
    return source_.draw(kFirstBranchDraw + branch);
}

float RangeDraws::draw(std::uint32_t range) {
    if (generation_ == kStartGeneration) {
        return unit_interval(draw_block(seed_, generation_, position_ + range, 0)[0]);
    }
    return source_.draw(first_ + range);
}

Fault check_range(float minimum, float maximum) {
    if (!std::isfinite(minimum) || !std::isfinite(maximum)) {
        return Fault::RangeTooWide;
    }
    if (minimum > maximum) {
        return Fault::RangeReversed;
    }
    return std::isfinite(maximum - minimum) ? Fault::None : Fault::RangeTooWide;
}

namespace {

constexpr std::uint32_t kUsualSlots = 32; // slots of local values that need no heap memory

/// The Domain of interpret() whose values are numbers.
struct Numbers : UnknownDomain<float> {
    static constexpr bool kRunsOneSide = true;

    const Bytecode& bytecode;
    const EvalFrame& frame;
    RangeDraws* draws;
    float* out;
    const std::uint32_t* begin; // the first of Bytecode::instructions
    EvalFault& fault;

    static float literal(float value) { return value; }
    [[nodiscard]] float formal(std::uint32_t index) const { return frame.formals[index]; }
    [[nodiscard]] float global(std::uint32_t index) const { return frame.globals[index]; }
    [[nodiscard]] float step() const { return frame.step; }
    [[nodiscard]] float steps() const { return frame.steps; }
    [[nodiscard]] float branch_draw(std::uint32_t branch) const {
        LSYS_DCHECK(draws != nullptr);
        return draws->draw_branch(branch);
    }
    static float unary(Opcode opcode, float x) { return arithmetic::apply(opcode, x, 0.0F); }
    static float binary(Opcode opcode, float x, float y) {
        switch (opcode) {
        case Opcode::Multiply:
            return x * y;
        case Opcode::Add:
            return x + y;
        case Opcode::Subtract:
            return x - y;
        default:
            return arithmetic::apply(opcode, x, y);
        }
    }
    [[nodiscard]] float curve(std::uint32_t index, float x) const {
        return curve_value(bytecode.curves[index].points, x);
    }
    static float mix(float x, float y, float t) { return arithmetic::mix(x, y, t); }
    static bool holds(float x) { return x != 0.0F; }
    bool
    random_draw(Opcode opcode, float& x, float y, std::uint32_t index, const std::uint32_t* at) {
        const Fault kind = opcode == Opcode::Range ? check_range(x, y)
                           : check_distribution(opcode, x, y) == DistributionFault::None
                               ? Fault::None
                               : Fault::BadDistribution;
        if (kind != Fault::None) {
            fault = {kind, static_cast<std::uint32_t>(at - begin), 0.0F, x, y};
            return false;
        }
        LSYS_DCHECK(draws != nullptr);
        const float u = draws->draw(index);
        x = opcode == Opcode::Range ? draw_in_range(x, y, u) : draw_from(opcode, x, y, u);
        return true;
    }
    bool take(float x, const std::uint32_t* at) {
        if (!std::isfinite(x)) {
            fault = {Fault::NotFinite, static_cast<std::uint32_t>(at - begin), x, 0.0F, 0.0F};
            return false;
        }
        *out++ = x;
        return true;
    }
};

} // namespace

bool evaluate(const Bytecode& bytecode,
              std::uint32_t first,
              const EvalFrame& frame,
              RangeDraws* draws,
              float* out,
              EvalFault& fault) {
    WordTemplate word;
    word.arguments = first;
    return evaluate(bytecode, word, frame, draws, out, fault);
}

bool evaluate(const Bytecode& bytecode,
              const WordTemplate& word,
              const EvalFrame& frame,
              RangeDraws* draws,
              float* out,
              EvalFault& fault) {
    const std::uint32_t* const begin = bytecode.instructions.data();
    Numbers numbers{{}, bytecode, frame, draws, out, begin, fault};
    const auto run = [&](float* stack, float* slots) {
        for (const std::uint32_t first : {word.locals, word.arguments}) {
            if (first != kNone && !interpret(begin + first, numbers, stack, slots)) {
                return false;
            }
        }
        return true;
    };
    if (bytecode.stack_depth <= kUsualStack && bytecode.local_count <= kUsualSlots) {
        // NOLINTNEXTLINE: written before they are read, as verify() promises
        std::array<float, kUsualStack> stack;
        std::array<float, kUsualSlots> slots; // NOLINT
        return run(stack.data(), slots.data());
    }
    std::vector<float> room(std::size_t{bytecode.stack_depth} + bytecode.local_count);
    return run(room.data(), room.data() + bytecode.stack_depth);
}

} // namespace lsys
