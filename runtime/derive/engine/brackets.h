// Whether every `]` has its `[`. A word may be fed in pieces.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/derive.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

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
    std::vector<std::int8_t> change_; // of the depth, by code
    std::int64_t depth_ = 0;
    bool has_close_ = false;
};

/// The production that must have written an unmatched `]`: the only one whose successor closes
/// what it has not opened, in a program whose axiom does not. kNoProduction if that is not known.
[[nodiscard]] ProductionId only_unbalanced_production(const Bytecode& bytecode);

/// The error of a `]` without its `[` at `position` of a word of age `age`.
[[nodiscard]] RuntimeError
unmatched_bracket(const Bytecode& bytecode, Code code, std::uint64_t position, std::uint32_t age);

} // namespace lsys
