// SPDX-License-Identifier: MIT
// The messages of ExpressionResolver.
#include "compiler/bytecode/distributions.h"
#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/folding_faults.h"
#include "compiler/resolve/known_words.h"
#include "grammar/base/characters.h"
#include "grammar/base/synonyms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

bool is_pi(std::string_view name) {
    return name == "pi" || name == "PI" || name == "Pi" || name == "M_PI";
}

/// Offers the angle in degrees for `pi` or `2 * pi` in the argument of `sin`, `cos` or `tan`.
/// Returns false for a `pi` elsewhere.
bool offer_degrees(const SourceMap& sources, SourceSpan pi, Diagnostic& error) {
    const std::string_view text = sources.file(pi.file).text();
    constexpr std::uint32_t kMaxLength = 200; // bytes of an argument
    const std::uint32_t min_open = pi.begin > kMaxLength ? pi.begin - kMaxLength : 0;
    std::uint32_t open = pi.begin;
    for (int depth = 1; depth != 0 && open > min_open; --open) {
        const char c = text[open - 1];
        depth += c == ')' ? 1 : c == '(' ? -1 : 0;
        if (c == ';' || (c == ',' && depth == 1)) {
            return false;
        }
        if (depth == 0) {
            break;
        }
    }
    if (open < 4 || open == min_open || text[open - 1] != '(') {
        return false;
    }
    const std::string_view function = text.substr(open - 4, 3);
    const bool is_word = open > 4 && is_word_character(text[open - 5]);
    if (is_word || (function != "sin" && function != "cos" && function != "tan")) {
        return false;
    }
    const std::string_view before = text.substr(open, pi.begin - open);
    const std::size_t factor_at = before.find_last_not_of(" *");
    const bool has_factor_two =
        factor_at != std::string_view::npos && before[factor_at] == '2' &&
        before.find('*', factor_at) != std::string_view::npos &&
        (factor_at == 0 ||
         std::string_view(" (+-*").find(before[factor_at - 1]) != std::string_view::npos) &&
        before.substr(0, factor_at).find_last_of("/^") == std::string_view::npos;
    const SourceSpan whole{
        pi.file, has_factor_two ? open + static_cast<std::uint32_t>(factor_at) : pi.begin, pi.end};
    const std::string degrees = has_factor_two ? "360" : "180";
    add_fix(error,
            fmt::format("`{}` takes degrees: write `{}` for `{}`", function, degrees,
                        sources.text(whole)),
            whole, degrees, false);
    return true;
}

} // namespace

namespace {

/// Whether `text` contains `name` as a whole word.
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

/// The texts of the arguments of a call.
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
            const std::size_t first = argument.find_first_not_of(kWhitespace);
            if (first != std::string_view::npos) {
                arguments.push_back(
                    argument.substr(first, argument.find_last_not_of(kWhitespace) + 1 - first));
            }
            begin = at + 1;
        }
    }
    return arguments;
}

/// Replaces each parameter in `spelling` by an argument.
std::string with_arguments(std::string_view spelling,
                           const std::vector<std::string_view>& parameters,
                           const std::vector<std::string_view>& arguments) {
    std::string text;
    for (std::size_t at = 0; at < spelling.size();) {
        std::size_t end = at;
        while (end < spelling.size() && is_word_character(spelling[end])) {
            ++end;
        }
        const std::string_view word = spelling.substr(at, std::max<std::size_t>(end - at, 1));
        const auto found = std::find(parameters.begin(), parameters.end(), word);
        if (found == parameters.end()) {
            text += word;
        } else {
            const std::string_view argument =
                arguments[static_cast<std::size_t>(found - parameters.begin())];
            const bool is_plain =
                word == spelling || std::all_of(argument.begin(), argument.end(), [](char c) {
                    return is_word_character(c) || c == '.';
                });
            text += is_plain ? std::string(argument) : fmt::format("({})", argument);
        }
        at += word.size();
    }
    // `(k - 0)` is `k`.
    constexpr std::string_view kZero = " - 0)";
    for (std::size_t at = text.find(kZero); at != std::string::npos; at = text.find(kZero, at)) {
        const std::size_t open = text.rfind('(', at);
        if (open == std::string::npos ||
            !std::all_of(text.begin() + static_cast<std::ptrdiff_t>(open) + 1,
                         text.begin() + static_cast<std::ptrdiff_t>(at),
                         [](char c) { return is_word_character(c) || c == '.'; })) {
            ++at;
            continue;
        }
        text.erase(at, kZero.size());
        text.erase(open, 1);
    }
    return text;
}

