// SPDX-License-Identifier: MIT
// Resolves productions: head, condition, probability and successor; and numbers the rules and
// groups of productions.
#pragma once

#include "compiler/resolve/impl/constants.h"
#include "compiler/resolve/impl/heads.h"
#include "compiler/resolve/impl/production_classes.h"
#include "compiler/resolve/impl/words.h"

#include <array>
#include <vector>

namespace lsys {

/// Returns `weight`, or NaN after reporting that it is not a valid probability or weight.
[[nodiscard]] float checked_weight(Resolution& resolution, float weight, SourceSpan span);

class ProductionResolver {
public:
    ProductionResolver(ModuleReading& reading, ConstantTable& constants);

    /// Adds a production to the Program, or reports its errors.
    void resolve(const ProductionNode& node, SourceSpan statement);
    /// Call after the last production: appends the productions of later stages.
    void finish();

private:
    /// Returns false after reporting an earlier production of the same name.
    [[nodiscard]] bool check_first_of_name(const ProductionNode& node);
    void resolve_condition(const ConditionNode& node, Production& production);
    void resolve_locals(ListRange locals, Production& production);
    /// Returns false after reporting that a parameter or an earlier local value has the name. Warns
    /// of a constant with the name.
    [[nodiscard]] bool check_new_local(const LocalNode& node, const Production& production);
    void resolve_weight(ExpressionId probability, Production& production);
    /// Checks that the successor of a #down or #up is its predecessor with other parameters.
    [[nodiscard]] bool check_sweep(const Production& production);
    /// Reports a successor with too many random ranges.
    void check_draws(const ProgramWord& successor);

    ModuleReading& reading_;
    Resolution& resolution_;
    ConstantTable& constants_;
    HeadResolver heads_;
    ProductionClasses classes_;
    /// By stage: productions of stages after Rewrite, kept for finish(); empty for Rewrite.
    std::array<std::vector<Production>, kCountOf<Stage>> later_;
    std::vector<SourceSpan> first_of_name_; // by name: first production, or kNoFile
};

} // namespace lsys
