// SPDX-License-Identifier: MIT
// The functions of a grammar, #function and #curve: their definitions, and their calls, which are
// inlined.
#include "compiler/bytecode/distributions.h"
#include "compiler/resolve/impl/expressions.h"
#include "grammar/base/cancellation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsys {

namespace {

constexpr std::uint32_t kMaxFormals = 8;
constexpr std::uint32_t kMinPoints = 2;
constexpr std::uint32_t kMaxPoints = 256;
/// Max numbers of values that inlining the calls of one statement, and of all statements, may
/// create. If each of n functions calls the next one twice, inlining creates 2^n values.
constexpr std::size_t kMaxExpanded = std::size_t{1} << 18;
constexpr std::size_t kMaxExpandedInAll = std::size_t{1} << 21;

} // namespace

bool ExpressionResolver::check_free_name(NameId name, SourceSpan span) {
    const std::string_view text = resolution_.text(name);
    UserFunction& function = user_functions_.at(name);
    if (functions_.contains(name)) {
        function.state = ConstantState::Failed;
        resolution_.diagnostics.add(DiagnosticCode::BadFunction, span,
                                    fmt::format("`{}` is a function of the language", text));
        return false;
    }
    if (function.span != span) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::DuplicateStatement, span, fmt::format("a second function `{}`", text));
        error.labels.push_back({function.span, "the first is here"});
        return false;
    }
    return true;
}

/// Adds the formals; reports formals that are not names or not distinct.
bool ExpressionResolver::read_formals(const FunctionNode& node) {
    if (node.formals.count == 0 || node.formals.count > kMaxFormals) {
        resolution_.diagnostics.add(DiagnosticCode::BadFunction, node.formals_span,
                                    fmt::format("a function has 1 to {} parameters, not {}",
                                                kMaxFormals, node.formals.count));
        return false;
    }
    bool ok = true;
    for (std::uint32_t i = 0; i < node.formals.count; ++i) {
        const Expression& formal =
            resolution_.ast.expression(resolution_.ast.expression_lists[node.formals.first + i]);
        if (formal.kind != ExpressionKind::Name) {
            if (formal.kind != ExpressionKind::Error) {
                Diagnostic& error = resolution_.diagnostics.add(
                    DiagnosticCode::BadFunction, formal.span(), "a parameter is a name");
                error.help.emplace_back("for example `#function taper(x) 1 - x^2;`");
            }
            ok = false;
        } else if (!add_formal(formal.name, formal.span())) {
            Diagnostic& error = resolution_.diagnostics.add(
                DiagnosticCode::DuplicateFormal, formal.span(),
                fmt::format("a second parameter `{}`", resolution_.text(formal.name)));
            error.labels.push_back({formal_span(formal.name), "the first is here"});
            ok = false;
        }
    }
    return ok;
}

void ExpressionResolver::define_function(const FunctionNode& node) {
    begin_statement();
    const bool is_free = check_free_name(node.name, node.name_span);
    const bool has_formals = read_formals(node);
    if (!has_formals) {
        set_formals_incomplete();
    }
    defining_ = node.name;
    const ValueId body = resolve(node.body, ExpressionPlace::Function);
    defining_ = kNoName;
    if (!is_free) {
        return;
    }
    UserFunction& function = user_functions_.at(node.name);
    if (!has_formals || body == kPoison) {
        function.state = ConstantState::Failed;
        return;
    }
    function.state = ConstantState::Known;
    function.body = body;
    function.uses.assign(node.formals.count, 0);
    std::unordered_set<ValueId> is_met;
    std::vector<ValueId> work{body};
    while (!work.empty()) {
        const ValueId id = work.back();
        work.pop_back();
        if (id == kNoValue || values_.is_literal(id) || !is_met.insert(id).second) {
            continue;
        }
        function.nodes.push_back(id);
        const Value& value = values_[id];
        if (value.opcode == Opcode::Formal) {
            ++function.uses[value.index];
        }
        function.has_choice = function.has_choice || value.opcode == Opcode::If;
        for (const ValueId operand : value.operands()) {
            work.push_back(operand);
        }
    }
    std::sort(function.nodes.begin(), function.nodes.end()); // operands come before their users
}

