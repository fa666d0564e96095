// SPDX-License-Identifier: MIT
// Reads instructions one by one; opcodes.def defines their encoding.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>

namespace lsys {

[[nodiscard]] constexpr Opcode opcode_of(std::uint32_t instruction) {
    return static_cast<Opcode>(instruction & 0xFFU);
}
[[nodiscard]] constexpr std::uint32_t operand_of(std::uint32_t instruction) {
    return instruction >> 8;
}
/// Length of an instruction in 32-bit words: 2 for Literal, whose value is the second word, else 1.
[[nodiscard]] constexpr std::uint32_t instruction_length(Opcode opcode) {
    return opcode == Opcode::Literal ? 2 : 1;
}
inline constexpr std::array<std::uint8_t, kOpcodeCount> kOpcodePops{
#define LSYS_OPCODE(identifier, mnemonic, operand, pops, pushes, value, meaning) pops,
#include "compiler/bytecode/opcodes.def"
#undef LSYS_OPCODE
};
/// Number of values that an instruction takes from the stack. Precondition: opcode < kOpcodeCount.
[[nodiscard]] constexpr std::uint8_t pops_of(Opcode opcode) {
    return kOpcodePops[static_cast<std::size_t>(opcode)];
}

/// Memory that running some code needs: max stack depth and number of slots.
struct CodeNeeds {
    std::uint32_t stack_depth = 0;
    std::uint32_t local_count = 0;
};
[[nodiscard]] CodeNeeds needs_of(std::span<const std::uint32_t> instructions);

struct Instruction {
    std::uint32_t at = 0; // index of its first word
    Opcode opcode = Opcode::End;
    std::uint32_t operand = 0;
    float literal = 0.0F;
};

/// The instructions of verified code from word `first` to the first End, which is included, or to
/// word `last`, which is not, whichever comes first.
class InstructionRange {
public:
    InstructionRange(std::span<const std::uint32_t> words,
                     std::uint32_t first,
                     std::uint32_t last = kNone)
        : words_(words), first_(first), last_(last) {}

    struct Sentinel {};
    class Iterator {
    public:
        Iterator(const InstructionRange& range, std::uint32_t at) : range_(range), at_(at) {}
        Instruction operator*() const {
            const std::uint32_t word = range_.words_[at_];
            const bool has_literal = opcode_of(word) == Opcode::Literal;
            return {at_, opcode_of(word), operand_of(word),
                    has_literal ? std::bit_cast<float>(range_.words_[at_ + 1]) : 0.0F};
        }
        Iterator& operator++() {
            const Opcode opcode = opcode_of(range_.words_[at_]);
            at_ = opcode == Opcode::End ? range_.last_ : at_ + instruction_length(opcode);
            return *this;
        }
        bool operator==(Sentinel /*end*/) const { return at_ >= range_.last_; }

    private:
        const InstructionRange& range_;
        std::uint32_t at_;
    };
    [[nodiscard]] Iterator begin() const { return {*this, first_}; }
    [[nodiscard]] Sentinel end() const { return {}; }
    [[nodiscard]] std::uint32_t first() const { return first_; }

private:
    std::span<const std::uint32_t> words_;
    std::uint32_t first_;
    std::uint32_t last_;
};

} // namespace lsys
