// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/expressions.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/dialects/impl/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

/// A function of one argument: its names in cpfg and in .lsys.
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

/// A normal distribution by the Box-Muller transform of two random numbers from 0 to 1.
constexpr std::string_view kNormal =
    "#function nran(mean, sd, u, v) mean + sd*sqrt(-2*log(1 - u))*cos(360*v);\n";

bool is_integer(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789") == text.npos;
}

} // namespace

std::string cpfg_name_of(std::string_view text, std::string_view fallback) {
    std::string name;
    for (const char c : text) {
        const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        const bool is_digit = c >= '0' && c <= '9';
        name += is_letter || (is_digit && !name.empty()) ? c : '_';
    }
    const bool has_letter = name.find_first_not_of('_') != name.npos;
    return has_letter ? name : std::string(fallback);
}

bool is_cpfg_number(std::string_view text) {
    return !text.empty() && literal_length(text) == text.size();
}

bool is_cpfg_zero(std::string_view text) {
    return text.find_first_of("123456789") == text.npos;
}

void CpfgExpressions::warn_left_out(SourceSpan span,
                                    const std::string& what,
                                    const std::string& message) {
    if (!quiet_ && warned_.insert(what).second) {
        session_.context.diagnostics.add(DiagnosticCode::ForeignIgnored, span, message);
    }
}

ForeignId CpfgExpressions::truncated(ForeignId value, SourceSpan span) {
    if (tree_[value].kind == ForeignKind::Number && is_integer(tree_[value].text)) {
        return value;
    }
    has_integer_part_ = true;
    return tree_.call("int", {value}, span);
}

ForeignId CpfgExpressions::read(ForeignId value, SourceSpan span) {
    ForeignNode node = tree_[value];
    node.span = node.token = span;
    return tree_.add(std::move(node));
}

std::string CpfgExpressions::known_literal(ForeignId value) {
    std::string literal(tree_.literal(value));
    while (!literal.empty() && tree_[value].kind == ForeignKind::Local) {
        ForeignLocal& local = tree_.locals()[tree_[value].index];
        local.is_inline = true;
        value = local.value;
    }
    return literal;
}

ForeignId CpfgExpressions::first_value(const std::string& global, SourceSpan span) {
    const auto start = globals_.find(global);
    return start == globals_.end() ? tree_.number("0", span) : read(start->second, span);
}

ForeignId CpfgExpressions::name(const ForeignNode& node) {
    if (const auto found = variables_.find(node.text); found != variables_.end()) {
        return read(found->second, node.span);
    }
    if (formals_.count(node.text) != 0) {
        return tree_.name(node.text, node.span);
    }
    if (node.text == "Q") { // the number of the step, which cpfg counts from 1
        const ForeignId step = tree_.call("step", {}, node.span);
        return stage_ == Stage::Rewrite
                   ? tree_.binary("+", step, tree_.number("1", node.span), node.span)
                   : step;
    }
    if (node.text == "Z") {
        return tree_.call("steps", {}, node.span);
    }
    if (const auto found = state_.find(node.text); found != state_.end()) {
        return read(found->second, node.span);
    }
    if (changed_globals_.count(node.text) != 0 && !in_axiom_) {
        return in_step_ ? tree_.number("0", node.span)
                        : unsupported(node.span, "`" + shown(node.text) +
                                                     "` is changed in every step, by more than the "
                                                     "same number");
    }
    if (globals_.count(node.text) == 0) {
        warn_left_out(node.span, "name " + node.text,
                      "`" + shown(node.text) + "` has no value before this; it is 0");
    }
    return first_value(node.text, node.span);
}

std::optional<double> CpfgExpressions::known_point(std::size_t curve, ForeignId x) {
    const std::optional<double> known = known_values_.of(x);
    const auto [found, is_new] = tables_.try_emplace(curve);
    std::vector<double>& table = found->second;
    if (is_new) {
        table = curve_table(curves_[curve]);
    }
    if (!known || table.empty()) {
        return std::nullopt;
    }
    const double place = std::clamp(*known, 0.0, 1.0) * static_cast<double>(table.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, table.size() - 1);
    const double part = place - static_cast<double>(below);
    return (1.0 - part) * table[below] + part * table[above];
}

ForeignId CpfgExpressions::curve(const ForeignNode& node) {
    const ForeignNode which = tree_[node.parts[0]];
    std::size_t index = curves_.size();
    for (std::size_t i = 0; i < curves_.size() && which.kind == ForeignKind::Name; ++i) {
        index = curves_[i].name == which.text && index == curves_.size() ? i : index;
    }
    std::string shown_name = shown(which.text);
    const bool unnamed = which.kind == ForeignKind::Name && formals_.count(which.text) == 0 &&
                         variables_.count(which.text) == 0 && globals_.count(which.text) == 0;
    if (index == curves_.size() && !unnamed) {
        const std::string number = known_literal(term(node.parts[0]));
        std::size_t from_one = 0;
        std::from_chars(number.data(), number.data() + number.size(), from_one);
        if (from_one == 0) {
            return unsupported(node.span, "a function that is chosen while the word is derived");
        }
        index = std::min(from_one - 1, curves_.size());
        shown_name = number;
    }
    const ForeignId x = term(node.parts[1]);
    if (index < curves_.size() && !curves_[index].points.empty()) {
        if (const std::optional<double> known = known_point(index, x)) {
            return tree_.number(text_of(static_cast<float>(*known)), node.token);
        }
        CpfgCurveNames& names = curve_names_[index];
        if (names.function.empty()) {
            const CpfgCurve& found = curves_[index];
            const std::string name =
                cpfg_name_of(found.name.empty() ? found.file : found.name, "func");
            names.function = unique_name(name, function_names_);
            names.table = unique_name(name + "_table", function_names_);
            names.between = unique_name(name + "_between", function_names_);
        }
        return tree_.call(names.function, {x}, node.token);
    }
    if (stage_ == Stage::Interpret && !in_header_) {
        warn_left_out(node.span, "func " + shown_name,
                      "no view file beside this one has function `" + shown_name + "`: it is 1");
        return tree_.number("1", node.span);
    }
    return unsupported(node.span, "no view file beside this one has function `" + shown_name + "`");
}

