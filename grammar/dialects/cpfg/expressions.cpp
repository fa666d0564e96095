#include "grammar/dialects/cpfg/expressions.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

namespace lsys {

namespace {

/// Functions of one argument that both cpfg and .lsys have.
struct Function {
    std::string_view name;
    std::string_view lsys;
};
constexpr std::array kFunctions{
    Function{"sin", "sin"},   Function{"cos", "cos"},   Function{"tan", "tan"},
    Function{"asin", "asin"}, Function{"acos", "acos"}, Function{"atan", "atan"},
    Function{"exp", "exp"},   Function{"log", "log"},   Function{"floor", "floor"},
    Function{"ceil", "ceil"}, Function{"sign", "sign"}, Function{"sqrt", "sqrt"},
    Function{"fabs", "abs"},
};

} // namespace

bool is_cpfg_number(std::string_view text) {
    return !text.empty() && literal_length(text) == text.size();
}

bool is_cpfg_zero(std::string_view text) {
    return text.find_first_of("123456789") == text.npos;
}

std::string in_cpfg_parentheses(const std::string& text) {
    const bool plain = is_cpfg_number(text) ||
                       text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                              "0123456789_") == std::string::npos;
    return plain ? text : "(" + text + ")";
}

void CpfgExpressions::warn_left_out(SourceSpan span,
                                    const std::string& what,
                                    const std::string& message) {
    if (!probes_ && warned_.insert(what).second) {
        session_.context.diagnostics.add(DiagnosticCode::ForeignIgnored, span, message);
    }
}

CpfgTerm CpfgExpressions::choose(const CpfgTerm& test,
                                 const CpfgTerm& yes,
                                 const CpfgTerm& no,
                                 SourceSpan span) {
    if (test.is_random) {
        return chosen_by_chance(span, "a choice by a random number");
    }
    const std::string condition = in_cpfg_parentheses(test.text);
    CpfgTerm made{"(" + condition + " != 0) * " + in_cpfg_parentheses(yes.text) + " + (" +
                      condition + " == 0) * " + in_cpfg_parentheses(no.text),
                  yes.is_random || no.is_random, 0};
    return made.text.size() > kMaxCpfgTerm ? unsupported(span, "a choice that is too long") : made;
}

CpfgTerm CpfgExpressions::element(const CpfgExpression& node) {
    const auto found = arrays_.find(node.text);
    if (found == arrays_.end()) {
        return unsupported(node.span, "`" + shown(node.text) + "` is no array");
    }
    const Array& array = found->second;
    if (array.sizes.size() != node.parts.size()) {
        return unsupported(node.span, "`" + shown(node.text) + "` has " +
                                          std::to_string(array.sizes.size()) + " dimensions");
    }
    std::string index = "0";
    bool is_random = false;
    for (std::size_t i = 0; i < node.parts.size(); ++i) {
        const CpfgTerm part = term(node.parts[i]);
        is_random = is_random || part.is_random;
        const std::string floor = is_cpfg_number(part.text)
                                      ? part.text
                                      : "min(max(floor(" + part.text + "), 0), " +
                                            std::to_string(array.sizes[i] - 1) + ")";
        index =
            i == 0 ? floor
                   : fmt::format("{} * {} + {}", in_cpfg_parentheses(index), array.sizes[i], floor);
    }
    if (is_random) {
        return chosen_by_chance(node.span, "a random number as the index of an array");
    }
    if (is_cpfg_number(index)) {
        std::size_t at = 0;
        std::from_chars(index.data(), index.data() + index.size(), at);
        return {array.values[std::min(at, array.values.size() - 1)], false, 0};
    }
    std::string text;
    for (std::size_t i = 0; i < array.values.size(); ++i) {
        if (!is_cpfg_number(array.values[i]) || !is_cpfg_zero(array.values[i])) {
            text += (text.empty() ? "((" : " + ((") + index + ") == " + std::to_string(i) + ") * " +
                    in_cpfg_parentheses(array.values[i]);
        }
    }
    return {text.empty() ? "0" : text, false, 0};
}

