#include "runtime/derive/engine/eval.h"

#include "compiler/bytecode/arithmetic.h"
#include "compiler/bytecode/verify.h"
#include "grammar/base/contract.h"

#include <array>
#include <bit>
#include <cmath>
#include <utility>

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

bool evaluate(const Bytecode& bytecode,
              std::uint32_t first,
              const EvalFrame& frame,
              RangeDraws* draws,
              float* out,
              EvalFault& fault) {
    std::array<float, kMaxStack> stack; // NOLINT: written before it is read, as verify() promises
    float* top = stack.data();          // one past the top
    const std::uint32_t* const begin = bytecode.instructions.data();
    for (const std::uint32_t* at = begin + first;; ++at) {
        const auto opcode = static_cast<Opcode>(*at & 0xFF);
        const std::uint32_t operand = *at >> 8;
        switch (opcode) {
        case Opcode::Literal:
            *top++ = std::bit_cast<float>(*++at);
            break;
        case Opcode::Formal:
            *top++ = frame.formals[operand];
            break;
        case Opcode::Global:
            *top++ = frame.globals[operand];
            break;
        case Opcode::Step:
            *top++ = frame.step;
            break;
        case Opcode::Steps:
            *top++ = frame.steps;
            break;
        case Opcode::Multiply:
            --top;
            top[-1] = top[-1] * top[0];
            break;
        case Opcode::Add:
            --top;
            top[-1] = top[-1] + top[0];
            break;
        case Opcode::Subtract:
            --top;
            top[-1] = top[-1] - top[0];
            break;
        case Opcode::Swap:
            std::swap(top[-1], top[-2]);
            break;
        case Opcode::Range: {
            --top;
            const Fault kind = check_range(top[-1], top[0]);
            if (kind != Fault::None) {
                fault = {kind, static_cast<std::uint32_t>(at - begin), top[-1], top[0]};
                return false;
            }
            LSYS_DCHECK(draws != nullptr);
            top[-1] = draw_in_range(top[-1], top[0], draws->draw(operand));
            break;
        }
        case Opcode::BranchDraw:
            LSYS_DCHECK(draws != nullptr);
            *top++ = draws->draw_branch(operand);
            break;
        case Opcode::Emit:
        case Opcode::Test:
            --top;
            if (!std::isfinite(top[0])) {
                fault = {Fault::NotFinite, static_cast<std::uint32_t>(at - begin), top[0], 0.0F};
                return false;
            }
            *out++ = top[0];
            break;
        case Opcode::End:
            return true;
        default: {
            const float y = info(opcode).pops == 2 ? *--top : 0.0F;
            top[-1] = arithmetic::apply(opcode, top[-1], y);
            break;
        }
        }
    }
}

} // namespace lsys