ForeignId CpfgExpressions::random_call(const ForeignNode& node, std::vector<ForeignId> arguments) {
    if (node.text == "nran") {
        has_normal_ = true;
        arguments.push_back(draw(node.token));
        arguments.push_back(draw(node.token));
        return tree_.call("nran", std::move(arguments), node.token);
    }
    const ForeignId size = arguments[0];
    const ForeignId unit = draw(node.token);
    if (tree_[size].kind != ForeignKind::Number) {
        return tree_.binary("*", unit, size, node.token);
    }
    if (tree_[size].text == "1") {
        return unit;
    }
    return binds_draws_ ? tree_.binary("*", unit, size, node.token)
                        : tree_.range(tree_.number("0", node.token), size, node.token);
}

ForeignId CpfgExpressions::call(const ForeignNode& node) {
    if (node.text == "func" && node.parts.size() == 2) {
        return curve(node);
    }
    std::vector<ForeignId> arguments;
    for (const ForeignId part : node.parts) {
        if (tree_[part].kind == ForeignKind::Text) {
            return unsupported(node.span, "`" + shown(node.text) + "`");
        }
        arguments.push_back(term(part));
    }
    const auto wants = [&](std::size_t count) { return arguments.size() == count; };
    for (const Function& function : kFunctions) {
        if (function.name == node.text && wants(1)) {
            return tree_.call(function.lsys, std::move(arguments), node.token);
        }
    }
    if (node.text == "atan2" && wants(2)) { // in cpfg the first argument is x, in .lsys y
        return tree_.call("atan2", {arguments[1], arguments[0]}, node.token);
    }
    if (node.text == "trunc" && wants(1)) {
        const ForeignId half = tree_.number("0.5", node.token);
        return tree_.call("floor", {tree_.binary("+", arguments[0], half, node.token)}, node.token);
    }
    if ((node.text == "ran" && wants(1)) || (node.text == "nran" && wants(2))) {
        return random_call(node, std::move(arguments));
    }
    if (node.text == "GetDerivationLength") {
        return tree_.call("steps", {}, node.token);
    }
    return unsupported(node.span, "the function `" + shown(node.text) + "`");
}

ForeignId CpfgExpressions::binary(const ForeignNode& node) {
    const ForeignId a = term(node.parts[0]);
    const ForeignId b = term(node.parts[1]);
    if (node.text == "%") { // the remainder of the truncated operands
        return tree_.call("mod", {truncated(a, node.token), truncated(b, node.token)}, node.token);
    }
    return tree_.binary(node.text == "<>" ? "!=" : node.text, a, b, node.token);
}

ForeignId CpfgExpressions::term(ForeignId expression) {
    const ForeignNode node = tree_[expression]; // a copy, which stays valid while the tree grows
    switch (node.kind) {
    case ForeignKind::Name:
        return name(node);
    case ForeignKind::Text:
    case ForeignKind::Address:
        return unsupported(node.span, "a value that is not a number");
    case ForeignKind::Unary:
        return tree_.unary(node.text, term(node.parts[0]), node.token);
    case ForeignKind::Binary:
        return binary(node);
    case ForeignKind::Choose: {
        std::vector<ForeignId> parts;
        for (const ForeignId part : node.parts) {
            parts.push_back(term(part));
        }
        return tree_.call("if", std::move(parts), node.token);
    }
    case ForeignKind::Call:
        return call(node);
    case ForeignKind::Index:
        return element(node);
    default: // a number
        return expression;
    }
}

void CpfgExpressions::write_functions(Translation& out, SourceSpan place) const {
    if (has_integer_part_) {
        out.put(kIntegerPart, place);
    }
    if (has_normal_) {
        out.put(kNormal, place);
    }
    for (const auto& [index, names] : curve_names_) {
        out.put(curve_statements(curves_[index], names), place);
    }
    for (const auto& [variable, array] : arrays_) {
        if (array.name.empty()) {
            continue;
        }
        out.put("#curve " + array.name, place);
        for (std::size_t i = 0; i < array.values.size(); ++i) {
            const ForeignId value = array.values[i];
            const bool plain = tree_[value].kind == ForeignKind::Number;
            out.put((i == 0 ? " " : ", ") + std::to_string(i) + (plain ? " " : " ("), place);
            tree_.write(value, {.expands_locals = true}, out);
            out.put(plain ? "" : ")", place);
        }
        out.put(";\n", place);
    }
}

} // namespace lsys
