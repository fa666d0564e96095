// SPDX-License-Identifier: MIT
// SweepNeighbours: the modules that a sweep has visited, as contexts see them from the next module.
// If all contexts are one module, the nearest is enough. Else a list of cells begins at each place:
// the branches there, then the nearest module, whose list continues behind it. Only cells that
// a context can reach are kept, so their number depends on the number of open branches, not on the
// length of the word.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsys {

/// How far contexts reach.
struct SweepReach {
    std::uint32_t items = 0;   // modules and branches in a row
    std::uint32_t nesting = 0; // branches within branches
};

class SweepNeighbours {
public:
    static constexpr std::uint32_t kEnd = 0xFFFFFFFFu;
    /// A module or a branch.
    struct Cell {
        const float* parameters = nullptr; // of a module
        SymbolId symbol = kNoSymbol;       // kNoSymbol: a branch
        std::uint32_t rest = kEnd;         // the list after the module or branch
        std::uint32_t inner = kEnd;        // the list in a branch
        std::uint32_t module = kEnd;       // of a branch: the first module after it in its list
    };

    /// The nearest module that the sweep has visited on its path. kNoSymbol: none.
    struct Module {
        SymbolId symbol = kNoSymbol;
        const float* parameters = nullptr;
    };

    explicit SweepNeighbours(SweepReach reach)
        : reach_(reach), has_cells_(reach.items > 1 || reach.nesting > 0),
          cells_(has_cells_ ? kFirstCapacity : 0) {}

    /// Whether the nearest module has this symbol; if so sets `parameters` to its parameters.
    [[nodiscard]] bool is_nearest(SymbolId symbol, const float*& parameters) const {
        if (!has_cells_) {
            parameters = nearest_.parameters;
            return nearest_.symbol == symbol;
        }
        const std::uint32_t list = module_of(here_);
        if (list == kEnd || cells_[list].symbol != symbol) {
            return false;
        }
        parameters = cells_[list].parameters;
        return true;
    }
    /// The list at the current place, an index for cell(), for contexts of more than one module.
    [[nodiscard]] std::uint32_t here() const { return here_; }
    [[nodiscard]] const Cell& cell(std::uint32_t index) const { return cells_[index]; }
    /// The first module of a list, or kEnd.
    [[nodiscard]] std::uint32_t module_of(std::uint32_t list) const {
        return list == kEnd || cells_[list].symbol != kNoSymbol ? list : cells_[list].module;
    }

    // Fields are copied one by one: a copy of a whole struct would wait for the stores of its
    // fields.

    /// Passes a module.
    void pass(SymbolId symbol, const float* parameters) {
        if (!has_cells_) {
            nearest_.symbol = symbol;
            nearest_.parameters = parameters;
            return;
        }
        Cell& cell = next_cell();
        cell.parameters = parameters;
        cell.symbol = symbol;
        cell.rest = here_;
        here_ = count_++;
    }
    /// For a sweep towards the base: enters a branch at its `]`.
    void enter_at_end() {
        enter_at_begin();
        nearest_.symbol = kNoSymbol;
        here_ = kEnd;
    }
    /// Leaves the branch at its `[`. A `[` without its `]` is a branch that reaches to the end of
    /// the word.
    void leave_at_begin() {
        if (!has_cells_) {
            leave_at_end();
            return;
        }
        Cell& cell = next_cell();
        cell.symbol = kNoSymbol;
        cell.inner = here_;
        here_ = depth_ == 0 ? kEnd : outer_[--depth_].here;
        cell.rest = here_;
        cell.module = module_of(here_);
        here_ = count_++;
    }
    /// For a sweep towards the tips: enters a branch at its `[`, and leaves it at its `]`.
    void enter_at_begin() {
        if (depth_ == outer_.size()) {
            outer_.resize(2 * outer_.size() + kFirstDepth);
        }
        Outer& outer = outer_[depth_++];
        outer.here = here_;
        if (!has_cells_) {
            outer.parameters = nearest_.parameters;
            outer.symbol = nearest_.symbol;
        }
    }
    void leave_at_end() {
        if (depth_ == 0) {
            nearest_.symbol = kNoSymbol;
            here_ = kEnd;
            return;
        }
        const Outer& outer = outer_[--depth_];
        here_ = outer.here;
        if (!has_cells_) {
            nearest_.parameters = outer.parameters;
            nearest_.symbol = outer.symbol;
        }
    }

private:
    static constexpr std::size_t kFirstCapacity = 512;
    static constexpr std::size_t kFirstDepth = 16;

    /// nearest_ and here_ where a branch was entered.
    struct Outer {
        const float* parameters = nullptr;
        SymbolId symbol = kNoSymbol;
        std::uint32_t here = kEnd;
    };

    /// The cell to be used next, with number count_.
    [[nodiscard]] Cell& next_cell() {
        if (count_ == cells_.size()) {
            drop_unreachable();
        }
        return cells_[count_];
    }
    /// Keeps the cells within reach of here_ and outer_.
    void drop_unreachable();
    /// Copies the cells within `reach` of a list to kept_; returns the list there.
    [[nodiscard]] std::uint32_t keep(std::uint32_t list, SweepReach reach);

    SweepReach reach_;
    bool has_cells_;
    std::vector<Cell> cells_;
    std::vector<Cell> kept_; // used by drop_unreachable()
    std::uint32_t here_ = kEnd;
    std::vector<Outer> outer_; // the first depth_ belong to the open branches
    std::size_t depth_ = 0;
    std::uint32_t count_ = 0; // cells in use
    Module nearest_;
};

} // namespace lsys
