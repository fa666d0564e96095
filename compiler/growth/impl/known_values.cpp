#include "compiler/growth/impl/known_values.h"

#include "compiler/bytecode/arithmetic.h"
#include "grammar/base/contract.h"

#include <bit>

namespace lsys::analysis {

namespace {

KnownValue known(float value) {
    return {value, true};
}

/// `&&` and `||` are decided by one side alone.
KnownValue logical(Opcode opcode, KnownValue x, KnownValue y) {
    if (x.known && y.known) {
        return known(arithmetic::apply(opcode, x.value, y.value));
    }
    const KnownValue one = x.known ? x : y;
    const bool decides = one.known && (one.value != 0.0F) == (opcode == Opcode::Or);
    return decides ? known(arithmetic::truth(opcode == Opcode::Or)) : KnownValue{};
}

} // namespace

void Evaluator::execute(std::span<const std::uint32_t> instructions,
                        std::uint32_t& at,
                        const Surroundings& surroundings) {
    const std::uint32_t word = instructions[at];
    const Opcode opcode = opcode_of(word);
    ++work_;
    const auto count = [](const std::optional<std::uint32_t>& value) {
        return value ? known(static_cast<float>(*value)) : KnownValue{};
    };
    switch (opcode) {
    case Opcode::Literal:
        stack_.push_back(known(std::bit_cast<float>(instructions[at + 1])));
        break;
    case Opcode::Formal: {
        const std::uint32_t formal = operand_of(word);
        stack_.push_back(formal < surroundings.formals.size() ? surroundings.formals[formal]
                                                              : KnownValue{});
        break;
    }
    case Opcode::Global:
    case Opcode::BranchDraw:
        stack_.emplace_back();
        break;
    case Opcode::Step:
        stack_.push_back(count(surroundings.step));
        break;
    case Opcode::Steps:
        stack_.push_back(count(surroundings.steps));
        break;
    case Opcode::Range: {
        stack_.pop_back();
        stack_.back() = KnownValue{};
        break;
    }
    default: {
        LSYS_DCHECK(arithmetic::is_arithmetic(opcode), static_cast<int>(opcode));
        KnownValue y;
        if (info(opcode).pops == 2) {
            y = stack_.back();
            stack_.pop_back();
        }
        const KnownValue x = stack_.back();
        if (opcode == Opcode::And || opcode == Opcode::Or) {
            stack_.back() = logical(opcode, x, y);
        } else if (x.known && (y.known || info(opcode).pops == 1)) {
            stack_.back() = known(arithmetic::apply(opcode, x.value, y.value));
        } else {
            stack_.back() = KnownValue{};
        }
        break;
    }
    }
    at += instruction_length(opcode);
}

KnownValue Evaluator::run(std::span<const std::uint32_t> instructions,
                          std::uint32_t first,
                          const Surroundings& surroundings) {
    stack_.clear();
    std::uint32_t at = first;
    for (;;) {
        const Opcode opcode = opcode_of(instructions[at]);
        if (opcode == Opcode::Emit || opcode == Opcode::Test || opcode == Opcode::End) {
            next_ = opcode == Opcode::End ? at : at + 1;
            return stack_.empty() ? KnownValue{} : stack_.back();
        }
        execute(instructions, at, surroundings);
    }
}

KnownValue Evaluator::run_part(std::span<const std::uint32_t> instructions,
                               TableRange part,
                               const Surroundings& surroundings) {
    stack_.clear();
    std::uint32_t at = part.first;
    while (at < part.first + part.count) {
        execute(instructions, at, surroundings);
    }
    return stack_.empty() ? KnownValue{} : stack_.back();
}

} // namespace lsys::analysis
