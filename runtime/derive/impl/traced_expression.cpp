// SPDX-License-Identifier: MIT
#include "runtime/derive/impl/traced_expression.h"

#include "compiler/bytecode/arithmetic.h"
#include "compiler/bytecode/curve.h"
#include "compiler/bytecode/distributions.h"
#include "compiler/bytecode/interpret.h"
#include "compiler/bytecode/verify.h"
#include "runtime/derive/word_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

/// Max bytes of the text of an expression: longer texts are cut.
constexpr std::size_t kMaxText = 160;

/// Precedence of an operation, ascending (docs/language.md section 4).
enum class Binding : std::uint8_t { Or, And, Equal, Less, Add, Multiply, Unary, Power, Leaf };

struct Infix {
    std::string_view sign;
    Binding binding = Binding::Leaf;
};

/// The sign of an operation between two operands; empty for functions.
Infix infix_of(Opcode opcode) {
    switch (opcode) {
    case Opcode::Or:
        return {"||", Binding::Or};
    case Opcode::And:
        return {"&&", Binding::And};
    case Opcode::Equal:
        return {"==", Binding::Equal};
    case Opcode::NotEqual:
        return {"!=", Binding::Equal};
    case Opcode::Less:
        return {"<", Binding::Less};
    case Opcode::LessEqual:
        return {"<=", Binding::Less};
    case Opcode::Greater:
        return {">", Binding::Less};
    case Opcode::GreaterEqual:
        return {">=", Binding::Less};
    case Opcode::Add:
        return {"+", Binding::Add};
    case Opcode::Subtract:
        return {"-", Binding::Add};
    case Opcode::Multiply:
        return {"*", Binding::Multiply};
    case Opcode::Divide:
        return {"/", Binding::Multiply};
    case Opcode::Power:
        return {"^", Binding::Power};
    default:
        return {};
    }
}

std::string number_text(float value) {
    if (std::isnan(value)) {
        return "not a number";
    }
    if (std::isinf(value)) {
        return value > 0.0F ? "infinity" : "-infinity";
    }
    std::string text;
    append_number(value, text);
    return text;
}

/// A value with its text.
struct PrintedValue {
    float number = 0.0F;
    std::string text;
    Binding binding = Binding::Leaf;
    bool is_new_slot = true; // of a value in a slot: set since the last enter()
    bool is_truth = false;   // a comparison or a logical operation
};

std::string cut(std::string text) {
    if (text.size() > kMaxText) {
        text.resize(kMaxText - 3);
        text += "...";
    }
    return text;
}

PrintedValue leaf(float number, std::string text) {
    return {number, std::move(text), Binding::Leaf};
}

/// The value of an operand of `&&`, `||` or `!`: `true` or `false` if it is a truth value.
std::string truth_text(const PrintedValue& printed) {
    if (!printed.is_truth) {
        return number_text(printed.number);
    }
    return printed.number != 0.0F ? "true" : "false";
}

/// The text of an operand, in parentheses if its precedence is below `min_binding`.
std::string operand(const PrintedValue& printed, Binding min_binding) {
    return printed.binding < min_binding ? "(" + printed.text + ")" : printed.text;
}

Binding tighter(Binding binding) {
    return static_cast<Binding>(static_cast<std::uint8_t>(binding) + 1);
}

/// Domain of interpret(); a value is a number with the text of its expression.
struct PrintedNumbers : UnknownDomain<PrintedValue> {
    static constexpr bool kRunsOneSide = true;

    PrintedNumbers(const TracedFrame& given, RangeDraws* from, std::uint64_t first)
        : frame(given), draws(from), first_draw(first), slots(given.bytecode.local_count) {}

    const TracedFrame& frame;
    RangeDraws* draws; // null: no random range is evaluated
    std::uint64_t first_draw;
    bool is_successor = false; // only successors have local values
    std::vector<PrintedValue> slots;
    std::vector<TracedPart> parts;
    std::vector<TracedRange> ranges;
    std::map<std::size_t, TracedLocal> locals; // by slot
    std::vector<std::string> choices;          // conditions of `if` in the next local value
    std::vector<PrintedValue> taken;           // values of Emit and Test instructions
    std::string fault;                         // why the evaluation ended early; empty: it did not

