// SPDX-License-Identifier: MIT
// The truth of the conditions of the productions of one module over all values of its parameters.
// Shared by the checks for gaps, overlaps and unused productions.
#pragma once

#include "compiler/growth/condition_grid.h"
#include "compiler/growth/production_index.h"
#include "compiler/lint/checks.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lsys {

/// The truth of conditions: row i is production productions[i], column c is point c of the grid.
struct RuleTable {
    std::vector<std::uint32_t> productions; // indices of productions, in file order
    analysis::ConditionGrid grid;
    std::uint64_t points = 0; // number of columns
    std::vector<bool> truth;  // row-major

    [[nodiscard]] bool holds(std::size_t row, std::uint64_t point) const {
        return truth[row * points + point];
    }
};

/// The table of the productions of one symbol. Returns nothing if a condition has no grid
/// (condition_grid.h) or the table would be too large.
[[nodiscard]] std::optional<RuleTable> make_rule_table(const Bytecode& bytecode,
                                                       const analysis::ProductionIndex& index,
                                                       SymbolId symbol,
                                                       std::vector<std::uint32_t> productions);

/// The module at a point as an author would write it: `A(2, y)`. Parameters that no condition reads
/// are written as their names in `production`.
[[nodiscard]] std::string module_at(const CheckInput& input,
                                    const Production& production,
                                    SymbolId symbol,
                                    const RuleTable& table,
                                    std::uint64_t point);

/// Whether the text of the condition names a constant, whose value a user may change.
[[nodiscard]] bool names_constant(const CheckInput& input, const Production& production);

} // namespace lsys
