// SPDX-License-Identifier: MIT
// Resolves expressions of the Ast to values of the Program: names become formals and constants,
// functions become instructions, constants are folded, ranges numbered. ExpressionPlace decides
// what an expression may contain.
#pragma once

#include "compiler/resolve/impl/attempts.h"
#include "compiler/resolve/impl/constants.h"
#include "compiler/resolve/impl/resolution.h"
#include "compiler/resolve/impl/values.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace lsys {

/// The part of a grammar in which an expression stands.
enum class ExpressionPlace : std::uint8_t {
    Generations, // the number of #n
    Define,
    Param,
    Bound, // min or max of a #param
    Setting,
    Axiom,
    AxiomProbability,
    Condition,
    Probability,
    Function,    // the body of a #function
    Curve,       // a coordinate of a #curve
    Contour,     // a coordinate of a #contour
    Material,    // a number of a #material
    Environment, // a number of a #sense
    Local,       // the value of a `let`
    Successor,
};

/// Whether constants that are drawn when the derivation starts are allowed in this place.
[[nodiscard]] bool drawn_constants_allowed(ExpressionPlace place);

class ExpressionResolver {
public:
    ExpressionResolver(Resolution& resolution, ValueBuilder& values, ConstantTable& constants);

    /// Begins a statement: clears formals, local values, reported names and the draw counter.
    void begin_statement();
    /// Adds a formal of the current production; `where` is its place in messages. Returns false if
    /// the name already is a formal.
    bool add_formal(NameId name, SourceSpan where);
    [[nodiscard]] SourceSpan formal_span(NameId name) const;
    /// Defines the function of a #function or #curve, or reports why it cannot be used.
    void define_function(const FunctionNode& node);
    void define_curve(const CurveNode& node);
    /// Reserves the slots below `count` for local values. Arguments of functions get later slots.
    void reserve_slots(std::uint32_t count) { slot_count_ = count; }
    /// True: expressions of the Ast are not released after use, until keep_expressions(false).
    void keep_expressions(bool keep) { keeps_expressions_ = keep; }

    /// Announces a local value of the current production that add_local() will define, for messages
    /// about uses before the definition.
    void expect_local(NameId name);
    /// Defines a local value: its name means `value` if that is a leaf, else the content of slot
    /// `slot`.
    void add_local(NameId name, ValueId value, std::uint32_t slot);
    /// Whether an expression after add_local() has used the local value.
    [[nodiscard]] bool is_local_used(NameId name) const { return used_locals_.contains(name); }
    /// Suppresses messages about unknown names, because the head of the production has an error.
    void set_formals_incomplete() { formals_incomplete_ = true; }

    /// The value of an expression, or kPoison if it contains an error, which has been reported. A
    /// parameter or condition that can never be finite is an error in the axiom. In a production it
    /// is a warning, since the production may match no module.
    [[nodiscard]] ValueId resolve(ExpressionId root, ExpressionPlace place);
    /// The value of a single name, for values of #set.
    [[nodiscard]] ValueId resolve_name(NameId name, SourceSpan span, ExpressionPlace place);
    /// Whether the name is a constant, defined before or after this point.
    [[nodiscard]] bool is_constant(NameId name) const {
        return constants_.state(name) != ConstantState::Unknown;
    }
    /// Whether the definition of an unknown name may have been lost: it stands in a statement with
    /// a syntax error or in a missing file, or the text is a part of a grammar.
    [[nodiscard]] bool may_be_missing(std::string_view name) const {
        return files_missing_ || attempted_.defines(name) || resolution_.options.part;
    }
    /// Whether the last resolved value depends on a random number.
    [[nodiscard]] bool is_random() const { return is_random_; }
    /// Number of draws since begin_statement().
    [[nodiscard]] std::uint32_t draw_count() const { return draw_count_; }

