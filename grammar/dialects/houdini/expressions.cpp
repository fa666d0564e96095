#include "grammar/dialects/houdini/expressions.h"

#include "grammar/ast/reports.h"
#include "grammar/dialects/houdini/symbols.h"

#include <algorithm>
#include <array>
#include <vector>

namespace lsys {

namespace {

/// A function of Houdini and its name in .lsys.
struct Function {
    std::string_view name;
    std::string_view in_lsys;
};
constexpr std::array<Function, 21> kFunctions{{
    {"sin", "sin"},    {"cos", "cos"},     {"tan", "tan"},     {"asin", "asin"}, {"acos", "acos"},
    {"atan", "atan"},  {"atan2", "atan2"}, {"sqrt", "sqrt"},   {"exp", "exp"},   {"log", "log"},
    {"pow", "pow"},    {"abs", "abs"},     {"floor", "floor"}, {"ceil", "ceil"}, {"round", "round"},
    {"rint", "round"}, {"min", "min"},     {"max", "max"},     {"sign", "sign"}, {"fmod", "mod"},
    {"mod", "mod"},
}};

/// Variables of the turtle, unknown to rules.
constexpr std::string_view kTurtleVariables = "xyzALTUVW";

std::string_view operator_of(std::string_view text) {
    if (text[0] == '&') {
        return " && ";
    }
    return text[0] == '|' ? " || " : text;
}

} // namespace

void HoudiniExpressions::report_unsupported(SourceSpan place, const std::string& message) const {
    session_.context.diagnostics.add(DiagnosticCode::ForeignFeature, place, message);
}

void HoudiniExpressions::write(int node, const HoudiniScope& scope) {
    items_.push_back({node, {}, {}});
    while (!items_.empty()) {
        const Item item = items_.back();
        items_.pop_back();
        if (item.node == -1) {
            translation_.put(item.text, item.span);
        } else {
            write_node(session_.node(item.node), scope);
        }
    }
}

void HoudiniExpressions::write_node(const HoudiniNode& node, const HoudiniScope& scope) {
    switch (node.kind) {
    case HoudiniNodeKind::Number:
        translation_.copy(node.span, session_.context.sources);
        return;
    case HoudiniNodeKind::Name:
        write_name(node, scope);
        return;
    case HoudiniNodeKind::Call:
        write_call(node, scope);
        return;
    case HoudiniNodeKind::Group:
        translation_.put("(", {node.span.file, node.span.begin, node.span.begin + 1});
        items_.push_back({-1, ")", {node.span.file, node.span.end - 1, node.span.end}});
        items_.push_back({node.parts[0], {}, {}});
        return;
    case HoudiniNodeKind::Unary:
        translation_.copy(node.span, session_.context.sources);
        items_.push_back({node.parts[0], {}, {}});
        return;
    case HoudiniNodeKind::Binary:
        write_binary(node);
        return;
    case HoudiniNodeKind::Text:
        report_unsupported(node.span, "a text is no value here");
        return;
    case HoudiniNodeKind::Missing:
        translation_.put("0", node.span);
        return;
    }
}

void HoudiniExpressions::write_binary(const HoudiniNode& node) {
    const std::string_view text = session_.context.sources.text(node.span);
    if (text == "%") {
        translation_.put("mod(", node.span);
        items_.push_back({-1, ")", node.span});
        items_.push_back({node.parts[1], {}, {}});
        items_.push_back({-1, ", ", node.span});
    } else {
        items_.push_back({node.parts[1], {}, {}});
        items_.push_back({-1, operator_of(text), node.span});
    }
    items_.push_back({node.parts[0], {}, {}});
}

void HoudiniExpressions::write_name(const HoudiniNode& node, const HoudiniScope& scope) {
    const std::string_view name = session_.context.sources.text(node.span);
    const bool in_premise = scope.place == HoudiniPlace::Premise;
    if (scope.rule != nullptr && names_parameter(*scope.rule, name)) {
        const bool is_zero =
            scope.zeros != nullptr &&
            std::find(scope.zeros->begin(), scope.zeros->end(), name) != scope.zeros->end();
        if (is_zero) {
            translation_.put("0", node.span);
        } else {
            translation_.copy(node.span, session_.context.sources);
        }
    } else if (name == "a") {
        translation_.put(angle_, node.span);
    } else if (name == "b" || name == "c" || name == "d") {
        translation_.put("value_" + std::string(name), node.span);
    } else if (name == "t") {
        translation_.put(in_premise ? "0" : "step()", node.span);
    } else if (name == "g") {
        translation_.put(in_premise ? "0" : "g", node.span);
    } else if (name == "i") {
        report_unsupported(node.span,
                           "where a module stands in the word, `i`, is not known to rules of lsc, "
                           "except as the seed of `rand`");
    } else if (name.size() == 1 && kTurtleVariables.find(name[0]) != std::string_view::npos) {
        report_unsupported(node.span,
                           "`" + std::string(name) +
                               "` is of the turtle, which draws when all rules have been applied");
    } else {
        session_.context.diagnostics.add(
            DiagnosticCode::ForeignSyntax, node.span,
            "`" + shown(name) + "` is neither a parameter of this rule nor a variable of Houdini");
    }
}

void HoudiniExpressions::write_call(const HoudiniNode& node, const HoudiniScope& scope) {
    const std::string_view name = session_.context.sources.text(node.span);
    if (name == "rand") {
        write_random(node, scope);
        return;
    }
    if (name == "int") {
        write_integer(node);
        return;
    }
    const auto* const found =
        std::find_if(kFunctions.begin(), kFunctions.end(),
                     [&](const Function& function) { return function.name == name; });
    if (found == kFunctions.end()) {
        const bool of_scene = name == "in" || name == "pic";
        report_unsupported(node.span,
                           of_scene ? "`" + std::string(name) +
                                          "` asks an input of Houdini's node, which lsc does not "
                                          "have"
                                    : "lsc has no function `" + shown(name) + "`");
        return;
    }
    translation_.put(found->in_lsys, node.span);
    translation_.put("(", node.span);
    items_.push_back({-1, ")", node.span});
    for (std::size_t i = node.parts.size(); i-- > 0;) {
        items_.push_back({node.parts[i], {}, {}});
        if (i != 0) {
            items_.push_back({-1, ", ", node.span});
        }
    }
}

/// Returns whether an expression has a random number. Sets `is_positive` to whether the expression
/// is certain to be at least 0.
bool HoudiniExpressions::draws(int root, bool& is_positive) const {
    bool found = false;
    is_positive = true;
    std::vector<int> open{root};
    while (!open.empty()) {
        const HoudiniNode& node = session_.node(open.back());
        open.pop_back();
        const std::string_view text = session_.context.sources.text(node.span);
        const bool random = node.kind == HoudiniNodeKind::Call && text == "rand";
        const bool keeps_sign =
            node.kind == HoudiniNodeKind::Number || node.kind == HoudiniNodeKind::Group ||
            (node.kind == HoudiniNodeKind::Binary && (text == "+" || text == "*" || text == "/"));
        found = found || random;
        is_positive = is_positive && (random || keeps_sign);
        if (!random) {
            open.insert(open.end(), node.parts.begin(), node.parts.end());
        }
    }
    return found;
}

/// Writes `int(x)`, x without its fraction, as `(sign(x) * floor(abs(x)))`. An x with a random
/// number is written once only, as `floor(x)`, because each copy would draw another number.
void HoudiniExpressions::write_integer(const HoudiniNode& node) {
    bool is_positive = false;
    if (node.parts.size() != 1) {
        session_.context.diagnostics.add(DiagnosticCode::ForeignSyntax, node.span,
                                         "`int` takes one number");
    } else if (!draws(node.parts[0], is_positive)) {
        items_.push_back({-1, ")))", node.span});
        items_.push_back({node.parts[0], {}, {}});
        items_.push_back({-1, ") * floor(abs(", node.span});
        items_.push_back({node.parts[0], {}, {}});
        items_.push_back({-1, "(sign(", node.span});
    } else if (is_positive) {
        items_.push_back({-1, ")", node.span});
        items_.push_back({node.parts[0], {}, {}});
        items_.push_back({-1, "floor(", node.span});
    } else {
        report_unsupported(node.span, "`int` of a random number that may be below 0");
    }
}

/// Writes `{0, 1}` for `rand(seed)`; the seed is ignored.
void HoudiniExpressions::write_random(const HoudiniNode& node, const HoudiniScope& scope) {
    if (scope.place == HoudiniPlace::Condition || scope.place == HoudiniPlace::Probability) {
        Diagnostic& error =
            session_.context.diagnostics.add(DiagnosticCode::ForeignFeature, node.span,
                                             "chance cannot stand in a condition or probability");
        error.help.emplace_back("write the probability behind the rule, as in `A=B:0.3`; a first "
                                "rule with `rand(i)<0.3` and a second without condition are read");
        return;
    }
    warn_random(node.span);
    translation_.put("{0, 1}", node.span);
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
