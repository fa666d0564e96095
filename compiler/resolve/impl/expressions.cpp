// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/expressions.h"

#include "compiler/bytecode/distributions.h"
#include "compiler/bytecode/instructions.h"
#include "compiler/resolve/impl/folding_faults.h"
#include "compiler/resolve/known_words.h"
#include "grammar/base/cancellation.h"
#include "grammar/base/contract.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lsys {

namespace {

struct FunctionRow {
    std::string_view name;
    Opcode opcode;
};

constexpr std::array kFunctions{
    FunctionRow{"sin", Opcode::Sin},           FunctionRow{"cos", Opcode::Cos},
    FunctionRow{"tan", Opcode::Tan},           FunctionRow{"asin", Opcode::Asin},
    FunctionRow{"acos", Opcode::Acos},         FunctionRow{"atan", Opcode::Atan},
    FunctionRow{"atan2", Opcode::Atan2},       FunctionRow{"sqrt", Opcode::Sqrt},
    FunctionRow{"exp", Opcode::Exp},           FunctionRow{"log", Opcode::Log},
    FunctionRow{"pow", Opcode::Power},         FunctionRow{"abs", Opcode::Abs},
    FunctionRow{"floor", Opcode::Floor},       FunctionRow{"ceil", Opcode::Ceil},
    FunctionRow{"round", Opcode::Round},       FunctionRow{"sign", Opcode::Sign},
    FunctionRow{"min", Opcode::Min},           FunctionRow{"max", Opcode::Max},
    FunctionRow{"mod", Opcode::Mod},           FunctionRow{"step", Opcode::Step},
    FunctionRow{"steps", Opcode::Steps},       FunctionRow{"mix", Opcode::Mix},
    FunctionRow{"clamp", Opcode::Min},         FunctionRow{"if", Opcode::If},
    FunctionRow{"normal", Opcode::Normal},     FunctionRow{"poisson", Opcode::Poisson},
    FunctionRow{"binomial", Opcode::Binomial},
};

/// Number of arguments of a function. Two differ from the operands of their opcode: `clamp(x, low,
/// high)` becomes min(max(x, low), high), and `if` has both sides as arguments.
constexpr std::uint32_t argument_count(const FunctionRow& row) {
    return row.name == "clamp" || row.name == "if"
               ? 3
               : kOpcodePops[static_cast<std::size_t>(row.opcode)];
}

Opcode opcode_of(UnaryOperation operation) {
    return operation == UnaryOperation::Negate ? Opcode::Negate : Opcode::Not;
}

/// The enumerators of BinaryOperation have the order of the opcodes from Power to Or.
constexpr Opcode opcode_of(BinaryOperation operation) {
    return static_cast<Opcode>(static_cast<std::size_t>(Opcode::Power) +
                               static_cast<std::size_t>(operation));
}
static_assert(opcode_of(BinaryOperation::Power) == Opcode::Power &&
              opcode_of(BinaryOperation::Subtract) == Opcode::Subtract &&
              opcode_of(BinaryOperation::Less) == Opcode::Less &&
              opcode_of(BinaryOperation::NotEqual) == Opcode::NotEqual &&
              opcode_of(BinaryOperation::Or) == Opcode::Or);

bool in_production(ExpressionPlace place) {
    return place == ExpressionPlace::Condition || place == ExpressionPlace::Local ||
           place == ExpressionPlace::Successor;
}

/// Whether `{min, max}` and distributions are allowed in this place.
bool ranges_allowed(ExpressionPlace place) {
    return place == ExpressionPlace::Define || place == ExpressionPlace::Param ||
           place == ExpressionPlace::Axiom || place == ExpressionPlace::Local ||
           place == ExpressionPlace::Successor;
}

} // namespace

bool drawn_constants_allowed(ExpressionPlace place) {
    return ranges_allowed(place) || place == ExpressionPlace::Condition ||
           place == ExpressionPlace::Function;
}

std::vector<std::string_view> function_names() {
    std::vector<std::string_view> names;
    names.reserve(kFunctions.size());
    for (const FunctionRow& row : kFunctions) {
        names.push_back(row.name);
    }
    return names;
}

