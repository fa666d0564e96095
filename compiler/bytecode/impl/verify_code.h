// SPDX-License-Identifier: MIT
// Checks of verify() for code: operands, stack depths, choices, slots of local values and numbers of
// draws.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/bytecode/instructions.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

/// The place in which a piece of code is used, which decides the instructions that the code may
/// have.
enum class CodePlace : std::uint8_t { Global, Axiom, Condition, Locals, Successor };

/// Limits of the operands of a piece of code, and the number of values that it must produce.
struct CodeBounds {
    std::uint32_t formals = 0;     // number of formals
    std::uint32_t globals = kNone; // number of globals; kNone: no limit
    std::uint32_t draws = 0;       // number of draws
    std::uint32_t emits = 1;       // exact number of values that Emit or Test must take
};

/// Verifies the pieces of code of a bytecode, which follow each other without gaps.
class CodeVerifier {
public:
    explicit CodeVerifier(const Bytecode& bytecode) : bytecode_(bytecode) {}

    /// Begins a word, constant or condition, which shares neither slots nor draws with others.
    void begin_piece();
    /// The first mistake in one piece of code, which may also read the slots that earlier code of
    /// the same word has set; nothing if there is none.
    [[nodiscard]] std::optional<std::string>
    problem(CodePlace place, std::uint32_t first, const CodeBounds& bounds);
    /// The index of the instruction after the last piece.
    [[nodiscard]] std::uint64_t next() const { return next_instruction_; }

private:
    /// A choice whose EndIf has not been read yet.
    struct Choice {
        std::uint64_t next = 0;  // target of the skip of its If or Else
        std::uint32_t depth = 0; // stack depth, condition included
        std::size_t slots = 0;   // number of slots set before the choice
        bool has_else = false;
    };

    [[nodiscard]] bool fits(Opcode opcode, std::uint32_t operand, const CodeBounds& bounds);
    bool record_draw(std::uint32_t number);
    bool slot(Opcode opcode, std::uint32_t index);
    void end_slots(std::size_t count);
    bool choice(Opcode opcode, std::uint64_t at, std::uint32_t operand, std::uint32_t depth);
    [[nodiscard]] bool allowed(CodePlace place, Opcode opcode) const;

    const Bytecode& bytecode_;
    std::vector<Choice> choices_;
    std::vector<std::uint32_t> set_slots_; // slots with a value, in the order of setting
    std::vector<bool> is_set_;             // by slot: whether it has a value
    std::vector<bool> draw_is_seen_;       // per random draw of the current word or constant
    std::uint64_t next_instruction_ = 0;
};

} // namespace lsys
