// The truth of the conditions of one module's productions over all values of its parameters: what
// the checks of gaps, overlaps and productions that are never used share.
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

/// Row i is production productions[i]; column c is a point of the grid.
struct RuleTable {
    std::vector<std::uint32_t> productions; // in file order
    analysis::ConditionGrid grid;
    std::uint64_t points = 0;
    std::vector<bool> truth; // row-major

    [[nodiscard]] bool holds(std::size_t row, std::uint64_t point) const {
        return truth[row * points + point];
    }
};

/// The table of some productions of one symbol. Nothing if a condition is of a form that has no
/// grid or the table would be large.
[[nodiscard]] std::optional<RuleTable> make_rule_table(const Bytecode& bytecode,
                                                       const analysis::ProductionIndex& index,
                                                       SymbolId symbol,
                                                       std::vector<std::uint32_t> productions);

/// `A(2, y)`: the module at a point, as the author would write it; parameters that no condition
/// reads keep the names of `production`.
[[nodiscard]] std::string module_at(const CheckInput& input,
                                    const Production& production,
                                    SymbolId symbol,
                                    const RuleTable& table,
                                    std::uint64_t point);

/// Whether a condition's text names a constant: what it is worth may be turned by the user.
[[nodiscard]] bool names_constant(const CheckInput& input, const Production& production);

} // namespace lsys
