// The messages of ExpressionResolver.
#include "compiler/bytecode/distributions.h"
#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/folding_faults.h"
#include "grammar/base/characters.h"
#include "grammar/base/synonyms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

/// Whether a word of `text` is `name`.
bool has_word(std::string_view text, std::string_view name) {
    for (std::size_t at = text.find(name); at != std::string_view::npos;
         at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if ((at == 0 || !is_word_character(text[at - 1])) &&
            (end == text.size() || !is_word_character(text[end]))) {
            return true;
        }
    }
    return false;
}

/// The texts between the commas of a call's parentheses.
std::vector<std::string_view> arguments_in(std::string_view call) {
    std::vector<std::string_view> arguments;
    const std::size_t open = call.find('(');
    if (open == std::string_view::npos || !call.ends_with(')')) {
        return arguments;
    }
    const std::string_view inside = call.substr(open + 1, call.size() - open - 2);
    int depth = 0;
    std::size_t begin = 0;
    for (std::size_t at = 0; at <= inside.size(); ++at) {
        const char c = at < inside.size() ? inside[at] : ',';
        depth += c == '(' || c == '{' ? 1 : c == ')' || c == '}' ? -1 : 0;
        if (c == ',' && depth == 0) {
            const std::string_view argument = inside.substr(begin, at - begin);
            const std::size_t first = argument.find_first_not_of(" \t\r\n");
            if (first != std::string_view::npos) {
                arguments.push_back(
                    argument.substr(first, argument.find_last_not_of(" \t\r\n") + 1 - first));
            }
            begin = at + 1;
        }
    }
    return arguments;
}

