#include "compiler/resolve/impl/productions.h"

#include "compiler/resolve/impl/definitions.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace lsys {

ProductionResolver::ProductionResolver(ModuleReading& reading, ConstantTable& constants)
    : reading_(reading), resolution_(reading.resolution), heads_(reading, constants),
      classes_(reading.resolution.program), first_of_name_(reading.resolution.names.count()) {
    resolution_.program.productions.reserve(resolution_.ast.productions.size());
}

bool ProductionResolver::is_first_of_name(const ProductionNode& node) {
    SourceSpan& first = first_of_name_[index_of(node.name)];
    if (first.file == kNoFile) {
        first = node.name_span;
        return true;
    }
    report_duplicate(resolution_, node.name_span, first,
                     fmt::format("production {}", quoted(resolution_.text(node.name))));
    return false;
}

void ProductionResolver::resolve(const ProductionNode& node, SourceSpan statement) {
    bool ok = is_first_of_name(node);
    Production production;
    production.name = node.name;
    production.stage = node.stage;
    production.name_span = node.name_span;
    production.span = statement;
    reading_.expressions.begin_statement();
    if (!heads_.resolve(node, production)) {
        reading_.expressions.set_formals_incomplete();
        ok = false;
    }
    resolve_condition(node.condition, production);
    production.successor = resolve_word(reading_, node.successor, ExpressionPlace::Successor);
    check_draws(production.successor);
    reading_.splits.finish();
    if (!ok) {
        resolution_.program.has_all_statements = false;
        return;
    }
    if (production.stage != Stage::Rewrite) {
        later_[production.stage == Stage::Interpret ? 1 : 0].push_back(std::move(production));
        return;
    }
    resolution_.program.productions.push_back(std::move(production));
    classes_.classify_last();
}

void ProductionResolver::finish() {
    for (std::vector<Production>& of_stage : later_) {
        for (Production& production : of_stage) {
            resolution_.program.productions.push_back(std::move(production));
            classes_.classify_last();
        }
    }
}

void ProductionResolver::resolve_condition(const ConditionNode& node, Production& production) {
    production.condition_span = node.span;
    if (node.condition != kNoExpression) {
        production.condition =
            reading_.expressions.resolve(node.condition, ExpressionPlace::Condition);
        production.condition_span = resolution_.ast.expression(node.condition).span();
    }
    if (node.probability != kNoExpression) {
        production.stochastic = true;
        production.weight = weight_of(node.probability);
        production.weight_span = resolution_.ast.expression(node.probability).span();
    }
}

/// The probability, or NaN after an error.
float ProductionResolver::weight_of(ExpressionId probability) {
    constexpr float kInError = std::numeric_limits<float>::quiet_NaN();
    const ValueId value = reading_.expressions.resolve(probability, ExpressionPlace::Probability);
    const std::optional<float> weight = reading_.expressions.constant_value(value);
    if (!weight) {
        return kInError;
    }
    const bool any = resolution_.program.settings.weights == WeightRule::Any;
    if (std::isfinite(*weight) && *weight > 0.0F && (*weight <= 1.0F || any)) {
        return *weight;
    }
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::BadProbability, resolution_.ast.expression(probability).span(),
        fmt::format("{} is not a probability", *weight));
    if (*weight > 1.0F && std::isfinite(*weight)) {
        error.help.emplace_back("probabilities lie above 0 and go up to 1; for weights that are "
                                "normalised, write `#set weights any;`");
    } else {
        error.help.emplace_back(any ? "weights lie above 0"
                                    : "probabilities lie above 0 and go up to 1");
    }
    return kInError;
}

void ProductionResolver::check_draws(const ProgramWord& successor) {
    const bool by_pass = resolution_.program.settings.rewriting == RewritingMode::Sequential;
    const std::uint32_t max_draws = by_pass ? kMaxSequentialDraws : kMaxOperand;
    if (successor.draw_count > max_draws) {
        resolution_.diagnostics.add(
            DiagnosticCode::TooManyRanges, successor.span,
            fmt::format("{} random ranges in one successor; {} are possible{}",
                        successor.draw_count, max_draws,
                        by_pass ? " in sequential rewriting" : ""));
    }
}

} // namespace lsys
