// Productions: head, condition, probability and successor, and the rules and groups they form.
#pragma once

#include "compiler/check/constants.h"
#include "compiler/check/heads.h"
#include "compiler/check/words.h"

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace lsys {

class ProductionResolver {
public:
    ProductionResolver(ModuleReading& reading, ConstantTable& constants);

    void resolve(std::uint32_t index, const ProductionNode& node, SourceSpan statement);

private:
    [[nodiscard]] bool is_first_of_name(std::uint32_t index, const ProductionNode& node);
    void resolve_condition(const ConditionNode& node, Production& production);
    [[nodiscard]] float weight_of(ExpressionId probability);
    void check_draws(const ProgramWord& successor);
    void classify(Production& production);

    ModuleReading& reading_;
    Resolution& resolution_;
    HeadResolver heads_;
    std::vector<std::uint32_t> first_of_name_;             // by name: in Ast::productions, or kNone
    std::unordered_map<std::string, std::uint32_t> rules_; // by predecessor
    std::unordered_map<std::string, std::uint32_t> groups_; // by predecessor and contexts
};

} // namespace lsys
