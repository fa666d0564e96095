// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/productions.h"

#include "compiler/resolve/impl/definitions.h"
#include "grammar/ast/reports.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace lsys {

ProductionResolver::ProductionResolver(ModuleReading& reading, ConstantTable& constants)
    : reading_(reading), resolution_(reading.resolution), constants_(constants),
      heads_(reading, constants), classes_(reading.resolution.program),
      first_of_name_(reading.resolution.names.count()) {
    resolution_.program.productions.reserve(resolution_.ast.productions.size());
}

bool ProductionResolver::check_first_of_name(const ProductionNode& node) {
    SourceSpan& first = first_of_name_[index_of(node.name)];
    if (first.file == kNoFile) {
        first = node.name_span;
        return true;
    }
    const std::string_view name = resolution_.text(node.name);
    Diagnostic& error = report_duplicate(resolution_, node.name_span, first,
                                         fmt::format("production {}", quoted(name)));
    if (first.file != node.name_span.file || first.begin == node.name_span.begin) {
        return false; // no fix: another file, or one file that is included twice
    }
    std::string free(name);
    while (!free.empty() && free.back() >= '0' && free.back() <= '9') {
        free.pop_back();
    }
    for (int number = 2; number < 1000; ++number) {
        const std::string candidate = fmt::format("{}{}", free, number);
        if (resolution_.names.find(candidate) == kNoName) {
            error.help.emplace_back("the word after the `#` is a name of your choice, a different "
                                    "one for each production");
            add_fix(error, fmt::format("write `#{}`", candidate), node.name_span, candidate, false);
            break;
        }
    }
    return false;
}

void ProductionResolver::resolve(const ProductionNode& node, SourceSpan statement) {
    bool ok = check_first_of_name(node);
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
    reading_.expressions.reserve_slots(node.locals.count);
    for (std::uint32_t i = 0; i < node.locals.count; ++i) {
        reading_.expressions.expect_local(resolution_.ast.locals[node.locals.first + i].name);
    }
    resolve_condition(node.condition, production);
    resolve_locals(node.locals, production);
    const std::uint64_t errors = resolution_.diagnostics.count(Severity::Error);
    production.successor = resolve_word(reading_, node.successor, ExpressionPlace::Successor);
    const bool has_all_modules = resolution_.diagnostics.count(Severity::Error) == errors;
    for (LocalValue& local : production.locals) {
        local.is_used = reading_.expressions.is_local_used(local.name);
        if (!local.is_used) {
            Diagnostic& warning =
                resolution_.diagnostics.add(DiagnosticCode::UnusedLocal, local.name_span,
                                            fmt::format("the local value {} is never used",
                                                        quoted(resolution_.text(local.name))));
            warning.help.emplace_back("remove it, or use its name in the successor");
        }
    }
    check_draws(production.successor);
    ok = ok && (!has_all_modules || check_sweep(production));
    reading_.splits.finish();
    if (!ok) {
        resolution_.program.has_all_statements = false;
        return;
    }
    if (production.stage != Stage::Rewrite) {
        later_[static_cast<std::size_t>(production.stage)].push_back(std::move(production));
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
        resolve_weight(node.probability, production);
    }
}

void ProductionResolver::resolve_locals(ListRange locals, Production& production) {
    for (std::uint32_t i = 0; i < locals.count; ++i) {
        const LocalNode& node = resolution_.ast.locals[locals.first + i];
        const ValueId value = reading_.expressions.resolve(node.value, ExpressionPlace::Local);
        if (check_new_local(node, production)) {
            const auto slot = static_cast<std::uint32_t>(production.locals.size());
            reading_.expressions.add_local(node.name, value, slot);
            const SourceSpan span{node.name_span.file, node.name_span.begin,
                                  resolution_.ast.expression(node.value).end};
            production.locals.push_back({node.name, node.name_span, span, value, false});
        }
    }
}

