// SPDX-License-Identifier: MIT
// Translates expressions to instructions: writes Bytecode::instructions, sites and site_ranges.
// Used by lower().
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/program/program.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

class CodeEmitter {
public:
    CodeEmitter(const Program& program, const SourceMap& sources, Bytecode& bytecode);

    /// Appends a place for messages; returns its index in Bytecode::sites.
    std::uint32_t add_site(SourceSpan span);

    /// Emits code for `value` that ends with Test, End; returns its first instruction.
    std::uint32_t condition(ValueId value, SourceSpan span);
    /// Emits code that computes each local value i, except leaves, and moves it to slot i, ending
    /// with End.
    std::uint32_t locals(std::span<const LocalValue> values);
    /// Emits code that computes each of `values` and appends it to the parameters of a new module
    /// (Emit), ending with End.
    std::uint32_t arguments(std::span<const ValueId> values);

    /// Whether an operand exceeded its 24 bits; the emitted code is then useless.
    [[nodiscard]] bool overflowed() const { return overflowed_; }

private:
    void instruction(Opcode opcode, std::uint32_t operand = 0);
    /// Makes the next instructions belong to the site; does nothing for kNone.
    void begin_site(std::uint32_t site);
    /// Emits the code of a value.
    void expression(ValueId root, std::uint32_t site);
    /// Emits the instruction of `value`, after the code of its operands. `swapped`: the right
    /// operand was emitted first.
    void leaf_or_operation(const Value& value, bool swapped, std::uint32_t site);
    /// Whether the right operand is emitted first, which needs less stack.
    [[nodiscard]] bool emits_right_first(const Value& value) const;
    /// Stack depth that the code of a value needs.
    [[nodiscard]] std::uint32_t stack_need(ValueId id) const {
        return stack_need_[static_cast<std::size_t>(id)];
    }
    /// Pushes onto frames_ the steps that compute a value, the first step on top.
    void operands(ValueId id, const Value& value, std::uint32_t site);
    /// Sets the operand of the If or Else at index `at`, so that the instruction skips to the next
    /// one to be emitted.
    void end_skip(std::size_t at);

    const Program& program_;
    const SourceMap& sources_;
    Bytecode& bytecode_;
    std::vector<std::uint32_t> stack_need_; // per ValueId: stack depth that its code needs
    std::uint32_t current_site_ = kNone;    // source position of the next instruction
    bool overflowed_ = false;               // see overflowed()

    /// A step of emitting the code of a value. The last step of frames_, a stack, is emitted first.
    enum class Step : std::uint8_t { Operands, Operation, Store, If, Else, EndIf };
    struct Frame {
        ValueId value;
        Step step = Step::Operands;
        std::size_t skip = 0; // Else, EndIf: index of the If or Else that skips to here
    };
    std::vector<Frame> frames_;
};

} // namespace lsys
