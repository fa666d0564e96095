// SPDX-License-Identifier: MIT
// Brackets of words and templates: whether every `]` has its `[`, and every `}` its `{`.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/derive.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// Whether a module of the kind `close`, BranchClose or PolygonClose, has no partner before it in
/// the template.
[[nodiscard]] bool
has_unmatched_close(const Bytecode& bytecode, TableRange codes, SymbolKind close);
/// Whether the production rewrites a bracket, so that the matching bracket of the word may lose its
/// partner.
[[nodiscard]] bool rewrites_bracket(const Bytecode& bytecode, const BytecodeProduction& production);

/// Checks the brackets of a word, which may come in pieces. Branches and polygons are counted
/// separately; a `{` or `}` that a cut removes does not count.
class BracketCounter {
public:
    explicit BracketCounter(const Bytecode& bytecode);

    /// The index in this piece of the first `]` without its `[` or `}` without its `{`, or nothing.
    template <typename C>
    [[nodiscard]] std::optional<std::uint64_t> feed(const C* codes, std::uint64_t count) {
        if (!has_polygon_close_) {
            return has_branch_close_ ? feed_branches(codes, count) : std::nullopt;
        }
        for (std::uint64_t i = 0; i < count; ++i) {
            const Change change = changes_[codes[i]];
            branches_ += change.branches;
            if (cut_ > 0) {
                cut_ += change.branches;
            } else if (change.cuts) {
                cut_ = 1;
            } else {
                polygons_ += change.polygons;
            }
            if (branches_ < 0 || polygons_ < 0) {
                return i;
            }
        }
        return std::nullopt;
    }

private:
    /// feed() for programs without `}`, where cuts do not matter. A loop of its own for speed,
    /// because a streamed derivation checks each module of the last word.
    template <typename C>
    [[nodiscard]] std::optional<std::uint64_t> feed_branches(const C* codes, std::uint64_t count) {
        for (std::uint64_t i = 0; i < count; ++i) {
            branches_ += branch_changes_[codes[i]];
            if (branches_ < 0) {
                return i;
            }
        }
        return std::nullopt;
    }

    struct Change {
        std::int8_t branches = 0; // added to the number of open branches
        std::int8_t polygons = 0; // added to the number of open polygons
        bool cuts = false;        // a `%`: removes the rest of its branch
    };
    std::vector<Change> changes_;             // by code
    std::vector<std::int8_t> branch_changes_; // by code, Change::branches
    std::int64_t branches_ = 0;               // number of open branches
    std::int64_t polygons_ = 0;               // number of open polygons
    std::int64_t cut_ = 0; // number of open brackets since the cut, its branch included; 0: no cut
    bool has_branch_close_ = false;  // the program has modules `]`
    bool has_polygon_close_ = false; // the program has modules `}`
};

/// The production that must have written an unmatched module of the kind `close`, BranchClose or
/// PolygonClose: the only production whose successor has an unmatched one, while the axiom has
/// none. kNoProduction if there are several candidates.
[[nodiscard]] ProductionId only_unbalanced_production(const Bytecode& bytecode, SymbolKind close);

/// The error of a `]` without its `[`, or a `}` without its `{`, at `position` of a word of age
/// `age`.
[[nodiscard]] RuntimeError
unmatched_bracket(const Bytecode& bytecode, Code code, std::uint64_t position, std::uint32_t age);

} // namespace lsys
