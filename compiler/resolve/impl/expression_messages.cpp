// The messages of ExpressionResolver.
#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/folding_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lsys {

std::string reason_for_fault(Opcode opcode, float x, float y) {
    if (!std::isfinite(x) || !std::isfinite(y)) {
        return "an operand is not finite";
    }
    switch (opcode) {
    case Opcode::Divide:
    case Opcode::Mod:
        return y == 0.0F ? "division by zero" : "the quotient is too large for binary32";
    case Opcode::Power:
        if (x == 0.0F) {
            return "zero has no negative powers";
        }
        return x < 0.0F && y != std::floor(y) ? "a negative number has no fractional powers"
                                              : "the power is too large for binary32";
    case Opcode::Sqrt:
        return "a negative number has no square root";
    case Opcode::Log:
        return x == 0.0F ? "the logarithm of zero is infinite"
                         : "a negative number has no logarithm";
    case Opcode::Asin:
    case Opcode::Acos:
        return "only numbers from -1 to 1 are the sine or cosine of an angle";
    case Opcode::Tan:
        return "the tangent of this angle is infinite";
    default:
        return "the result is too large for binary32";
    }
}

void ExpressionResolver::report_unknown_name(const Expression& expression) {
    const NameId name = expression.name;
    const std::string_view text = resolution_.text(name);
    const ConstantState state = constants_.state(name);
    if (state == ConstantState::Failed || !first_report_of(name)) {
        return;
    }
    if (state == ConstantState::Later) {
        Diagnostic& error =
            resolution_.diagnostics.add(DiagnosticCode::UsedBeforeDefinition, expression.span(),
                                        fmt::format("`{}` is used before its definition", text));
        error.labels.push_back({constants_.definition_span(name), "it is defined here"});
        error.help.emplace_back("move the definition above this statement");
        return;
    }
    if (locals_.contains(name)) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::UsedBeforeDefinition, expression.span(),
            fmt::format("the local value `{}` is not known here", text));
        error.help.emplace_back("local values are computed after the condition, from left to "
                                "right, and serve the values after them and the successor");
        return;
    }
    if (formals_incomplete_ || files_missing_ || attempted_.defines(text)) {
        return;
    }
    Diagnostic& error = resolution_.diagnostics.add(DiagnosticCode::UnknownName, expression.span(),
                                                    fmt::format("unknown name `{}`", text));
    error.label = formals_.empty() ? "no constant of this name is defined"
                                   : "neither a parameter of this production nor a constant";
    if (functions_.contains(name)) {
        error.help.push_back(fmt::format("functions take parentheses: `{}({})`", text,
                                         functions_.at(name).argument_count == 0 ? "" : "x"));
        return;
    }
    if (text == "and" || text == "or" || text == "not") {
        error.help.emplace_back("the operators are `&&`, `||` and `!`");
        return;
    }
    std::vector<std::string_view> candidates;
    for (const NameId formal : formals_) {
        candidates.push_back(resolution_.text(formal));
    }
    for (const auto& [local, value] : locals_) {
        if (value != kNoValue) {
            candidates.push_back(resolution_.text(local));
        }
    }
    if (suggestions_.may_compare(candidates.size() + resolution_.program.constants.size())) {
        const std::vector<std::string_view> constants = constants_.known_names();
        candidates.insert(candidates.end(), constants.begin(), constants.end());
    }
    std::string nearest = suggestions_.nearest(text, candidates);
    if (nearest.empty() && formals_.size() == 1) {
        nearest = resolution_.text(formals_[0]);
    }
    if (!nearest.empty()) {
        suggest(error, expression.span(), nearest);
    }
    if (!formals_.empty() && formals_.size() <= 16) {
        std::string list;
        for (const NameId formal : formals_) {
            list += fmt::format("{}`{}`", list.empty() ? "" : ", ", resolution_.text(formal));
        }
        error.notes.push_back(fmt::format("the parameters of this production: {}", list));
    } else if (formals_.empty() && nearest.empty()) {
        error.help.push_back(fmt::format("define it before this statement: `#define {} 1;`", text));
    }
}