ExpressionResolver::ExpressionResolver(Resolution& resolution,
                                       ValueBuilder& values,
                                       ConstantTable& constants)
    : resolution_(resolution), values_(values), constants_(constants), attempted_(resolution),
      step_(resolution.names.intern("step")), steps_(resolution.names.intern("steps")) {
    for (const FunctionRow& row : kFunctions) {
        functions_.emplace(resolution.names.intern(row.name),
                           Function{row.opcode, argument_count(row)});
    }
    for (const Statement& statement : resolution.ast.statements) {
        if (statement.kind == StatementKind::Function) {
            const FunctionNode& node = resolution.ast.functions[statement.index];
            user_functions_.try_emplace(node.name, UserFunction(node.name_span));
        } else if (statement.kind == StatementKind::Curve) {
            const CurveNode& node = resolution.ast.curves[statement.index];
            user_functions_.try_emplace(node.name, UserFunction(node.name_span));
        }
    }
    for (const IncludeNode& include : resolution.ast.includes) {
        files_missing_ = files_missing_ || include.file == kNoFile;
    }
    formal_of_.assign(resolution.names.count(), kNone);
}

void ExpressionResolver::begin_statement() {
    // In the Ast, operands come before their users and statements follow each other, so every
    // expression before the last root has been resolved.
    if (!keeps_expressions_) {
        resolution_.ast.expressions.release_before(last_root_);
    }
    for (const NameId formal : formals_) {
        formal_of_[index_of(formal)] = kNone;
    }
    formals_.clear();
    formal_spans_.clear();
    locals_.clear();
    used_locals_.clear();
    slot_count_ = 0;
    expanded_count_ = 0;
    formals_incomplete_ = false;
    reported_.clear();
    drawn_once_noted_ = false;
    draw_count_ = 0;
}

bool ExpressionResolver::add_formal(NameId name, SourceSpan where) {
    std::uint32_t& number = formal_of_[index_of(name)];
    if (number != kNone) {
        return false;
    }
    number = static_cast<std::uint32_t>(formals_.size());
    formals_.push_back(name);
    formal_spans_.push_back(where);
    return true;
}

void ExpressionResolver::expect_local(NameId name) {
    locals_.emplace(name, kNoValue);
}

void ExpressionResolver::add_local(NameId name, ValueId value, std::uint32_t slot) {
    const bool is_known = value == kPoison || values_.is_leaf(value);
    locals_[name] = is_known ? value : values_.leaf(Opcode::Local, slot, values_[value].span);
}

SourceSpan ExpressionResolver::formal_span(NameId name) const {
    return formal_spans_[formal_of_[index_of(name)]];
}

std::optional<float> ExpressionResolver::constant_value(ValueId id) const {
    if (id == kNoValue || !values_.is_literal(id)) {
        return std::nullopt;
    }
    return values_[id].literal;
}

ValueId ExpressionResolver::resolve(ExpressionId root, ExpressionPlace place) {
    is_random_ = false;
    non_finite_cause_.reset();
    zero_divisors_.clear();
    last_root_ = std::max(last_root_, static_cast<std::size_t>(root));
    frames_.push_back({root, 0});
    while (!frames_.empty()) {
        visit(place);
    }
    const ValueId value = pop();
    LSYS_CHECK(operands_.empty(), operands_.size());
    check_finite(value, root, place);
    return value;
}

ValueId ExpressionResolver::resolve_name(NameId name, SourceSpan span, ExpressionPlace place) {
    Expression expression;
    expression.kind = ExpressionKind::Name;
    expression.file = span.file;
    expression.begin = span.begin;
    expression.end = span.end;
    expression.name = name;
    is_random_ = false;
    non_finite_cause_.reset();
    return name_value(expression, place);
}

void ExpressionResolver::visit(ExpressionPlace place) {
    stop_if_cancelled();
    Frame& frame = frames_.back();
    const Expression& expression = resolution_.ast.expression(frame.expression);
    if (frame.next < operand_count(expression)) {
        frames_.push_back({operand(expression, frame.next++), 0});
        return;
    }
    frames_.pop_back();
    combine(expression, place);
}

std::uint32_t ExpressionResolver::operand_count(const Expression& expression) const {
    switch (expression.kind) {
    case ExpressionKind::Number:
    case ExpressionKind::Name:
    case ExpressionKind::Error:
        return 0;
    case ExpressionKind::Unary:
    case ExpressionKind::Grouping:
        return 1;
    case ExpressionKind::Binary:
    case ExpressionKind::Range:
        return 2;
    case ExpressionKind::Call:
        return resolution_.ast.argument_lists[expression.arguments].count;
    }
    return 0;
}

ExpressionId ExpressionResolver::operand(const Expression& expression, std::uint32_t index) const {
    if (expression.kind == ExpressionKind::Call) {
        const ListRange list = resolution_.ast.argument_lists[expression.arguments];
        return resolution_.ast.expression_lists[list.first + index];
    }
    return index == 0 ? expression.left : expression.right;
}