std::optional<std::vector<CurveKnot>> ExpressionResolver::read_points(const CurveNode& node) {
    const std::uint32_t count = node.coordinates.count / 2;
    if (count < kMinPoints || count > kMaxPoints) {
        resolution_.diagnostics.add(
            DiagnosticCode::BadFunction, node.name_span,
            fmt::format("a curve has {} to {} points, not {}", kMinPoints, kMaxPoints, count));
        return std::nullopt;
    }
    std::vector<CurveKnot> points(count);
    for (std::uint32_t i = 0; i < 2 * count; ++i) {
        const ExpressionId root = resolution_.ast.expression_lists[node.coordinates.first + i];
        const SourceSpan span = resolution_.ast.expression(root).span();
        const std::optional<float> number = constant_value(resolve(root, ExpressionPlace::Curve));
        if (!number) {
            return std::nullopt; // already reported
        }
        CurveKnot& point = points[i / 2];
        (i % 2 == 0 ? point.x : point.y) = *number;
        if (!std::isfinite(*number)) {
            resolution_.diagnostics.add(DiagnosticCode::BadFunction, span,
                                        fmt::format("{} is not a coordinate", *number));
            return std::nullopt;
        }
        if (i % 2 == 0 && i > 0 && !(points[i / 2 - 1].x < point.x)) {
            resolution_.diagnostics
                .add(DiagnosticCode::BadFunction, span,
                     fmt::format("x is {}, but the point before it is at {}", point.x,
                                 points[i / 2 - 1].x))
                .help.emplace_back("the points of a curve ascend from left to right");
            return std::nullopt;
        }
    }
    return points;
}

void ExpressionResolver::define_curve(const CurveNode& node) {
    begin_statement();
    const bool is_free = check_free_name(node.name, node.name_span);
    std::optional<std::vector<CurveKnot>> points = read_points(node);
    if (!is_free) {
        return;
    }
    UserFunction& function = user_functions_.at(node.name);
    function.is_curve = true;
    function.uses.assign(1, 1);
    if (!points) {
        function.state = ConstantState::Failed;
        return;
    }
    function.state = ConstantState::Known;
    set_slopes(*points);
    function.curve = static_cast<std::uint32_t>(resolution_.program.curves.size());
    resolution_.program.curves.push_back({node.name, node.name_span, std::move(*points)});
}

ValueId ExpressionResolver::user_call(const Expression& expression,
                                      ExpressionPlace place,
                                      UserFunction& function,
                                      std::span<const ValueId> arguments) {
    const std::string_view name = resolution_.text(expression.name);
    if (function.state == ConstantState::Failed) {
        return kPoison;
    }
    if (function.state != ConstantState::Known) {
        if (expression.name == defining_) {
            resolution_.diagnostics.add(DiagnosticCode::BadFunction, expression.span(),
                                        fmt::format("the function `{}` calls itself", name));
        } else if (mark_reported(expression.name)) {
            Diagnostic& error = resolution_.diagnostics.add(
                DiagnosticCode::UsedBeforeDefinition, expression.span(),
                fmt::format("the function `{}` is used before its definition", name));
            error.labels.push_back({function.span, "it is defined here"});
            error.help.emplace_back("move the definition above this statement");
        }
        return kPoison;
    }
    if (arguments.size() != function.uses.size()) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::WrongArgumentCount, expression.span(),
            fmt::format("`{}` takes {} argument{}, not {}", name, function.uses.size(),
                        function.uses.size() == 1 ? "" : "s", arguments.size()));
        error.labels.push_back({function.span, "it is defined here"});
        return kPoison;
    }
    if (std::find(arguments.begin(), arguments.end(), kPoison) != arguments.end()) {
        return kPoison;
    }
    const SourceSpan span = expression.span();
    if (function.is_curve) {
        return values_.curve(function.curve, resolution_.program.curves[function.curve].points,
                             arguments[0], span);
    }
    for (const ValueId id : function.nodes) {
        if (values_[id].opcode == Opcode::Global) {
            is_random_ = true;
            if (!drawn_constants_allowed(place)) {
                Diagnostic& error = resolution_.diagnostics.add(
                    DiagnosticCode::RangeNotAllowed, span,
                    fmt::format("`{}` uses a constant that is drawn at random, so it cannot stand "
                                "here",
                                name));
                error.labels.push_back({values_[id].span, "the constant"});
                return kPoison;
            }
        }
    }
    expanded_count_ += function.nodes.size() + 1;
    expanded_in_all_ += function.nodes.size() + 1;
    const bool statement_is_too_large = expanded_count_ > kMaxExpanded;
    if (statement_is_too_large || expanded_in_all_ > kMaxExpandedInAll) {
        if (mark_reported(expression.name)) {
            resolution_.diagnostics.add(
                DiagnosticCode::ProgramTooLarge, span,
                fmt::format("the functions of {} expand to more than {} operations",
                            statement_is_too_large ? "this statement" : "the grammar",
                            statement_is_too_large ? kMaxExpanded : kMaxExpandedInAll));
        }
        return kPoison;
    }
    return expanded(function, arguments, span);
}

