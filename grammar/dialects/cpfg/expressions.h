// SPDX-License-Identifier: MIT
// Expressions and statements of cpfg in .lsys. An assignment of a production becomes a local value,
// an assignment of the header a constant, and `if` chooses among the values of the variables that
// its blocks assign. The value of a global variable is known if each step adds the same amount to
// the variable or assigns it before reading it.
#pragma once

#include "grammar/dialects/cpfg/curves.h"
#include "grammar/dialects/cpfg/known_values.h"
#include "grammar/dialects/cpfg/session.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

class CpfgExpressions {
public:
    CpfgExpressions(CpfgSession& session, const std::vector<CpfgCurve>& curves)
        : session_(session), tree_(session.expressions), curves_(curves),
          known_values_(session.expressions) {}

    /// Runs `define:`, `Start:` and the other blocks of the header.
    void read_header();
    /// Begins the axiom or a setting, where global variables have their initial values.
    void begin_axiom();
    /// Begins a production with its formals and without variables. `stage` is the stage of the
    /// .lsys production to be written.
    void begin(std::set<std::string> formals, Stage stage);
    /// Makes the random numbers of the production parameters of the intermediate module of its
    /// group (writer.h), numbered from `first`.
    void bind_draws(std::uint32_t first);
    /// Defines a variable of the production.
    void let(const std::string& name, ForeignId value) { variables_[name] = value; }
    /// Runs statements: variables take the .lsys equivalents of their values.
    void run(const std::vector<int>& statements);
    /// Returns the equivalent of an expression in .lsys.
    [[nodiscard]] ForeignId term(ForeignId expression);
    /// Count of random numbers of the production so far.
    [[nodiscard]] std::uint32_t draws() const { return draws_; }
    /// Index in ForeignExpressions::locals() of the first local value that is not a constant.
    [[nodiscard]] std::size_t end_of_constants() const { return end_of_constants_; }
    /// Writes the arrays and functions that expressions read.
    void write_functions(Translation& out, SourceSpan place) const;

    /// Suppresses reports, for statements whose mistakes have been reported.
    void set_quiet(bool quiet) { quiet_ = quiet; }
    /// Warns that lsc ignores `what`, once for each `what`.
    void warn_left_out(SourceSpan span, const std::string& what, const std::string& message);

private:
    using Variables = std::map<std::string, ForeignId>; // value per name: a leaf node
    /// A file of numbers, opened by `fopen` in `Start:`.
    struct DataFile {
        std::string text;
        std::size_t at = 0; // offset of the next number in `text`
    };
    struct Array {
        std::vector<int> sizes;
        std::vector<ForeignId> values;
        std::string name;       // name of the curve in .lsys; empty while nothing reads the array
        bool is_broken = false; // an error in its definition has been reported
    };

