// SPDX-License-Identifier: MIT
// Values that are known before the word is derived: sizes of arrays, tests of loops.
#pragma once

#include "grammar/dialects/impl/foreign_expression.h"

#include <cstdint>
#include <map>
#include <optional>

namespace lsys {

/// Evaluates .lsys expressions without random numbers, formals and `step()`.
class KnownValues {
public:
    explicit KnownValues(const ForeignExpressions& tree) : tree_(tree) {}

    /// The value of an expression, or nullopt if it is not known or not finite.
    [[nodiscard]] std::optional<double> of(ForeignId expression);

private:
    /// of() for a node; `depth`: levels of the recursion so far.
    [[nodiscard]] std::optional<double> of_node(const ForeignNode& node, int depth);
    /// of() for a local value.
    [[nodiscard]] std::optional<double> of_local(std::uint32_t index, int depth);

    const ForeignExpressions& tree_;
    std::map<std::uint32_t, std::optional<double>> locals_; // values found before
};

} // namespace lsys
