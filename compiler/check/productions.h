// Productions: head, condition, probability and successor, and the rules and groups they form.
#pragma once

#include "compiler/check/constants.h"
#include "compiler/check/heads.h"
#include "compiler/check/production_classes.h"
#include "compiler/check/words.h"

#include <vector>

namespace lsys {

class ProductionResolver {
public:
    ProductionResolver(ModuleReading& reading, ConstantTable& constants);

    void resolve(const ProductionNode& node, SourceSpan statement);

private:
    [[nodiscard]] bool is_first_of_name(const ProductionNode& node);
    void resolve_condition(const ConditionNode& node, Production& production);
    [[nodiscard]] float weight_of(ExpressionId probability);
    void check_draws(const ProgramWord& successor);

    ModuleReading& reading_;
    Resolution& resolution_;
    HeadResolver heads_;
    ProductionClasses classes_;
    std::vector<SourceSpan> first_of_name_; // by name; of kNoFile if there is none
};

} // namespace lsys