    /// Names the slots of local values that the last instruction has set. Other slots hold
    /// arguments of functions.
    bool enter() {
        const std::size_t named =
            frame.names == nullptr || !is_successor ? 0 : frame.names->locals.size();
        for (std::size_t i = 0; i < slots.size(); ++i) {
            PrintedValue& slot = slots[i];
            if (slot.is_new_slot && !slot.text.empty() && i < named) {
                locals[i] = {frame.names->locals[i].name, slot.text, slot.number,
                             std::exchange(choices, {})};
                slot.text = frame.names->locals[i].name;
                slot.binding = Binding::Leaf;
            }
            slot.is_new_slot = false;
        }
        return true;
    }
    static PrintedValue literal(float value) { return leaf(value, number_text(value)); }
    [[nodiscard]] PrintedValue formal(std::uint32_t index) const {
        const bool named = frame.names != nullptr && index < frame.names->formals.size();
        return leaf(frame.values.formals[index],
                    named ? frame.names->formals[index] : "$" + std::to_string(index));
    }
    [[nodiscard]] PrintedValue global(std::uint32_t index) const {
        return leaf(frame.values.globals[index], frame.bytecode.globals[index].name);
    }
    [[nodiscard]] PrintedValue step() const { return leaf(frame.values.step, "step()"); }
    [[nodiscard]] PrintedValue steps() const { return leaf(frame.values.steps, "steps()"); }
    [[nodiscard]] PrintedValue branch_draw(std::uint32_t branch) const {
        return leaf(draws == nullptr ? 0.0F : draws->draw_branch(branch), "branch");
    }

    /// Adds an operation to `parts` and returns it. `values`: its text with numbers as operands.
    PrintedValue add(PrintedValue printed, std::string values, bool is_truth) {
        printed.text = cut(std::move(printed.text));
        printed.is_truth = is_truth;
        parts.push_back({printed.text, std::move(values), printed.number, is_truth});
        return printed;
    }
    PrintedValue
    call(std::string_view name, std::vector<const PrintedValue*> operands, float number) {
        std::string text(name);
        std::string values(name);
        for (std::size_t i = 0; i < operands.size(); ++i) {
            text += (i == 0 ? "(" : ", ") + operands[i]->text;
            values += (i == 0 ? "(" : ", ") + number_text(operands[i]->number);
        }
        return add(leaf(number, text + ")"), values + ")", false);
    }
    PrintedValue unary(Opcode opcode, const PrintedValue& x) {
        const float number = arithmetic::apply(opcode, x.number, 0.0F);
        if (opcode == Opcode::Negate || opcode == Opcode::Not) {
            const char* const sign = opcode == Opcode::Not ? "!" : "-";
            PrintedValue result{number, sign + operand(x, Binding::Unary), Binding::Unary};
            if (opcode == Opcode::Negate && x.binding == Binding::Leaf) {
                return result; // `-x` of a leaf x gets no TracedPart
            }
            return add(std::move(result),
                       sign + (opcode == Opcode::Not ? truth_text(x) : number_text(x.number)),
                       opcode == Opcode::Not);
        }
        return call(info(opcode).mnemonic, {&x}, number);
    }
    PrintedValue binary(Opcode opcode, const PrintedValue& x, const PrintedValue& y) {
        const float number = arithmetic::apply(opcode, x.number, y.number);
        const Infix infix = infix_of(opcode);
        if (infix.sign.empty()) {
            return call(info(opcode).mnemonic, {&x, &y}, number);
        }
        const bool chains =
            infix.binding != Binding::Equal && infix.binding != Binding::Less; // not `a < b < c`
        const bool to_right = infix.binding == Binding::Power;
        const Binding next = tighter(infix.binding);
        const std::string sign = " " + std::string(infix.sign) + " ";
        PrintedValue result{number,
                            operand(x, chains && !to_right ? infix.binding : next) + sign +
                                operand(y, to_right ? infix.binding : next),
                            infix.binding};
        const bool joins = opcode == Opcode::And || opcode == Opcode::Or;
        return add(std::move(result),
                   joins ? truth_text(x) + sign + truth_text(y)
                         : number_text(x.number) + sign + number_text(y.number),
                   infix.binding <= Binding::Less);
    }
    PrintedValue curve(std::uint32_t index, const PrintedValue& x) {
        const BytecodeCurve& curve = frame.bytecode.curves[index];
        return call(curve.name, {&x}, curve_value(curve.points, x.number));
    }
    PrintedValue mix(const PrintedValue& x, const PrintedValue& y, const PrintedValue& t) {
        return call("mix", {&x, &y, &t}, arithmetic::mix(x.number, y.number, t.number));
    }
    bool holds(const PrintedValue& x) {
        if (!x.is_truth) { // a truth value is a part already
            parts.push_back({"if(" + x.text + ", ...)", "if(" + number_text(x.number) + ", ...)",
                             x.number != 0.0F ? 1.0F : 0.0F, true});
        }
        choices.push_back(x.text + " is " + (x.is_truth ? truth_text(x) : number_text(x.number)));
        return x.number != 0.0F;
    }
    bool random_draw(Opcode opcode,
                     PrintedValue& x,
                     const PrintedValue& y,
                     std::uint32_t index,
                     const std::uint32_t* /*at*/) {
        TracedRange range;
        range.opcode = opcode;
        range.number = first_draw + index;
        range.arguments = {x.number};
        std::string inner = x.text;
        if (opcode != Opcode::Poisson) {
            range.arguments.push_back(y.number);
            inner += ", " + y.text;
        }
        const bool is_range = opcode == Opcode::Range;
        range.text = cut(is_range ? "{" + inner + "}"
                                  : std::string(info(opcode).mnemonic) + "(" + inner + ")");
        fault = is_range ? range_fault(range) : distribution_fault(range, x.number, y.number);
        if (!fault.empty() || draws == nullptr) {
            return false;
        }
        range.unit = draws->draw(index);
        range.value = is_range ? draw_in_range(x.number, y.number, range.unit)
                               : draw_from(opcode, x.number, y.number, range.unit);
        x = leaf(range.value, range.text);
        ranges.push_back(std::move(range));
        return true;
    }
    static std::string range_fault(const TracedRange& range) {
        const float minimum = range.arguments[0];
        const float maximum = range.arguments[1];
        switch (check_range(minimum, maximum)) {
        case Fault::None:
            return {};
        case Fault::RangeReversed:
            return range.text + " has its minimum " + number_text(minimum) + " above its maximum " +
                   number_text(maximum);
        default:
            return range.text + " has the bounds " + number_text(minimum) + " and " +
                   number_text(maximum) + ", which must be finite, as must be their difference";
        }
    }
    static std::string distribution_fault(const TracedRange& range, float x, float y) {
        if (check_distribution(range.opcode, x, y) == DistributionFault::None) {
            return {};
        }
        return range.text + " cannot be drawn from " + number_text(x) +
               (range.arguments.size() > 1 ? " and " + number_text(y) : std::string());
    }
    bool take(const PrintedValue& x, const std::uint32_t* /*at*/) {
        if (!std::isfinite(x.number)) {
            fault = x.text + " is " + number_text(x.number);
        }
        taken.push_back(x);
        return fault.empty();
    }

