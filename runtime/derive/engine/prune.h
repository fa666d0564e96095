// SPDX-License-Identifier: MIT
// Cuts: a module with the turtle operation Cut removes the rest of its branch, up to the `]` that
// closes the branch. Cuts are made at the start of a generation, before anything is matched.
#pragma once

#include "runtime/derive/engine/match.h"
#include "runtime/derive/word.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Finds the modules that cuts remove from a word, which may come in pieces.
class Pruner {
public:
    explicit Pruner(const Bytecode& bytecode);

    /// Whether the program has a module that cuts.
    [[nodiscard]] bool can_cut() const { return can_cut_; }

    /// Calls keep(index, parameter) for each module that stays, in order, with the number of
    /// parameters stored before it in this piece.
    template <typename C, typename Keep>
    void each_kept(const C* codes, std::uint64_t count, Keep&& keep) {
        std::uint64_t parameter = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            const Kind kind = kinds_[codes[i]];
            if (depth_ == 0 && kind.role == Role::Cut) {
                depth_ = 1;
            } else if (depth_ > 0 && kind.role == Role::Open) {
                ++depth_;
            } else if (depth_ > 0 && kind.role == Role::Close) {
                --depth_;
                if (depth_ == 0) {
                    keep(i, parameter);
                }
            } else if (depth_ == 0) {
                keep(i, parameter);
            }
            parameter += kind.stored;
        }
    }
    /// Whether a piece begins within a cut branch or holds a cut.
    template <typename C>
    [[nodiscard]] bool may_prune(const C* codes, std::uint64_t count) const {
        if (depth_ > 0) {
            return true;
        }
        for (std::uint64_t i = 0; i < count; ++i) {
            if (kinds_[codes[i]].role == Role::Cut) {
                return true;
            }
        }
        return false;
    }
    /// The number of parameters that a module of this code stores.
    [[nodiscard]] std::uint32_t stored(Code code) const { return kinds_[code].stored; }
    /// Starts a new word.
    void restart() { depth_ = 0; }

private:
    enum class Role : std::uint8_t { Other, Cut, Open, Close };
    struct Kind {
        Role role = Role::Other;
        std::uint32_t stored = 0; // parameters in the word
    };
    std::vector<Kind> kinds_; // by code
    std::uint64_t depth_ = 0; // open brackets since the cut, the cut branch included; 0: no cut
    bool can_cut_ = false;    // some symbol is a cut
};

/// Modules and parameters of a word after its cuts.
struct PrunedSize {
    std::uint64_t modules = 0;
    std::uint64_t parameters = 0;
};
/// The size of `word` after its cuts; the size of `word` itself if it has none.
[[nodiscard]] PrunedSize pruned_size(Pruner& pruner, const Word& word);
/// Writes the remaining modules to `out`. Precondition: `out` has the size of pruned_size().
void write_pruned(Pruner& pruner, const Word& word, Word& out);

} // namespace lsys