    /// The equivalent of a name: a variable, a formal or `Q`.
    [[nodiscard]] ForeignId name(const ForeignNode& node);
    /// The equivalent of a function call.
    [[nodiscard]] ForeignId call(const ForeignNode& node);
    /// The equivalent of `ran(size)` or `nran(mean, sd)`.
    [[nodiscard]] ForeignId random_call(const ForeignNode& node, std::vector<ForeignId> arguments);
    /// The equivalent of `func(which, x)`, where `which` is a number or the name of a function of
    /// the set.
    [[nodiscard]] ForeignId curve(const ForeignNode& node);
    /// The value of a curve at a known `x` in its table, or nullopt.
    [[nodiscard]] std::optional<double> known_point(std::size_t curve, ForeignId x);
    /// An element of an array, read from the array's curve; an index out of range reads the nearest
    /// one.
    [[nodiscard]] ForeignId element(const ForeignNode& node);
    /// The equivalent of an operation on two values.
    [[nodiscard]] ForeignId binary(const ForeignNode& node);
    /// A node for the next random number of the production.
    [[nodiscard]] ForeignId draw(SourceSpan span) { return tree_.draw(draws_++, span); }
    /// Position of an element in Array::values, or nullopt if its indices are not known.
    [[nodiscard]] std::optional<std::size_t> known_place(const Array& array,
                                                         const ForeignNode& node);
    /// Truncates a number to an integer.
    [[nodiscard]] ForeignId truncated(ForeignId value, SourceSpan span);
    /// The node of a variable, as read at `span`.
    [[nodiscard]] ForeignId read(ForeignId value, SourceSpan span);
    /// The literal that `value` is known to be, or empty. The local values that lead to it become
    /// inline, so the literal replaces their names.
    [[nodiscard]] std::string known_literal(ForeignId value);
    /// Assigns a value to a variable; adds a local value unless the value already has a name.
    void assign(const std::string& variable, ForeignId value, SourceSpan span);
    void run(const CpfgStatement& statement);
    /// Runs an `if`. If its test is not known, each variable that a block assigns becomes an if().
    void branch(const CpfgStatement& statement);
    /// Runs the block as often as cpfg would. In each round, the test must have a value that is
    /// known before the word is derived.
    void loop(const CpfgStatement& statement);
    void assign_element(const CpfgStatement& statement);
    void set_element(const ForeignNode& target, ForeignId value, SourceSpan span);
    /// Runs `fp = fopen("name", "r");`; returns false for other assignments.
    [[nodiscard]] bool open_file(const CpfgStatement& statement);
    /// Runs `fscanf(fp, "%lf", &x);`. As in cpfg, a variable keeps its value where the file ends.
    void read_numbers(const ForeignNode& call);
    /// A node with a known number.
    [[nodiscard]] ForeignId number_node(double value, SourceSpan span);
    /// In loops, replaces a known value by its number, so that values do not grow with the rounds.
    [[nodiscard]] ForeignId folded(ForeignId value);
    /// Runs a call whose value is not used, such as `fclose(fp);`.
    void call_statement(const CpfgStatement& statement);
    /// Adds the array of a definition to arrays_.
    void define_array(const CpfgStatement& statement);
    /// Adds the variables that the statements assign to changed_globals_.
    void collect_changed_globals(const std::vector<int>& statements);
    /// Classifies the variables that the blocks of a step (`StartEach:`, `EndEach:`) assign:
    /// incremented by each step, assigned anew by each step, or unknown. Then runs the calls in
    /// these blocks.
    void classify_changed_globals();
    /// Number of assignments to the variable `to` in the statements and in their blocks.
    [[nodiscard]] int count_assignments(const std::vector<int>& statements,
                                        const std::string& to) const;
    /// Returns true when the expression has one of the names, or a random number.
    [[nodiscard]] bool uses(ForeignId expression, const std::set<std::string>& names) const;
    /// Returns true when a value assigned to `to` has a random number or one of the names in it.
    [[nodiscard]] bool depends(const std::vector<int>& statements,
                               const std::string& to,
                               const std::set<std::string>& names) const;
    /// The expression that each step adds to the variable, or kNoForeign. It exists if the only
    /// assignment to the variable is `v = v + e;` outside of any `if`, and `e` is neither random
    /// nor changed by a step.
    [[nodiscard]] ForeignId increment_of(const std::string& variable) const;
    /// Whether statements assign the variable before they read it; nullopt if they do neither.
    [[nodiscard]] std::optional<bool> is_assigned_first(const std::vector<int>& statements,
                                                        const std::string& variable) const;
    /// Finds the values of global variables in the production that begins.
    void enter_step();
    /// The initial value of a global variable, assigned in `Start:`.
    [[nodiscard]] ForeignId first_value(const std::string& global, SourceSpan span);
    [[nodiscard]] const CpfgStatement& statement_at(int index) const {
        return session_.statements[static_cast<std::size_t>(index)];
    }
    /// Reports a feature that .lsys lacks; returns the number 0 in its place.
    [[nodiscard]] ForeignId unsupported(SourceSpan span, const std::string& message) {
        if (!quiet_) {
            session_.report_unsupported(span, message);
        }
        return tree_.number("0", span);
    }

    CpfgSession& session_;
    ForeignExpressions& tree_;
    const std::vector<CpfgCurve>& curves_;
    Variables variables_; // values of the variables of the current block or production
    Variables globals_;   // initial values of variables of the whole system
    Variables state_;     // values of changing globals in this production
    std::map<std::string, ForeignId> increments_; // per global: amount that each step adds
    std::set<std::string> assigned_each_step_; // globals that each step assigns before reading them
    std::map<std::string, Array> arrays_;
    std::map<std::string, DataFile> files_; // by name of the variable, `fp` in fopen()
    /// Names of functions in .lsys, by index in curves_; only of curves that expressions call.
    std::map<std::size_t, CpfgCurveNames> curve_names_;
    std::map<std::size_t, std::vector<double>> tables_; // by index in curves_
    std::set<std::string> function_names_;  // names of functions and curves in .lsys, all taken
    std::set<std::string> formals_;         // formals of the current production
    std::set<std::string> changed_globals_; // globals that blocks of a step assign
    std::set<Stage> reported_stages_;       // stages whose step statements have been reported
    std::set<std::string> warned_;          // each `what` of warn_left_out()
    KnownValues known_values_;
    int loops_ = 0;                    // number of nested loops that are being unrolled
    std::size_t loop_statements_ = 0;  // statements of loops run so far
    std::uint32_t draws_ = 0;          // random numbers of the production so far
    std::size_t end_of_constants_ = 0; // see end_of_constants()
    Stage stage_ = Stage::Rewrite;     // stage of the current production
    bool binds_draws_ = false;         // random numbers are parameters, see bind_draws()
    bool in_header_ = false;           // in a block of the header
    bool in_axiom_ = false;            // in the axiom or a setting
    bool in_step_ = false;             // whether the current block runs in each step
    bool has_integer_part_ = false;    // an expression calls int(), which .lsys lacks
    bool has_normal_ = false;          // an expression calls nran()
    bool quiet_ = false;               // see set_quiet()
};

/// `text` with `_` for invalid characters; `fallback` if only `_` is left.
[[nodiscard]] std::string cpfg_name_of(std::string_view text, std::string_view fallback);
[[nodiscard]] bool is_cpfg_number(std::string_view text);
/// Whether a number is 0. Precondition: is_cpfg_number(text).
[[nodiscard]] bool is_cpfg_zero(std::string_view text);

} // namespace lsys
