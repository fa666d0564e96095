// SPDX-License-Identifier: MIT
// TracedWord: a word as input of a trace. It finds modules by position, and neighbours module by
// module (docs/language.md section 5). Written for clarity, not speed; its only table has the
// number of parameters before every kStride-th module.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/trace.h"
#include "runtime/derive/word.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

class TracedWord {
public:
    /// Precondition: bytecode and word outlive the object.
    TracedWord(const Bytecode& bytecode, const Word& word);

    [[nodiscard]] std::uint64_t count() const { return word_.module_count(); }
    [[nodiscard]] SymbolId symbol(std::uint64_t position) const {
        return bytecode_.symbol_of(word_.code(position));
    }
    [[nodiscard]] TracedModule module(std::uint64_t position) const;

    /// Searches the left context of `production` from the module at `position`.
    [[nodiscard]] ContextTrace left(const BytecodeProduction& production,
                                    std::uint64_t position) const;
    /// Searches the right context from gap `gap`, the place before module `gap`.
    [[nodiscard]] ContextTrace right(const BytecodeProduction& production, std::uint64_t gap) const;
    /// The position of the `%` that cuts off the module at `position`; nothing if the module stays.
    /// A `%` that no other `%` cuts off gives its own position.
    [[nodiscard]] std::optional<std::uint64_t> cut_of(std::uint64_t position) const;

private:
    [[nodiscard]] SymbolKind kind(std::uint64_t position) const {
        return bytecode_.symbol(symbol(position)).kind;
    }
    [[nodiscard]] bool is_ignored(std::uint64_t position) const;
    /// The next module on the path to the root: skips closed branches, and leaves an open branch
    /// through its `[`.
    [[nodiscard]] std::optional<std::uint64_t> left_of(std::uint64_t position,
                                                       ContextTrace& trace) const;
    /// The next module along the axis at or after `gap`: skips branches; a `]` ends the axis.
    [[nodiscard]] std::optional<std::uint64_t> next_from(std::uint64_t gap,
                                                         ContextTrace& trace) const;
    /// The place after the branch that opens at `open`; the end of the word if it does not close.
    [[nodiscard]] std::uint64_t after_branch(std::uint64_t open) const;

    const Bytecode& bytecode_;
    const Word& word_;
    std::vector<std::uint64_t> parameters_before_; // parameters before each kStride-th module
};

} // namespace lsys
