// Brackets of words and templates: whether every `]` has its `[`.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/derive.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// Whether a `]` of the template has no matching `[` in the template.
[[nodiscard]] bool has_unmatched_close(const Bytecode& bytecode, TableRange codes);
/// Whether the production rewrites a bracket, so that the matching bracket of the word may lose its
/// partner.
[[nodiscard]] bool rewrites_bracket(const Bytecode& bytecode, const BytecodeProduction& production);

/// Checks the brackets of a word, which may come in pieces.
class BracketCounter {
public:
    explicit BracketCounter(const Bytecode& bytecode);

    /// The index in this piece of the first `]` without its `[`, or nothing.
    template <typename C>
    [[nodiscard]] std::optional<std::uint64_t> feed(const C* codes, std::uint64_t count) {
        if (!has_close_) {
            return std::nullopt;
        }
        for (std::uint64_t i = 0; i < count; ++i) {
            depth_ += change_[codes[i]];
            if (depth_ < 0) {
                return i;
            }
        }
        return std::nullopt;
    }

private:
    std::vector<std::int8_t> change_; // change of the depth, by code
    std::int64_t depth_ = 0;
    bool has_close_ = false;
};

/// The production that must have written an unmatched `]`: the only one whose successor closes a
/// bracket that it does not open, if the axiom closes none. kNoProduction if several could have.
[[nodiscard]] ProductionId only_unbalanced_production(const Bytecode& bytecode);

/// The error of a `]` without its `[` at `position` of a word of age `age`.
[[nodiscard]] RuntimeError
unmatched_bracket(const Bytecode& bytecode, Code code, std::uint64_t position, std::uint32_t age);

} // namespace lsys