    /// The number, if the value is a literal.
    [[nodiscard]] std::optional<float> constant_value(ValueId id) const;

private:
    struct Frame {
        ExpressionId expression{};
        std::uint32_t next = 0; // index of the next operand to visit
    };
    /// The cause of a constant that is infinite or NaN.
    struct NonFiniteCause {
        SourceSpan span;
        std::string reason;
        std::optional<SourceSpan> definition; // of the constant that is the cause, if one is
    };
    struct Function {
        Opcode opcode;
        std::uint32_t argument_count;
    };
    /// A function defined by the grammar: a #function or a #curve.
    struct UserFunction {
        explicit UserFunction(SourceSpan place) : span(place) {}

        SourceSpan span; // name in the first definition
        ConstantState state = ConstantState::Later;
        bool is_curve = false;
        std::uint32_t curve = 0; // index in Program::curves
        /// Number of uses in the body per formal, numbered as Value::index of Opcode::Formal.
        std::vector<std::uint32_t> uses;
        std::vector<ValueId> nodes; // body without literals, operands before users
        ValueId body = kPoison;     // root of the body
        bool has_choice = false;    // the body has an if()
    };

    /// Processes the top expression: pushes its next operand, or combines the values of all
    /// operands.
    void visit(ExpressionPlace place);
    /// Pushes the value of an expression, computed from the values of its operands, to operands_.
    void combine(const Expression& expression, ExpressionPlace place);
    /// Whether weights may depend on parameters and on step(): with `#set weights any`.
    [[nodiscard]] bool weights_may_vary() const;
    [[nodiscard]] ValueId name_value(const Expression& expression, ExpressionPlace place);
    /// The value of an expression that names a constant; marks the constant as used.
    [[nodiscard]] ValueId constant_of(const Expression& expression, ExpressionPlace place);
    [[nodiscard]] ValueId range_value(const Expression& expression, ExpressionPlace place);
    [[nodiscard]] ValueId distribution_value(const Expression& expression,
                                             Opcode opcode,
                                             std::span<const ValueId> arguments,
                                             ExpressionPlace place);
    /// Returns false after reporting that ranges and distributions are not allowed in `place`.
    [[nodiscard]] bool check_random_allowed(const Expression& expression, ExpressionPlace place);
    /// The value of a random draw; gives it the next draw number of the statement.
    [[nodiscard]] ValueId draw_value(Opcode opcode,
                                     ValueId first,
                                     ValueId second,
                                     const Expression& expression,
                                     ExpressionPlace place);
    [[nodiscard]] ValueId call_value(const Expression& expression, ExpressionPlace place);
    /// The value of an operation; records a zero divisor or an infinite result for check_finite().
    [[nodiscard]] ValueId
    apply(Opcode opcode, ValueId left, ValueId right, const Expression& expression);
    /// The value of a call of if().
    [[nodiscard]] ValueId choice_value(const Expression& expression,
                                       std::span<const ValueId> arguments);
    /// Forgets divisors that are zero, and causes of infinite values, within `unchosen`.
    void forget_faults(SourceSpan unchosen);
    /// The value of a call of a #function or #curve.
    [[nodiscard]] ValueId user_call(const Expression& expression,
                                    ExpressionPlace place,
                                    UserFunction& function,
                                    std::span<const ValueId> arguments);
    /// Inlines a call: a copy of the body with the arguments in place of the formals. An argument
    /// that the body uses several times, or once if the body has a choice, is computed once into a
    /// slot, as is an unused argument that draws a random number. Leaves need no slot.
    [[nodiscard]] ValueId
    expanded(const UserFunction& function, std::span<const ValueId> arguments, SourceSpan span);
    /// Whether a value draws a random number, so that computing it may be a run-time error.
    [[nodiscard]] bool draws(ValueId root) const;
    /// Returns false after reporting that another function has the name.
    [[nodiscard]] bool check_free_name(NameId name, SourceSpan span);
    [[nodiscard]] bool read_formals(const FunctionNode& node);
    [[nodiscard]] std::optional<std::vector<CurveKnot>> read_points(const CurveNode& node);
    [[nodiscard]] ValueId pop();
    [[nodiscard]] std::uint32_t operand_count(const Expression& expression) const;
    [[nodiscard]] ExpressionId operand(const Expression& expression, std::uint32_t index) const;

