// SPDX-License-Identifier: MIT
#include "compiler/growth/impl/known_values.h"

#include "compiler/bytecode/arithmetic.h"
#include "compiler/bytecode/interpret.h"

#include <bit>

namespace lsys::analysis {

namespace {

KnownValue known(float value) {
    return {value, true};
}

KnownValue known(const std::optional<std::uint32_t>& count) {
    return count ? known(static_cast<float>(*count)) : KnownValue{};
}

/// The domain of numbers that may be unknown.
struct Known : UnknownDomain<KnownValue> {
    Known(const ExpressionInputs& input_values, std::uint64_t& counter)
        : inputs(input_values), work(counter) {}

    const ExpressionInputs& inputs;
    std::uint64_t& work; // number of instructions run, without Emit and Test

    bool enter() const {
        ++work;
        return true;
    }
    static KnownValue literal(float value) { return known(value); }
    [[nodiscard]] KnownValue formal(std::uint32_t index) const {
        return index < inputs.formals.size() ? inputs.formals[index] : KnownValue{};
    }
    [[nodiscard]] KnownValue step() const { return known(inputs.step); }
    [[nodiscard]] KnownValue steps() const { return known(inputs.steps); }
    static KnownValue unary(Opcode opcode, KnownValue x) {
        return x.known ? known(arithmetic::apply(opcode, x.value, 0.0F)) : KnownValue{};
    }
    static KnownValue binary(Opcode opcode, KnownValue x, KnownValue y) {
        if (x.known && y.known) {
            return known(arithmetic::apply(opcode, x.value, y.value));
        }
        // A false operand decides `&&`, and a true operand decides `||`, whatever the other operand
        // is.
        const KnownValue one = x.known ? x : y;
        const bool logical = opcode == Opcode::And || opcode == Opcode::Or;
        const bool decides = one.known && (one.value != 0.0F) == (opcode == Opcode::Or);
        return logical && decides ? known(arithmetic::truth(opcode == Opcode::Or)) : KnownValue{};
    }
    static KnownValue mix(KnownValue x, KnownValue y, KnownValue t) {
        return x.known && y.known && t.known ? known(arithmetic::mix(x.value, y.value, t.value))
                                             : KnownValue{};
    }
    static KnownValue choice(KnownValue x, KnownValue y, KnownValue z) {
        if (x.known) {
            return x.value != 0.0F ? y : z;
        }
        const bool same =
            y.known && z.known &&
            std::bit_cast<std::uint32_t>(y.value) == std::bit_cast<std::uint32_t>(z.value);
        return same ? y : KnownValue{};
    }
    bool take(KnownValue /*x*/, const std::uint32_t* /*at*/) const {
        --work; // undoes the count of enter(): an Emit or Test computes nothing
        return false;
    }
};

} // namespace

KnownValue Evaluator::run(std::span<const std::uint32_t> instructions,
                          std::uint32_t first,
                          const ExpressionInputs& inputs,
                          std::uint32_t locals) {
    Known domain(inputs, work_);
    for (const std::uint32_t code : {locals, first}) {
        if (code != kNone) {
            interpret(instructions.data() + code, domain, stack_.data(), slots_.data());
        }
    }
    return stack_.front();
}

} // namespace lsys::analysis
