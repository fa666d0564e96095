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

    /// Appends a place for messages; returns its index.
    std::uint32_t add_site(SourceSpan span);

    /// Emits code for `value` that ends with Test, End; returns its first instruction.
    std::uint32_t condition(ValueId value, SourceSpan span);
    /// Emits code that computes `values` and emits each, ending with End.
    std::uint32_t arguments(std::span<const ValueId> values);

    /// Whether an operand did not fit its 24 bits, which makes the emitted code useless.
    [[nodiscard]] bool overflowed() const { return overflowed_; }

private:
    void instruction(Opcode opcode, std::uint32_t operand = 0);
    void begin_site(std::uint32_t site);
    void expression(ValueId root, std::uint32_t site);
    void leaf_or_operation(const Value& value, bool swapped, std::uint32_t site);
    [[nodiscard]] bool right_first(const Value& value) const;

    const Program& program_;
    const SourceMap& sources_;
    Bytecode& bytecode_;
    std::vector<std::uint8_t> stack_need_; // by ValueId
    std::uint32_t current_site_ = kNone;   // of the next instruction
    bool overflowed_ = false;

    struct Frame {
        ValueId value;
        bool operands_done;
    };
    std::vector<Frame> frames_;
};

} // namespace lsys
