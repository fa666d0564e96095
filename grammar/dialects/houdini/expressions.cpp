// SPDX-License-Identifier: MIT
#include "grammar/dialects/houdini/expressions.h"

#include "grammar/ast/reports.h"
#include "grammar/dialects/houdini/symbols.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// A function of Houdini and its name in .lsys.
struct Function {
    std::string_view name;
    std::string_view in_lsys;
};
constexpr std::array<Function, 22> kFunctions{{
    {"sin", "sin"},    {"cos", "cos"},     {"tan", "tan"},     {"asin", "asin"}, {"acos", "acos"},
    {"atan", "atan"},  {"atan2", "atan2"}, {"sqrt", "sqrt"},   {"exp", "exp"},   {"log", "log"},
    {"pow", "pow"},    {"abs", "abs"},     {"floor", "floor"}, {"ceil", "ceil"}, {"round", "round"},
    {"rint", "round"}, {"min", "min"},     {"max", "max"},     {"sign", "sign"}, {"fmod", "mod"},
    {"mod", "mod"},    {"int", "int"},
}};

/// Variables of Houdini's turtle, which draws after all rules have been applied: no rule reads them.
constexpr std::string_view kTurtleVariables = "xyzALTUVW";

std::string_view operator_of(std::string_view text) {
    return text == "&" ? "&&" : text == "|" ? "||" : text;
}

} // namespace

ForeignId HoudiniExpressions::unsupported(SourceSpan place, const std::string& message) {
    session_.context.diagnostics.add(DiagnosticCode::ForeignFeature, place, message);
    return tree_.number("0", place);
}

ForeignId HoudiniExpressions::term(ForeignId root, const HoudiniScope& scope) {
    Terms terms;
    std::vector<ForeignId> wanted;
    std::vector<ForeignId> open{root};
    while (!open.empty()) { // the seed of `rand` is not written
        const ForeignId id = open.back();
        open.pop_back();
        wanted.push_back(id);
        const ForeignNode& node = tree_[id];
        if (node.kind != ForeignKind::Call || node.text != "rand") {
            open.insert(open.end(), node.parts.begin(), node.parts.end());
        }
    }
    std::sort(wanted.begin(), wanted.end()); // children before parents
    for (const ForeignId id : wanted) {
        const ForeignId equivalent = lower(id, terms, scope);
        terms[id] = equivalent;
    }
    return terms[root];
}

ForeignId HoudiniExpressions::lower(ForeignId id, const Terms& terms, const HoudiniScope& scope) {
    const ForeignNode node = tree_[id]; // a copy, which stays valid while the tree grows
    if (node.kind == ForeignKind::Call && node.text == "rand") {
        return random(node, scope);
    }
    std::vector<ForeignId> parts;
    for (const ForeignId part : node.parts) {
        parts.push_back(terms.at(part));
    }
    switch (node.kind) {
    case ForeignKind::Name:
        return name(node, scope);
    case ForeignKind::Call:
        return call(node, std::move(parts));
    case ForeignKind::Unary:
        return tree_.unary(node.text, parts[0], node.token);
    case ForeignKind::Binary:
        return node.text == "%"
                   ? tree_.call("mod", std::move(parts), node.token)
                   : tree_.binary(operator_of(node.text), parts[0], parts[1], node.token);
    case ForeignKind::Text:
        return unsupported(node.span, "a text is not a value here");
    case ForeignKind::Missing:
        return tree_.number("0", node.span);
    default: // a number
        return id;
    }
}

ForeignId HoudiniExpressions::name(const ForeignNode& node, const HoudiniScope& scope) {
    const std::string& name = node.text;
    const bool in_premise = scope.place == HoudiniPlace::Premise;
    if (scope.rule != nullptr && names_parameter(*scope.rule, name)) {
        const bool is_zero =
            scope.omitted_parameters != nullptr &&
            std::find(scope.omitted_parameters->begin(), scope.omitted_parameters->end(), name) !=
                scope.omitted_parameters->end();
        return is_zero ? tree_.number("0", node.span) : tree_.name(name, node.span);
    }
    if (name == "a") {
        return tree_.number(angle_, node.span);
    }
    if (name == "b" || name == "c" || name == "d") {
        return tree_.name("value_" + name, node.span);
    }
    if (name == "t") {
        return in_premise ? tree_.number("0", node.span) : tree_.call("step", {}, node.span);
    }
    if (name == "g") {
        return in_premise ? tree_.number("0", node.span) : tree_.name("g", node.span);
    }
    if (name == "i") {
        return unsupported(node.span,
                           "`i`, the index of a module in the word, is not known to rules of lsc, "
                           "except as the seed of `rand`");
    }
    if (name.size() == 1 && kTurtleVariables.find(name[0]) != std::string_view::npos) {
        return unsupported(
            node.span,
            "`" + name +
                "` is a variable of the turtle, which draws after all rules have been applied");
    }
    session_.context.diagnostics.add(
        DiagnosticCode::ForeignSyntax, node.span,
        "`" + shown(name) + "` is neither a parameter of this rule nor a variable of Houdini");
    return tree_.number("0", node.span);
}

ForeignId HoudiniExpressions::call(const ForeignNode& node, std::vector<ForeignId> arguments) {
    const std::string& name = node.text;
    const auto* const found =
        std::find_if(kFunctions.begin(), kFunctions.end(),
                     [&](const Function& function) { return function.name == name; });
    if (found == kFunctions.end()) {
        const bool of_scene = name == "in" || name == "pic";
        return unsupported(node.token,
                           of_scene ? "`" + name +
                                          "` asks an input of Houdini's node, which lsc does not "
                                          "have"
                                    : "lsc has no function `" + shown(name) + "`");
    }
    if (name == "int" && node.parts.size() != 1) {
        session_.context.diagnostics.add(DiagnosticCode::ForeignSyntax, node.token,
                                         "`int` takes one number");
    }
    return tree_.call(found->in_lsys, std::move(arguments), node.token);
}

ForeignId HoudiniExpressions::random(const ForeignNode& node, const HoudiniScope& scope) {
    if (scope.place == HoudiniPlace::Condition || scope.place == HoudiniPlace::Probability) {
        Diagnostic& error =
            session_.context.diagnostics.add(DiagnosticCode::ForeignFeature, node.token,
                                             "a condition or probability cannot be random");
        error.help.emplace_back("write the probability after the rule, as in `A=B:0.3`; a first "
                                "rule with `rand(i)<0.3` and a second without condition are read");
        return tree_.number("0", node.span);
    }
    warn_random(node.token);
    std::string seed(session_.context.sources.text(node.span));
    std::erase_if(seed, [](char c) { return c == ' ' || c == '\t'; });
    const auto [known, is_new] = seeds_.try_emplace(std::move(seed), kNoForeign);
    if (is_new) {
        known->second =
            tree_.local({.name = "chance", .value = tree_.draw(0, node.token), .span = node.token});
    }
    ForeignNode read = tree_[known->second];
    read.span = read.token = node.token;
    return tree_.add(std::move(read));
}

void HoudiniExpressions::warn_random(SourceSpan place) {
    if (!has_warned_random_) {
        has_warned_random_ = true;
        session_.context.diagnostics.add(
            DiagnosticCode::ForeignLoss, place,
            "`rand` draws a number of its own each time; Houdini gives one number for one seed");
    }
}

} // namespace lsys