CpfgTerm CpfgExpressions::name(const CpfgExpression& node) {
    if (const auto found = variables_.find(node.text); found != variables_.end()) {
        CpfgTerm& value = found->second;
        if (value.is_random && ++value.uses > 1) {
            return chosen_by_chance(node.span,
                                    "`" + shown(node.text) +
                                        "` is a random number that is used more than once");
        }
        return {in_cpfg_parentheses(value.text), value.is_random, 0};
    }
    if (formals_.count(node.text) != 0) {
        return {node.text, false, 0};
    }
    if (node.text == "Q") { // the number of the step, which cpfg counts from 1
        return {stage_ == Stage::Rewrite ? "(step() + 1)" : "step()", false, 0};
    }
    if (node.text == "Z") {
        return {"steps()", false, 0};
    }
    if (const auto state = states_.find(stage_); state != states_.end()) {
        if (const auto found = state->second.find(node.text); found != state->second.end()) {
            return {in_cpfg_parentheses(found->second.text), false, 0};
        }
    }
    if (changed_globals_.count(node.text) != 0) {
        return in_step_
                   ? CpfgTerm{"0", false, 0}
                   : unsupported(node.span,
                                 "`" + shown(node.text) +
                                     "` is changed in every step, by more than the same number");
    }
    if (const auto found = globals_.find(node.text); found != globals_.end()) {
        return {in_cpfg_parentheses(found->second.text), false, 0};
    }
    warn_left_out(node.span, "name " + node.text,
                  "`" + shown(node.text) + "` has no value before this; it is 0");
    return {"0", false, 0};
}

/// A random number from 0 to 1.
CpfgTerm CpfgExpressions::draw() {
    const int index = random_needs_.draws++;
    return draws_ == CpfgDraws::Bound ? CpfgTerm{draw_name(index), false, 0}
                                      : CpfgTerm{"{0, 1}", true, 0};
}

CpfgTerm CpfgExpressions::chosen_by_chance(SourceSpan span, const std::string& message) {
    random_needs_.bound_draws = true;
    if (draws_ == CpfgDraws::Inline) {
        static_cast<void>(unsupported(span, message));
    }
    return {"0", true, 0};
}

/// `func(which, x)`; which is a number, or a name in the set of functions.
CpfgTerm CpfgExpressions::curve(const CpfgExpression& node) {
    const CpfgExpression& which = node_at(node.parts[0]);
    std::size_t index = curves_.size();
    for (std::size_t i = 0; i < curves_.size() && which.kind == CpfgKind::Name; ++i) {
        index = curves_[i].name == which.text && index == curves_.size() ? i : index;
    }
    std::string shown_name = shown(which.text);
    const bool unnamed = which.kind == CpfgKind::Name && formals_.count(which.text) == 0 &&
                         variables_.count(which.text) == 0 && globals_.count(which.text) == 0;
    if (index == curves_.size() && !unnamed) {
        const CpfgTerm number = term(node.parts[0]);
        std::size_t from_one = 0;
        std::from_chars(number.text.data(), number.text.data() + number.text.size(), from_one);
        if (!is_cpfg_number(number.text) || from_one == 0) {
            return unsupported(node.span, "a function that is chosen while the word is derived");
        }
        index = std::min(from_one - 1, curves_.size());
        shown_name = number.text;
    }
    CpfgTerm x = term(node.parts[1]);
    if (index < curves_.size() && !curves_[index].points.empty()) {
        if (x.is_random) { // each chord would draw its own number
            return chosen_by_chance(node.span, "a function of a random number");
        }
        return {curve_at(curves_[index], x.text), false, 0};
    }
    if (stage_ == Stage::Interpret && !in_header_) {
        warn_left_out(node.span, "func " + shown_name,
                      "no view file beside this one has function `" + shown_name + "`: it is 1");
        return {"1", false, 0};
    }
    return unsupported(node.span, "no view file beside this one has function `" + shown_name + "`");
}