ValueId ExpressionResolver::pop() {
    const ValueId value = operands_.back();
    operands_.pop_back();
    return value;
}

void ExpressionResolver::combine(const Expression& expression, ExpressionPlace place) {
    switch (expression.kind) {
    case ExpressionKind::Number:
        operands_.push_back(values_.literal(expression.value, expression.span()));
        return;
    case ExpressionKind::Name:
        operands_.push_back(name_value(expression, place));
        return;
    case ExpressionKind::Error:
        operands_.push_back(kPoison);
        return;
    case ExpressionKind::Grouping:
        return;
    case ExpressionKind::Unary:
        operands_.push_back(apply(opcode_of(expression.unary()), pop(), kNoValue, expression));
        return;
    case ExpressionKind::Binary: {
        const ValueId right = pop();
        const ValueId left = pop();
        operands_.push_back(apply(opcode_of(expression.binary()), left, right, expression));
        return;
    }
    case ExpressionKind::Range:
        operands_.push_back(range_value(expression, place));
        return;
    case ExpressionKind::Call:
        operands_.push_back(call_value(expression, place));
        return;
    }
}

ValueId ExpressionResolver::apply(Opcode opcode,
                                  ValueId left,
                                  ValueId right,
                                  const Expression& expression) {
    const auto x = constant_value(left);
    const auto y = constant_value(right);
    const ValueId result = values_.operation(opcode, left, right, expression.span());
    if ((opcode == Opcode::Divide || opcode == Opcode::Mod) && y == 0.0F && result != kPoison) {
        const SourceSpan divisor = resolution_.ast.expression(operand(expression, 1)).span();
        zero_divisors_.push_back(divisor);
    }
    if (const auto folded = constant_value(result);
        folded && !std::isfinite(*folded) && !non_finite_cause_) {
        non_finite_cause_ = NonFiniteCause{
            fault_place(opcode, y, expression),
            reason_for_fault(opcode, x.value_or(0.0F), y.value_or(0.0F)), std::nullopt};
    }
    return result;
}

bool ExpressionResolver::weights_may_vary() const {
    return resolution_.program.settings.weights == WeightRule::Any;
}

ValueId ExpressionResolver::name_value(const Expression& expression, ExpressionPlace place) {
    if (const std::uint32_t formal = formal_of_[index_of(expression.name)]; formal != kNone) {
        if (place == ExpressionPlace::Probability && !weights_may_vary()) {
            Diagnostic& error = resolution_.diagnostics.add(
                DiagnosticCode::BadProbability, expression.span(),
                fmt::format("a probability cannot depend on the parameter `{}`",
                            resolution_.text(expression.name)));
            error.help.emplace_back("write `#set weights any;`, or productions with conditions for "
                                    "the cases");
            return kPoison;
        }
        return values_.leaf(Opcode::Formal, formal, expression.span());
    }
    if (const auto local = locals_.find(expression.name);
        local != locals_.end() && local->second != kNoValue) {
        used_locals_.insert(expression.name);
        return values_.leaf_at(local->second, expression.span());
    }
    if (constants_.state(expression.name) == ConstantState::Known) {
        return constant_of(expression, place);
    }
    report_unknown_name(expression);
    return kPoison;
}

ValueId ExpressionResolver::constant_of(const Expression& expression, ExpressionPlace place) {
    Constant& constant = constants_.constant(expression.name);
    constant.is_used = true;
    if (constant.is_random) {
        is_random_ = true;
        const bool is_weight = place == ExpressionPlace::Probability && weights_may_vary();
        if (!drawn_constants_allowed(place) && !is_weight) {
            report_not_allowed(expression, place, false);
            return kPoison;
        }
        return values_.leaf(Opcode::Global, constant.global, expression.span());
    }
    if (!std::isfinite(constant.value) && !non_finite_cause_) {
        non_finite_cause_ =
            NonFiniteCause{expression.span(),
                           std::isnan(constant.value) ? "this constant is not a number"
                                                      : "this constant is infinite",
                           constant.span};
    }
    return values_.literal(constant.value, expression.span());
}

ValueId ExpressionResolver::range_value(const Expression& expression, ExpressionPlace place) {
    const ValueId maximum = pop();
    const ValueId minimum = pop();
    return check_random_allowed(expression, place) && check_range(expression, minimum, maximum)
               ? draw_value(Opcode::Range, minimum, maximum, expression, place)
               : kPoison;
}