    // Messages.
    void report_unknown_name(const Expression& expression);
    /// The smallest span that shows why a result is not finite: a divisor that is zero, the `^` of
    /// a power, else the whole expression.
    [[nodiscard]] SourceSpan
    fault_place(Opcode opcode, std::optional<float> right, const Expression& expression) const;
    /// Whether the unknown name `text` can only mean the one parameter of the production: both
    /// names have one letter, there are no constants, and nothing else after the predecessor reads
    /// the parameter.
    [[nodiscard]] bool must_mean_formal(std::string_view text, const Expression& unknown) const;
    /// Explains the probable meaning of a call with a wrong number of arguments.
    void
    explain_argument_count(const Expression& call, ExpressionPlace place, Diagnostic& error) const;
    /// The function whose name became `text` when all `x` of a file were replaced by `len`: `max`
    /// for `malen`. Empty if there is none.
    [[nodiscard]] std::string_view name_before_replacement(std::string_view text) const;
    void report_unknown_function(const Expression& expression, NameId function);
    /// Reports a range or distribution (`is_range`) or a name that the place does not allow.
    void report_not_allowed(const Expression& expression, ExpressionPlace place, bool is_range);
    /// Reports a parameter or condition that can never be finite.
    void check_finite(ValueId value, ExpressionId root, ExpressionPlace place);
    /// Returns false after reporting bounds from which no number can be drawn.
    [[nodiscard]] bool check_range(const Expression& expression, ValueId minimum, ValueId maximum);
    /// Reports a constant argument that is invalid for the distribution. Returns whether all
    /// constant arguments are valid.
    [[nodiscard]] bool check_distribution_of(const Expression& expression,
                                             Opcode opcode,
                                             ValueId first,
                                             ValueId second);
    /// Whether the statement has no report about the name yet; adds the name to reported_.
    [[nodiscard]] bool mark_reported(NameId name) { return reported_.insert(name).second; }

    Resolution& resolution_;
    ValueBuilder& values_;
    ConstantTable& constants_;
    AttemptedStatements attempted_;
    Suggestions suggestions_;
    bool files_missing_ = false;                     // an included file could not be read
    std::unordered_map<NameId, Function> functions_; // functions of the language
    std::unordered_map<NameId, UserFunction> user_functions_;
    std::uint32_t slot_count_ = 0;    // slots in use in the current statement
    std::size_t expanded_count_ = 0;  // values made by calls in the current statement
    std::size_t expanded_in_all_ = 0; // and in all statements so far
    bool keeps_expressions_ = false;  // see keep_expressions()
    NameId defining_ = kNoName;       // the function whose body is being resolved
    NameId step_;                     // the name `step`
    NameId steps_;                    // the name `steps`

    std::vector<std::uint32_t> formal_of_; // per name: number of the formal, or kNone
    std::vector<NameId> formals_;
    std::vector<SourceSpan> formal_spans_;
    bool formals_incomplete_ = false; // set_formals_incomplete() was called for this statement
    /// Per name: the local value, or kNoValue after expect_local() alone.
    std::unordered_map<NameId, ValueId> locals_;
    std::unordered_set<NameId> used_locals_;
    std::unordered_set<NameId> reported_; // names with an error in this statement
    bool drawn_once_noted_ = false;       // the statement has the note [drawn-once]
    std::uint32_t draw_count_ = 0;
    std::size_t last_root_ = 0; // the largest id resolved so far
    bool is_random_ = false;

    std::vector<Frame> frames_;     // expressions being visited, the innermost last
    std::vector<ValueId> operands_; // values that combine() has pushed
    std::optional<NonFiniteCause> non_finite_cause_;
    std::vector<SourceSpan> zero_divisors_; // places of zero divisors in the expression
};

} // namespace lsys