bool ExpressionResolver::draws(ValueId root) const {
    std::vector<ValueId> work{root};
    while (!work.empty()) {
        const ValueId id = work.back();
        work.pop_back();
        if (id == kNoValue) {
            continue;
        }
        if (is_draw(values_[id].opcode)) {
            return true;
        }
        for (const ValueId operand : values_[id].operands()) {
            work.push_back(operand);
        }
    }
    return false;
}

ValueId ExpressionResolver::expanded(const UserFunction& function,
                                     std::span<const ValueId> arguments,
                                     SourceSpan span) {
    stop_if_cancelled();
    std::vector<std::pair<std::uint32_t, ValueId>> slots; // new slots with their values
    std::vector<std::uint32_t> slot_of(arguments.size(), kNone);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const bool stands_in_body = values_.is_leaf(arguments[i]) ||
                                    (function.uses[i] == 1 && !function.has_choice) ||
                                    (function.uses[i] == 0 && !draws(arguments[i]));
        if (!stands_in_body) {
            slot_of[i] = slot_count_++;
            slots.emplace_back(slot_of[i], arguments[i]);
        }
    }
    std::unordered_map<ValueId, ValueId> copies;
    std::unordered_map<std::uint32_t, ValueId> values_of_slots; // slots set in the body
    for (const ValueId id : function.nodes) {
        if (values_[id].opcode == Opcode::SetLocal) {
            values_of_slots.emplace(values_[id].index, values_[id].left);
        }
    }
    std::unordered_map<std::uint32_t, std::uint32_t> inner_slots;
    const auto copy_of = [&](ValueId id) {
        const auto found = copies.find(id);
        return found == copies.end() ? id : found->second; // literals are not copied
    };
    const auto slot_for = [&](std::uint32_t slot) {
        const auto [found, is_new] = inner_slots.try_emplace(slot, slot_count_);
        slot_count_ += is_new ? 1U : 0U;
        return found->second;
    };
    for (const ValueId id : function.nodes) {
        const Value value = values_[id]; // a copy, since adding values may move the node
        ValueId copy = kPoison;
        switch (value.opcode) {
        case Opcode::Formal:
            copy = slot_of[value.index] != kNone
                       ? values_.leaf(Opcode::Local, slot_of[value.index], span)
                   : values_.is_leaf(arguments[value.index])
                       ? values_.leaf_at(arguments[value.index], span)
                       : arguments[value.index];
            break;
        case Opcode::Local: {
            // A slot whose value is now a leaf is replaced by that leaf.
            const ValueId known = copy_of(values_of_slots.at(value.index));
            copy = values_.is_leaf(known)
                       ? values_.leaf_at(known, span)
                       : values_.leaf(Opcode::Local, slot_for(value.index), span);
            break;
        }
        case Opcode::SetLocal:
            copy = values_.is_leaf(copy_of(value.left))
                       ? copy_of(value.right)
                       : values_.with_local(slot_for(value.index), copy_of(value.left),
                                            copy_of(value.right), span);
            break;
        case Opcode::Curve:
            copy = values_.curve(value.index, resolution_.program.curves[value.index].points,
                                 copy_of(value.left), span);
            break;
        case Opcode::If:
            copy = values_.choice(copy_of(value.third), copy_of(value.left), copy_of(value.right),
                                  span);
            break;
        case Opcode::Mix:
            copy =
                values_.mix(copy_of(value.left), copy_of(value.right), copy_of(value.third), span);
            break;
        default:
            copy = value.left == kNoValue
                       ? values_.leaf_at(id, span)
                       : values_.operation(
                             value.opcode, copy_of(value.left),
                             value.right == kNoValue ? kNoValue : copy_of(value.right), span);
            break;
        }
        copies[id] = copy;
    }
    ValueId result = copy_of(function.body);
    for (std::size_t i = slots.size(); i-- > 0;) {
        result = values_.with_local(slots[i].first, slots[i].second, result, span);
    }
    return result;
}

} // namespace lsys
