// Expressions of the Ast to values of the Program: names to formals and constants, functions to
// instructions, constants folded, ranges numbered. Every place in the language allows something
// else in its expressions; ExpressionPlace says what.
#pragma once

#include "compiler/resolve/impl/attempts.h"
#include "compiler/resolve/impl/constants.h"
#include "compiler/resolve/impl/resolution.h"
#include "compiler/resolve/impl/values.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace lsys {

enum class ExpressionPlace : std::uint8_t {
    Generations,
    Define,
    Param,
    Bound, // of a #param
    Setting,
    Axiom,
    Condition,
    Probability,
    Successor,
};

class ExpressionResolver {
public:
    ExpressionResolver(Resolution& resolution, ValueBuilder& values, ConstantTable& constants);

    /// Begins a statement: no formals, nothing reported yet, ranges numbered from 0.
    void begin_statement();
    /// Adds a formal of the production at hand; `where` serves messages. False: there is one.
    bool add_formal(NameId name, SourceSpan where);
    [[nodiscard]] SourceSpan formal_span(NameId name) const;
    /// Names may be unknown because the head of the production is in error: keep quiet about them.
    void set_formals_incomplete() { formals_incomplete_ = true; }

    /// The value of an expression; kPoison after an error was reported here or before. Where the
    /// value reaches a module or a condition, it is an error that it can never be finite.
    [[nodiscard]] ValueId resolve(ExpressionId root, ExpressionPlace place);
    /// The same for a name that stands alone, as after #set.
    [[nodiscard]] ValueId resolve_name(NameId name, SourceSpan span, ExpressionPlace place);
    /// Whether the value last resolved depends on a range.
    [[nodiscard]] bool is_drawn() const { return is_drawn_; }
    /// Ranges met since begin_statement().
    [[nodiscard]] std::uint32_t draw_count() const { return draw_count_; }

    /// The literal, if the value is one.
    [[nodiscard]] std::optional<float> constant_value(ValueId id) const;

private:
    struct Frame {
        ExpressionId expression{};
        std::uint32_t next = 0; // operand to visit
    };
    /// Why a constant is infinite or not a number.
    struct Culprit {
        SourceSpan span;
        std::string reason;
        std::optional<SourceSpan> definition;
    };
    struct Function {
        Opcode opcode;
        std::uint32_t argument_count;
    };

    void visit(ExpressionPlace place);
    void combine(const Expression& expression, ExpressionPlace place);
    [[nodiscard]] ValueId name_value(const Expression& expression, ExpressionPlace place);
    [[nodiscard]] ValueId constant_of(const Expression& expression, ExpressionPlace place);
    [[nodiscard]] ValueId range_value(const Expression& expression, ExpressionPlace place);
    [[nodiscard]] ValueId call_value(const Expression& expression, ExpressionPlace place);
    [[nodiscard]] ValueId
    apply(Opcode opcode, ValueId left, ValueId right, const Expression& expression);
    [[nodiscard]] ValueId pop();
    [[nodiscard]] std::uint32_t operand_count(const Expression& expression) const;
    [[nodiscard]] ExpressionId operand(const Expression& expression, std::uint32_t index) const;

    // messages
    void report_unknown_name(const Expression& expression);
    void report_unknown_function(const Expression& expression, NameId function);
    void report_not_allowed(const Expression& expression, ExpressionPlace place, bool is_range);
    void check_finite(ValueId value, ExpressionId root, ExpressionPlace place);
    [[nodiscard]] bool check_range(const Expression& expression, ValueId minimum, ValueId maximum);
    [[nodiscard]] bool first_report_of(NameId name) { return reported_.insert(name).second; }

    Resolution& resolution_;
    ValueBuilder& values_;
    ConstantTable& constants_;
    AttemptedStatements attempted_;
    Suggestions suggestions_;
    bool files_missing_ = false;
    std::unordered_map<NameId, Function> functions_;
    NameId step_;
    NameId steps_;

    std::vector<std::uint32_t> formal_of_; // by name: number of the formal, or kNone
    std::vector<NameId> formals_;
    std::vector<SourceSpan> formal_spans_;
    bool formals_incomplete_ = false;
    std::unordered_set<NameId> reported_; // names with an error in this statement
    bool drawn_once_noted_ = false;
    std::uint32_t draw_count_ = 0;
    std::size_t last_root_ = 0; // the greatest id resolved so far
    bool is_drawn_ = false;

    std::vector<Frame> frames_;
    std::vector<ValueId> operands_;
    std::optional<Culprit> culprit_;
    std::vector<SourceSpan> zero_divisors_;
};

} // namespace lsys