ValueId ExpressionResolver::distribution_value(const Expression& expression,
                                               Opcode opcode,
                                               std::span<const ValueId> arguments,
                                               ExpressionPlace place) {
    const ValueId second = arguments.size() > 1 ? arguments[1] : kNoValue;
    return check_random_allowed(expression, place) &&
                   check_distribution_of(expression, opcode, arguments[0], second)
               ? draw_value(opcode, arguments[0], second, expression, place)
               : kPoison;
}

bool ExpressionResolver::check_random_allowed(const Expression& expression, ExpressionPlace place) {
    is_random_ = true;
    if (!ranges_allowed(place)) {
        report_not_allowed(expression, place, true);
        return false;
    }
    return true;
}

ValueId ExpressionResolver::draw_value(Opcode opcode,
                                       ValueId first,
                                       ValueId second,
                                       const Expression& expression,
                                       ExpressionPlace place) {
    if (!in_production(place) && !drawn_once_noted_) {
        drawn_once_noted_ = true;
        Diagnostic& note = resolution_.diagnostics.add(
            DiagnosticCode::DrawnOnce, expression.span(),
            fmt::format("{} is drawn once, when the derivation starts",
                        opcode == Opcode::Range ? "this range" : "this number"));
        note.notes.emplace_back("in a successor it would be drawn each time a module is rewritten");
    }
    return values_.draw(opcode, first, second, draw_count_++, expression.span());
}

ValueId ExpressionResolver::call_value(const Expression& expression, ExpressionPlace place) {
    const std::uint32_t count = operand_count(expression);
    const std::vector<ValueId> arguments(operands_.end() - static_cast<std::ptrdiff_t>(count),
                                         operands_.end());
    operands_.resize(operands_.size() - count);

    if (const auto user = user_functions_.find(expression.name); user != user_functions_.end()) {
        return user_call(expression, place, user->second, arguments);
    }
    const auto found = functions_.find(expression.name);
    if (found == functions_.end()) {
        report_unknown_function(expression, expression.name);
        return kPoison;
    }
    const Function function = found->second;
    const std::string_view name = resolution_.text(expression.name);
    if (count != function.argument_count) {
        Diagnostic& error = resolution_.diagnostics.add(
            DiagnosticCode::WrongArgumentCount, expression.span(),
            fmt::format("`{}` takes {}, not {}", name,
                        function.argument_count == 0   ? "no arguments"
                        : function.argument_count == 1 ? "one argument"
                        : function.argument_count == 2 ? "two arguments"
                                                       : "three arguments",
                        count));
        explain_argument_count(expression, place, error);
        return kPoison;
    }
    if (count == 0) {
        const bool is_weight = place == ExpressionPlace::Probability && weights_may_vary();
        if (!in_production(place) && !is_weight) {
            Diagnostic& error =
                resolution_.diagnostics.add(DiagnosticCode::StepNotAllowed, expression.span(),
                                            fmt::format("`{}()` has no value here", name));
            error.notes.emplace_back("it changes while words are rewritten, so it may stand in the "
                                     "conditions and successors of productions only");
            return kPoison;
        }
        return values_.leaf(function.opcode, 0, expression.span());
    }
    if (is_distribution(function.opcode)) {
        return distribution_value(expression, function.opcode, arguments, place);
    }
    if (count < 3) {
        return apply(function.opcode, arguments[0], count > 1 ? arguments[1] : kNoValue,
                     expression);
    }
    switch (function.opcode) {
    case Opcode::If:
        return choice_value(expression, arguments);
    case Opcode::Mix:
        return values_.mix(arguments[0], arguments[1], arguments[2], expression.span());
    default: // clamp
        return apply(Opcode::Min, apply(Opcode::Max, arguments[0], arguments[1], expression),
                     arguments[2], expression);
    }
}

ValueId ExpressionResolver::choice_value(const Expression& expression,
                                         std::span<const ValueId> arguments) {
    if (const auto condition = constant_value(arguments[0])) {
        // A division by zero or an overflow in the branch that is not chosen is not an error.
        const bool holds = *condition != 0.0F;
        forget_faults(resolution_.ast.expression(operand(expression, holds ? 2 : 1)).span());
    }
    return values_.choice(arguments[0], arguments[1], arguments[2], expression.span());
}

void ExpressionResolver::forget_faults(SourceSpan unchosen) {
    const auto is_inside = [&](SourceSpan span) {
        return span.file == unchosen.file && span.begin >= unchosen.begin &&
               span.end <= unchosen.end;
    };
    std::erase_if(zero_divisors_, is_inside);
    if (non_finite_cause_ && is_inside(non_finite_cause_->span)) {
        non_finite_cause_.reset();
    }
}

} // namespace lsys