void ExpressionResolver::report_unknown_function(const Expression& expression, NameId function) {
    const std::string_view text = resolution_.text(function);
    const SourceSpan name{expression.file, expression.begin,
                          expression.begin + static_cast<std::uint32_t>(text.size())};
    Diagnostic& error = resolution_.diagnostics.add(DiagnosticCode::UnknownFunction, name,
                                                    fmt::format("unknown function `{}`", text));
    if (formal_of_[index_of(function)] != kNone ||
        constants_.state(function) == ConstantState::Known) {
        error.help.push_back(
            fmt::format("`{0}` is a number; to multiply, write `{0} * (...)`", text));
        return;
    }
    constexpr std::array<std::string_view, 6> kDraws{"rand",    "random",  "rnd",
                                                     "uniform", "randint", "frand"};
    if (std::ranges::find(kDraws, text) != kDraws.end()) {
        error.help.emplace_back("a number between `a` and `b` is drawn at random by `{a, b}`");
        return;
    }
    const std::string nearest = suggestions_.nearest(text, function_names());
    if (!nearest.empty()) {
        suggest(error, name, nearest);
    }
}

void ExpressionResolver::report_not_allowed(const Expression& expression,
                                            ExpressionPlace place,
                                            bool is_range) {
    const char* where = "here";
    switch (place) {
    case ExpressionPlace::Generations:
        where = "in the number of generations";
        break;
    case ExpressionPlace::Bound:
        where = "in the bounds of a `#param`";
        break;
    case ExpressionPlace::Setting:
        where = "in a setting";
        break;
    case ExpressionPlace::Condition:
        where = "in a condition";
        break;
    case ExpressionPlace::Probability:
        where = "in a probability";
        break;
    default:
        break;
    }
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::RangeNotAllowed, expression.span(),
        is_range ? fmt::format("a random range cannot stand {}", where)
                 : fmt::format("`{}` is drawn at random, so it cannot stand {}",
                               resolution_.text(expression.name), where));
    if (!is_range) {
        error.labels.push_back({constants_.definition_span(expression.name), "it is drawn here"});
    } else if (place == ExpressionPlace::Condition) {
        error.help.emplace_back("let productions with probabilities choose: `* ~ 0.5`");
    }
}

bool ExpressionResolver::check_range(const Expression& expression,
                                     ValueId minimum,
                                     ValueId maximum) {
    const auto low = constant_value(minimum);
    const auto high = constant_value(maximum);
    if (!low || !high) {
        return true;
    }
    if (*low > *high) {
        const SourceSpan first = resolution_.ast.expression(expression.left).span();
        const SourceSpan second = resolution_.ast.expression(expression.right).span();
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::BadRangeBounds, expression.span(),
            fmt::format("the minimum {} of this range lies above its maximum {}", *low, *high));
        error.fixes.push_back({"exchange them",
                               {{first, std::string(resolution_.sources.text(second))},
                                {second, std::string(resolution_.sources.text(first))}},
                               true});
        return false;
    }
    if (!std::isfinite(*low) || !std::isfinite(*high) || !std::isfinite(*high - *low)) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::BadRangeBounds, expression.span(), "this range is too wide");
        error.notes.emplace_back("its bounds and its width have to be finite binary32 numbers");
        return false;
    }
    if (*low == *high) {
        Diagnostic& note =
            resolution_.diagnostics.add(DiagnosticCode::ConstantRange, expression.span(),
                                        fmt::format("this range always yields {}", *low));
        note.help.push_back(fmt::format("write `{}`", *low));
    }
    return true;
}

void ExpressionResolver::check_finite(ValueId value, ExpressionId root, ExpressionPlace place) {
    const auto constant = constant_value(value);
    const bool reaches_a_module =
        place == ExpressionPlace::Axiom || place == ExpressionPlace::Successor;
    const char* what = reaches_a_module ? "this parameter" : "this condition";
    if (reaches_a_module || place == ExpressionPlace::Condition) {
        if (constant && !std::isfinite(*constant)) {
            const Culprit culprit = culprit_.value_or(
                Culprit{resolution_.ast.expression(root).span(), "", std::nullopt});
            Diagnostic& error = resolution_.diagnostics.add(
                DiagnosticCode::NotFinite, culprit.span,
                fmt::format("{} is {}", what, std::isnan(*constant) ? "not a number" : "infinite"));
            error.label = culprit.reason;
            if (culprit.definition) {
                error.labels.push_back({*culprit.definition, "it is defined here"});
            }
            return;
        }
        const Value& node = values_[value];
        if (value != kPoison && (node.opcode == Opcode::Divide || node.opcode == Opcode::Mod) &&
            constant_value(node.right) == 0.0F) {
            Diagnostic& error =
                resolution_.diagnostics.add(DiagnosticCode::NotFinite, zero_divisors_.back(),
                                            fmt::format("{} is never finite", what));
            error.label = "division by zero";
            return;
        }
    }
    for (const SourceSpan divisor : zero_divisors_) {
        resolution_.diagnostics.add(DiagnosticCode::DivisionByZero, divisor, "division by zero");
    }
}

} // namespace lsys
