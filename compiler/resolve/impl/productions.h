// Productions: head, condition, probability and successor, and the rules and groups they form.
#pragma once

#include "compiler/resolve/impl/constants.h"
#include "compiler/resolve/impl/heads.h"
#include "compiler/resolve/impl/production_classes.h"
#include "compiler/resolve/impl/words.h"

#include <array>
#include <vector>

namespace lsys {

class ProductionResolver {
public:
    ProductionResolver(ModuleReading& reading, ConstantTable& constants);

    void resolve(const ProductionNode& node, SourceSpan statement);
    /// After the last: productions of later stages take their place behind the others.
    void finish();

private:
    [[nodiscard]] bool is_first_of_name(const ProductionNode& node);
    void resolve_condition(const ConditionNode& node, Production& production);
    [[nodiscard]] float weight_of(ExpressionId probability);
    void check_draws(const ProgramWord& successor);

    ModuleReading& reading_;
    Resolution& resolution_;
    HeadResolver heads_;
    ProductionClasses classes_;
    std::array<std::vector<Production>, 2> later_; // of Decompose, of Interpret
    std::vector<SourceSpan> first_of_name_;        // by name; of kNoFile if there is none
};

} // namespace lsys