/// The text that can replace a call of another language's function; empty: none is sure enough.
std::string replaced_call(const Synonym& synonym, std::string_view call) {
    const std::vector<std::string_view> arguments = arguments_in(call);
    const std::string_view spelling = synonym.spelling;
    if (spelling == "{a, b}" || (spelling == "{0, 1}" && arguments.size() == 2)) {
        return arguments.size() == 2 ? fmt::format("{{{}, {}}}", arguments[0], arguments[1])
                                     : std::string();
    }
    if (spelling == "{0, 1}") {
        return std::string(spelling);
    }
    if (spelling == "{0, x}") {
        return arguments.size() == 1 ? fmt::format("{{0, {}}}", arguments[0]) : std::string();
    }
    const std::vector<std::string_view> wanted = arguments_in(spelling);
    const std::size_t open = spelling.find('(');
    const bool is_call = open != std::string_view::npos && spelling.ends_with(')') &&
                         is_identifier(spelling.substr(0, open));
    return is_call && wanted.size() == arguments.size()
               ? std::string(spelling.substr(0, open)) + std::string(call.substr(call.find('(')))
               : std::string();
}

} // namespace

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
    if (formals_incomplete_ || files_missing_ || attempted_.defines(text) ||
        resolution_.options.part) {
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
    if (user_functions_.contains(name)) {
        error.help.push_back(fmt::format("functions take parentheses: `{}(x)`", text));
        return;
    }
    const auto exists = [this](std::string_view function) {
        const NameId known = resolution_.names.find(function);
        return known != kNoName && functions_.contains(known);
    };
    if (const Synonym* const synonym = find_synonym(SynonymKind::Name, text, exists)) {
        error.help.push_back(help_for(*synonym, text));
        const bool is_value = synonym->spelling == "step()" || synonym->spelling == "1" ||
                              synonym->spelling == "0" || synonym->spelling == "{0, 1}";
        if (is_value) {
            error.fixes.push_back({fmt::format("write `{}`", synonym->spelling),
                                   {{expression.span(), std::string(synonym->spelling)}},
                                   false});
        }
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
    if (nearest.empty() && is_only_choice(text, expression)) {
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

/// The smallest place of a fault: a divisor that is zero, the `^` of a power, else the expression.
SourceSpan ExpressionResolver::fault_place(Opcode opcode,
                                           std::optional<float> right,
                                           const Expression& expression) const {
    if ((opcode == Opcode::Divide || opcode == Opcode::Mod) && right == 0.0F) {
        return resolution_.ast.expression(operand(expression, 1)).span();
    }
    if (opcode == Opcode::Power && expression.kind == ExpressionKind::Binary) {
        const SourceSpan left = resolution_.ast.expression(expression.left).span();
        const std::string_view text = resolution_.sources.file(left.file).text();
        const std::size_t caret = text.find('^', left.end);
        if (left.file == expression.file && caret < expression.end) {
            const auto at = static_cast<std::uint32_t>(caret);
            return {left.file, at, at + 1};
        }
    }
    return expression.span();
}

/// Whether the parameter of the production, which has only one, must be meant by `text`: both are
/// one letter, there are no constants, and nothing else after the predecessor reads the parameter.
bool ExpressionResolver::is_only_choice(std::string_view text, const Expression& unknown) const {
    if (formals_.size() != 1 || text.size() != 1 || !resolution_.program.constants.empty() ||
        formal_spans_[0].file != unknown.file || formal_spans_[0].end > unknown.begin) {
        return false;
    }
    const std::string_view formal = resolution_.text(formals_[0]);
    const std::string_view all = resolution_.sources.file(unknown.file).text();
    const std::size_t begin = formal_spans_[0].end;
    constexpr std::size_t kMaxStatement = 4096;
    const std::string_view rest = all.substr(begin, kMaxStatement);
    return formal.size() == 1 && !has_word(rest.substr(0, rest.find(';')), formal);
}

void ExpressionResolver::report_unknown_function(const Expression& expression, NameId function) {
    const std::string_view text = resolution_.text(function);
    if (attempted_.defines(text) || resolution_.options.part) {
        return;
    }
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
    const auto exists = [this](std::string_view known) {
        const NameId id = resolution_.names.find(known);
        return id != kNoName && functions_.contains(id);
    };
    if (const Synonym* const synonym = find_synonym(SynonymKind::Function, text, exists)) {
        const std::string call(resolution_.sources.text(expression.span()));
        const std::string replacement = replaced_call(*synonym, call);
        Synonym shown = *synonym;
        if (shown.spelling == "{0, 1}" && arguments_in(call).size() == 2) {
            shown.spelling = "{a, b}";
        }
        error.help.push_back(help_for(shown, text));
        if (!replacement.empty()) {
            error.fixes.push_back({fmt::format("write `{}`", replacement),
                                   {{expression.span(), replacement}},
                                   false});
        }
        return;
    }
    std::vector<std::string_view> known = function_names();
    for (const auto& [name_of_function, user] : user_functions_) {
        known.push_back(resolution_.text(name_of_function));
    }
    std::sort(known.begin(), known.end());
    const std::string nearest = suggestions_.nearest(text, known);
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
    case ExpressionPlace::Function:
        where = "in a function";
        break;
    case ExpressionPlace::Curve:
        where = "in a curve";
        break;
    case ExpressionPlace::Material:
        where = "in a material";
        break;
    case ExpressionPlace::Condition:
        where = "in a condition";
        break;
    case ExpressionPlace::Probability:
    case ExpressionPlace::AxiomProbability:
        where = "in a probability";
        break;
    default:
        break;
    }
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::RangeNotAllowed, expression.span(),
        is_range ? fmt::format("a {} cannot stand {}",
                               expression.kind == ExpressionKind::Range ? "random range"
                                                                        : "random number",
                               where)
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

/// Whether a distribution with these arguments can be drawn from, as far as they are known.
bool ExpressionResolver::check_distribution_of(const Expression& expression,
                                               Opcode opcode,
                                               ValueId first,
                                               ValueId second) {
    const auto x = constant_value(first);
    const auto y = constant_value(second);
    // Arguments that are not known are taken to be right.
    const bool has_mean = opcode != Opcode::Binomial;
    const DistributionFault fault =
        check_distribution(opcode, x.value_or(0.0F), y.value_or(has_mean ? 0.0F : 1.0F));
    if (first == kPoison || second == kPoison || fault == DistributionFault::None) {
        return true;
    }
    const std::string_view name = info(opcode).mnemonic;
    Diagnostic& error = resolution_.diagnostics.add(
        DiagnosticCode::BadDistribution, expression.span(),
        fmt::format("`{}` cannot be drawn from: {}", name, describe(opcode, fault)));
    const bool is_first = fault == DistributionFault::Mean || fault == DistributionFault::Trials;
    error.label = fmt::format("it is {}", is_first ? *x : *y);
    return false;
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
            // The divisor may stand in a function.
            const SourceSpan divisor = zero_divisors_.empty()
                                           ? resolution_.ast.expression(root).span()
                                           : zero_divisors_.back();
            Diagnostic& error = resolution_.diagnostics.add(
                DiagnosticCode::NotFinite, divisor, fmt::format("{} is never finite", what));
            error.label = "division by zero";
            return;
        }
    }
    for (const SourceSpan divisor : zero_divisors_) {
        resolution_.diagnostics.add(DiagnosticCode::DivisionByZero, divisor, "division by zero");
    }
}

} // namespace lsys