/// The text that replaces a call of a function of another language. Empty if the replacement is not
/// certain.
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
    const std::vector<std::string_view> parameters = arguments_in(synonym.word);
    if (!parameters.empty()) {
        return parameters.size() == arguments.size()
                   ? with_arguments(spelling, parameters, arguments)
                   : std::string();
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
    if (state == ConstantState::Failed || !mark_reported(name)) {
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
                                "right; later local values and the successor may use them");
        return;
    }
    if (formals_incomplete_ || files_missing_ ||
        (attempted_.defines(text) && !user_functions_.contains(name)) || resolution_.options.part) {
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
        if (is_pi(text) && offer_degrees(resolution_.sources, expression.span(), error)) {
            return;
        }
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
    if (nearest.empty() && must_mean_formal(text, expression)) {
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

bool ExpressionResolver::must_mean_formal(std::string_view text, const Expression& unknown) const {
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

void ExpressionResolver::explain_argument_count(const Expression& call,
                                                ExpressionPlace place,
                                                Diagnostic& error) const {
    const std::string_view text = resolution_.sources.text(call.span());
    const std::vector<std::string_view> arguments = arguments_in(text);
    const std::string_view name = resolution_.text(call.name);
    const auto write = [&](const std::string& replacement) {
        error.fixes.push_back(
            {fmt::format("write `{}`", replacement), {{call.span(), replacement}}, false});
    };
    if ((name == "max" || name == "min") && arguments.size() > 2 && arguments.size() <= 8) {
        std::string nested = fmt::format("{}({}, {})", name, arguments[0], arguments[1]);
        for (std::size_t i = 2; i < arguments.size(); ++i) {
            nested = fmt::format("{}({}, {})", name, nested, arguments[i]);
        }
        write(nested);
    } else if ((name == "max" || name == "min") && arguments.size() == 1) {
        error.help.push_back(
            fmt::format("it compares two values: `{}({}, 0)`", name, arguments[0]));
    } else if (name == "if" && arguments.size() == 1 && place == ExpressionPlace::Condition) {
        error.help.emplace_back("a condition needs no `if`: the production is used where it holds");
        write(std::string(arguments[0]));
    } else if (name == "if" && arguments.size() == 2) {
        error.help.emplace_back("the third is the value where the condition does not hold");
        write(fmt::format("if({}, {}, 0)", arguments[0], arguments[1]));
    } else if (name == "clamp" && arguments.size() == 2) {
        write(fmt::format("max({}, {})", arguments[0], arguments[1]));
        error.fixes.back().title += ", or give the upper bound as well";
    } else if (name == "log" && arguments.size() == 2) {
        write(fmt::format("log({}) / log({})", arguments[0], arguments[1]));
    } else if (name == "atan" && arguments.size() == 2 && functions_.size() > 2) {
        write(fmt::format("atan2({}, {})", arguments[0], arguments[1]));
    } else if (name == "round" && arguments.size() == 2) {
        write(fmt::format("round({} * 10^{}) / 10^{}", arguments[0], arguments[1], arguments[1]));
    }
}

std::string_view ExpressionResolver::name_before_replacement(std::string_view text) const {
    for (const NameId formal : formals_) {
        const std::string_view name = resolution_.text(formal);
        const std::size_t at = name.size() < 2 ? std::string_view::npos : text.find(name);
        if (at == std::string_view::npos) {
            continue;
        }
        const std::string_view begin = text.substr(0, at);
        const std::string_view end = text.substr(at + name.size());
        for (const std::string_view known : function_names()) {
            if (known.size() == begin.size() + 1 + end.size() && known.size() > 1 &&
                known.starts_with(begin) && known.ends_with(end)) {
                return known;
            }
        }
    }
    return {};
}

void ExpressionResolver::report_unknown_function(const Expression& expression, NameId function) {
    const std::string_view text = resolution_.text(function);
    if (attempted_.defines(text) || files_missing_ || resolution_.options.part) {
        return;
    }
    // The name in the source may be shorter than `text`, where `_00E9` stands for U+00E9.
    const std::string_view source = resolution_.sources.text(expression.span());
    const std::size_t length = std::min(source.find_first_of(" \t\r\n(/"), source.size());
    const SourceSpan name{expression.file, expression.begin,
                          expression.begin + static_cast<std::uint32_t>(length)};
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
        if (shown.spelling == "x") {
            error.help.push_back(std::string(shown.advice) + ": leave it out");
        } else {
            error.help.push_back(help_for(
                shown, shown.word.find('(') == std::string_view::npos ? text : shown.word));
        }
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
    } else if (const std::string_view before = name_before_replacement(text); !before.empty()) {
        suggest(error, name, std::string(before));
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
    case ExpressionPlace::Contour:
        where = "in a contour";
        break;
    case ExpressionPlace::Material:
        where = "in a material";
        break;
    case ExpressionPlace::Environment:
        where = "in an environment";
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
        is_range ? fmt::format("a {} is not allowed {}",
                               expression.kind == ExpressionKind::Range ? "random range"
                                                                        : "random number",
                               where)
                 : fmt::format("`{}` is random, so it is not allowed {}",
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
        // No certain fix: a missing or mistyped digit is as likely as swapped bounds.
        error.fixes.push_back({"exchange them",
                               {{first, std::string(resolution_.sources.text(second))},
                                {second, std::string(resolution_.sources.text(first))}},
                               false});
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

bool ExpressionResolver::check_distribution_of(const Expression& expression,
                                               Opcode opcode,
                                               ValueId first,
                                               ValueId second) {
    const auto x = constant_value(first);
    const auto y = constant_value(second);
    // Arguments that are not constant count as valid.
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
    const auto report = [&](SourceSpan span, const char* result) {
        Diagnostic error =
            make_diagnostic(DiagnosticCode::NotFinite, span, fmt::format("{} is {}", what, result));
        if (place != ExpressionPlace::Axiom) {
            // The value may never be computed, since the production may match no module.
            error.severity = Severity::Warning; // set before add(), which counts errors
            error.notes.emplace_back(place == ExpressionPlace::Successor
                                         ? "the derivation ends where this production is applied"
                                         : "the derivation ends where this production is tried");
        }
        return error;
    };
    if (reaches_a_module || place == ExpressionPlace::Condition) {
        if (constant && !std::isfinite(*constant)) {
            const NonFiniteCause culprit = non_finite_cause_.value_or(
                NonFiniteCause{resolution_.ast.expression(root).span(), "", std::nullopt});
            Diagnostic error =
                report(culprit.span, std::isnan(*constant) ? "not a number" : "infinite");
            error.label = culprit.reason;
            if (culprit.definition) {
                error.labels.push_back({*culprit.definition, "it is defined here"});
            }
            resolution_.diagnostics.add(std::move(error));
            return;
        }
        const Value& node = values_[value];
        if (value != kPoison && (node.opcode == Opcode::Divide || node.opcode == Opcode::Mod) &&
            constant_value(node.right) == 0.0F) {
            // A division inside a called #function has no divisor in this statement.
            const SourceSpan divisor = zero_divisors_.empty()
                                           ? resolution_.ast.expression(root).span()
                                           : zero_divisors_.back();
            Diagnostic error = report(divisor, "never finite");
            error.label = "division by zero";
            resolution_.diagnostics.add(std::move(error));
            return;
        }
    }
    for (const SourceSpan divisor : zero_divisors_) {
        resolution_.diagnostics.add(DiagnosticCode::DivisionByZero, divisor, "division by zero");
    }
}

} // namespace lsys