CpfgTerm CpfgExpressions::call(const CpfgExpression& node) {
    if (node.text == "func" && node.parts.size() == 2) {
        return curve(node);
    }
    std::vector<CpfgTerm> arguments;
    bool is_random = false;
    for (const int part : node.parts) {
        if (node_at(part).kind == CpfgKind::String) {
            return unsupported(node.span, "`" + shown(node.text) + "`");
        }
        arguments.push_back(term(part));
        is_random = is_random || arguments.back().is_random;
    }
    const auto wants = [&](std::size_t count) { return arguments.size() == count; };
    for (const Function& function : kFunctions) {
        if (function.name == node.text && wants(1)) {
            return {std::string(function.lsys) + "(" + arguments[0].text + ")", is_random, 0};
        }
    }
    if (node.text == "atan2" && wants(2)) { // in cpfg the first argument is x, in .lsys y
        return {"atan2(" + arguments[1].text + ", " + arguments[0].text + ")", is_random, 0};
    }
    if (node.text == "trunc" && wants(1)) {
        return {"floor(" + in_cpfg_parentheses(arguments[0].text) + " + 0.5)", is_random, 0};
    }
    if (node.text == "ran" && wants(1)) {
        const CpfgTerm u = draw();
        return {u.text + " * " + in_cpfg_parentheses(arguments[0].text), is_random || u.is_random,
                0};
    }
    if (node.text == "nran" && wants(2)) { // a normal distribution by the Box-Muller transform
        const CpfgTerm u = draw();
        const CpfgTerm v = draw();
        return {in_cpfg_parentheses(arguments[0].text) + " + " +
                    in_cpfg_parentheses(arguments[1].text) + " * sqrt(-2 * log(1 - " + u.text +
                    ")) * cos(360 * " + v.text + ")",
                is_random || u.is_random, 0};
    }
    if (node.text == "GetDerivationLength") {
        return {"steps()", false, 0};
    }
    return unsupported(node.span, "the function `" + shown(node.text) + "`");
}

CpfgTerm CpfgExpressions::binary(const CpfgExpression& node) {
    const CpfgTerm a = term(node.parts[0]);
    const CpfgTerm b = term(node.parts[1]);
    const bool is_random = a.is_random || b.is_random;
    if (node.text == "%") { // the remainder of the operands cut to whole numbers
        if (is_random) {
            return chosen_by_chance(node.span, "the remainder of a random number");
        }
        const auto whole = [](const std::string& text) {
            return "sign(" + text + ") * floor(abs(" + text + "))";
        };
        return {"mod(" + whole(a.text) + ", " + whole(b.text) + ")", false, 0};
    }
    const std::string operation = node.text == "<>" ? "!=" : node.text;
    return {in_cpfg_parentheses(a.text) + " " + operation + " " + in_cpfg_parentheses(b.text),
            is_random, 0};
}

CpfgTerm CpfgExpressions::term(int index) {
    const CpfgExpression node = node_at(index); // a copy, which stays valid if the vector grows
    CpfgTerm made;
    switch (node.kind) {
    case CpfgKind::Number:
        made.text = node.text;
        break;
    case CpfgKind::Name:
        made = name(node);
        break;
    case CpfgKind::String:
    case CpfgKind::Address:
        made = unsupported(node.span, "a value that is no number");
        break;
    case CpfgKind::Unary: {
        const CpfgTerm inner = term(node.parts[0]);
        made = {node.text + in_cpfg_parentheses(inner.text), inner.is_random, 0};
        break;
    }
    case CpfgKind::Binary:
        made = binary(node);
        break;
    case CpfgKind::Choose: {
        const CpfgTerm test = term(node.parts[0]);
        const CpfgTerm yes = term(node.parts[1]);
        const CpfgTerm no = term(node.parts[2]);
        made = choose(test, yes, no, node.span);
        break;
    }
    case CpfgKind::Call:
        made = call(node);
        break;
    case CpfgKind::Index:
        made = element(node);
        break;
    }
    if (made.text.size() > kMaxCpfgTerm) {
        return unsupported(node.span,
                           "an expression that is too long once its variables are replaced");
    }
    return made;
}

} // namespace lsys