bool ProductionResolver::check_new_local(const LocalNode& node, const Production& production) {
    const auto report = [&](const char* what, SourceSpan first) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::DuplicateLocal, node.name_span,
            fmt::format("{} has the name {} already", what, quoted(resolution_.text(node.name))));
        error.labels.push_back({first, "the first is here"});
        const std::string_view name = resolution_.text(node.name);
        const SourceSpan value = resolution_.ast.expression(node.value).span();
        error.help.push_back(fmt::format(
            "it cannot be given a new value: write `let {0}_new = {1}`, and `{0}_new` in the "
            "successor where the new value is meant",
            name, shown(resolution_.sources.text(value))));
        return false;
    };
    for (std::size_t i = 0; i < production.formals.size(); ++i) {
        if (production.formals[i] == node.name) {
            return report("a parameter", production.formal_spans[i]);
        }
    }
    for (const LocalValue& earlier : production.locals) {
        if (earlier.name == node.name) {
            return report("a local value", earlier.name_span);
        }
    }
    if (constants_.state(node.name) == ConstantState::Known) {
        Diagnostic& warning = resolution_.diagnostics.add(
            DiagnosticCode::HiddenConstant, node.name_span,
            fmt::format("the local value {} hides a constant of that name",
                        quoted(resolution_.text(node.name))));
        warning.labels.push_back({constants_.definition_span(node.name), "the constant"});
    }
    return true;
}

/// Resolves the probability or weight after `~`: a number, or with `weights any` an expression.
void ProductionResolver::resolve_weight(ExpressionId probability, Production& production) {
    production.stochastic = true;
    production.weight = std::numeric_limits<float>::quiet_NaN();
    production.weight_span = resolution_.ast.expression(probability).span();
    const ValueId value = reading_.expressions.resolve(probability, ExpressionPlace::Probability);
    const std::optional<float> weight = reading_.expressions.constant_value(value);
    if (!weight) {
        production.weight_value = value;
        return;
    }
    if (value == kPoison) {
        return;
    }
    production.weight = checked_weight(resolution_, *weight, production.weight_span);
}

float checked_weight(Resolution& resolution, float weight, SourceSpan span) {
    const bool any = resolution.program.settings.weights == WeightRule::Any;
    if (std::isfinite(weight) && weight > 0.0F && (weight <= 1.0F || any)) {
        return weight;
    }
    Diagnostic& error = resolution.diagnostics.add(DiagnosticCode::BadProbability, span,
                                                   fmt::format("{} is not a probability", weight));
    constexpr float kAllPercent = 100.0F;
    if (weight > 1.0F && weight <= kAllPercent && weight == std::floor(weight)) {
        const std::string fraction = fmt::format("{:.6g}", weight / kAllPercent);
        add_fix(error, fmt::format("{} percent is written `{}`", weight, fraction), span, fraction,
                false);
        error.help.emplace_back("for weights that need not sum to 1 write `#set weights any;`");
    } else if (weight > 1.0F && std::isfinite(weight)) {
        error.help.emplace_back("probabilities lie above 0 and go up to 1; for weights that are "
                                "normalised, write `#set weights any;`");
    } else {
        error.help.emplace_back(any ? "weights lie above 0"
                                    : "probabilities lie above 0 and go up to 1");
    }
    return std::numeric_limits<float>::quiet_NaN();
}

bool ProductionResolver::check_sweep(const Production& production) {
    if (production.stage != Stage::Down && production.stage != Stage::Up) {
        return true;
    }
    const Program& program = resolution_.program;
    const ProgramWord& successor = production.successor;
    const SymbolId swept = production.predecessor.items[0].symbol;
    if (successor.module_count == 1 && program.modules[successor.first_module].symbol == swept) {
        return true;
    }
    const Symbol& symbol = program.symbol(swept);
    const std::string_view name = resolution_.text(symbol.name);
    const std::string_view keyword = keyword_of(production.stage);
    const bool is_one = successor.module_count == 1;
    const ProgramModule first = is_one ? program.modules[successor.first_module] : ProgramModule{};
    const bool is_same_name = is_one && program.symbol(first.symbol).name == symbol.name;
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::BadSweep,
        successor.module_count == 0 ? production.name_span : successor.span,
        successor.module_count == 0 ? fmt::format("this `{}` erases its module", keyword)
        : !is_one ? fmt::format("`{}` writes one module, not {}", keyword, successor.module_count)
        : is_same_name
            ? fmt::format("`{}` keeps the number of parameters: {} here, {} before", keyword,
                          program.symbol(first.symbol).parameter_count, symbol.parameter_count)
            : fmt::format("`{}` cannot replace {} by {}", keyword, quoted(name),
                          quoted(resolution_.text(program.symbol(first.symbol).name))));
    error.labels.push_back({production.predecessor.span, "the module that is swept"});
    error.notes.emplace_back("a sweep changes parameters, not structure");
    error.help.push_back(
        symbol.parameter_count == 0
            ? fmt::format("give {} a parameter for what the sweep carries: `{}(x)`", quoted(name),
                          name)
            : fmt::format("the successor is {} with {}; other modules belong into a production of "
                          "rewriting",
                          quoted(name), parameters_text(symbol.parameter_count)));
    return false;
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