    /// Adds the local values that are leaves, such as a literal or a formal, which no code
    /// computes. Called after run(), which adds the local values that code computes.
    void add_leaves() {
        const std::size_t named = frame.names == nullptr ? 0 : frame.names->locals.size();
        for (std::size_t i = 0; i < named; ++i) {
            const ProductionNames::Local& local = frame.names->locals[i];
            if (const std::optional<PrintedValue> printed = leaf_of(local)) {
                locals[i] = {local.name, printed->text, printed->number, {}};
            }
        }
    }
    [[nodiscard]] std::optional<PrintedValue> leaf_of(const ProductionNames::Local& local) const {
        switch (local.leaf) {
        case Opcode::Literal:
            return literal(local.literal);
        case Opcode::Formal:
            return formal(local.index);
        case Opcode::Global:
            return global(local.index);
        case Opcode::Step:
            return step();
        case Opcode::Steps:
            return steps();
        case Opcode::Local:
            return local.index < slots.size() ? std::optional(slots[local.index]) : std::nullopt;
        default:
            return std::nullopt;
        }
    }

    /// Runs the code at `first`; does nothing for kNone.
    bool run(std::uint32_t first) {
        std::vector<PrintedValue> stack(
            std::max<std::size_t>(frame.bytecode.stack_depth, kUsualStack));
        return first == kNone || interpret(frame.bytecode.instructions.data() + first, *this,
                                           stack.data(), slots.data());
    }
};

} // namespace

ExpressionTrace trace_condition(const TracedFrame& frame, std::uint32_t first) {
    PrintedNumbers numbers(frame, nullptr, 0);
    static_cast<void>(numbers.run(first));
    ExpressionTrace trace;
    if (!numbers.taken.empty()) {
        trace.text = std::move(numbers.taken.front().text);
        trace.value = numbers.taken.front().number;
    }
    trace.is_finite = numbers.fault.empty();
    trace.parts = std::move(numbers.parts);
    return trace;
}

SuccessorTrace trace_successor(const TracedFrame& frame,
                               const WordTemplate& word,
                               RangeDraws draws,
                               std::uint64_t first_draw) {
    PrintedNumbers numbers(frame, &draws, first_draw);
    numbers.is_successor = true;
    const bool ok = numbers.run(word.locals) && numbers.run(word.arguments);
    SuccessorTrace trace;
    numbers.add_leaves();
    for (auto& [slot, local] : numbers.locals) {
        trace.locals.push_back(std::move(local));
    }
    trace.ranges = std::move(numbers.ranges);
    for (const PrintedValue& taken : numbers.taken) {
        trace.arguments.push_back(taken.number);
    }
    if (!ok) {
        trace.fault = std::move(numbers.fault);
    }
    return trace;
}

} // namespace lsys
