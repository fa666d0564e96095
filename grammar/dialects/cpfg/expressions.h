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
    /// Turns the random numbers of the production into parameters of its module, numbered from
    /// `first`.
    void bind_draws(std::uint32_t first);
    /// Defines a variable of the production.
    void let(const std::string& name, ForeignId value) { variables_[name] = value; }
    void run(const std::vector<int>& statements);
    /// Returns the equivalent of an expression in .lsys.
    [[nodiscard]] ForeignId term(ForeignId expression);
    /// Count of random numbers of the production so far.
    [[nodiscard]] std::uint32_t draws() const { return draws_; }
    /// Index of the first local value that is not a constant.
    [[nodiscard]] std::size_t end_of_constants() const { return end_of_constants_; }
    /// Writes the arrays and functions that expressions read.
    void write_functions(Translation& out, SourceSpan place) const;

    /// Suppresses reports, for statements whose mistakes have been reported.
    void set_quiet(bool quiet) { quiet_ = quiet; }
    /// Warns that lsc ignores `what`, once for each `what`.
    void warn_left_out(SourceSpan span, const std::string& what, const std::string& message);

private:
    using Variables = std::map<std::string, ForeignId>; // leaf nodes
    /// A file of numbers, opened by `fopen` in `Start:`.
    struct DataFile {
        std::string text;
        std::size_t at = 0; // where the next number begins
    };
    struct Array {
        std::vector<int> sizes;
        std::vector<ForeignId> values;
        std::string name;       // name of the curve in .lsys; empty while nothing reads the array
        bool is_broken = false; // an error in its definition has been reported
    };

    [[nodiscard]] ForeignId name(const ForeignNode& node);
    [[nodiscard]] ForeignId call(const ForeignNode& node);
    [[nodiscard]] ForeignId random_call(const ForeignNode& node, std::vector<ForeignId> arguments);
    [[nodiscard]] ForeignId curve(const ForeignNode& node);
    /// The value of a curve at a known `x` in its table, or nullopt.
    [[nodiscard]] std::optional<double> known_point(std::size_t curve, ForeignId x);
    [[nodiscard]] ForeignId element(const ForeignNode& node);
    [[nodiscard]] ForeignId binary(const ForeignNode& node);
    [[nodiscard]] ForeignId draw(SourceSpan span) { return tree_.draw(draws_++, span); }
    /// Position of an element in Array::values, or nullopt if its indices are not known.
    [[nodiscard]] std::optional<std::size_t> known_place(const Array& array,
                                                         const ForeignNode& node);
    [[nodiscard]] ForeignId truncated(ForeignId value, SourceSpan span);
    /// The node of a variable, as read at `span`.
    [[nodiscard]] ForeignId read(ForeignId value, SourceSpan span);
    /// The literal that `value` is known to be, or empty. The local values that lead to it become
    /// inline, so the literal replaces their names.
    [[nodiscard]] std::string known_literal(ForeignId value);
    void assign(const std::string& variable, ForeignId value, SourceSpan span);
    void run(const CpfgStatement& statement);
    void branch(const CpfgStatement& statement);
    void loop(const CpfgStatement& statement);
    void assign_element(const CpfgStatement& statement);
    void set_element(const ForeignNode& target, ForeignId value, SourceSpan span);
    [[nodiscard]] bool opens_file(const CpfgStatement& statement);
    void read_numbers(const ForeignNode& call);
    /// A node with a known number.
    [[nodiscard]] ForeignId number_node(double value, SourceSpan span);
    [[nodiscard]] ForeignId folded(ForeignId value);
    void call_statement(const CpfgStatement& statement);
    void define_array(const CpfgStatement& statement);
    void find_changed_globals(const std::vector<int>& statements);
    void classify_changed_globals();
    [[nodiscard]] int assignments(const std::vector<int>& statements, const std::string& to) const;
    /// Returns true when the expression has one of the names, or a random number.
    [[nodiscard]] bool uses(ForeignId expression, const std::set<std::string>& names) const;
    [[nodiscard]] bool depends(const std::vector<int>& statements,
                               const std::string& to,
                               const std::set<std::string>& names) const;
    [[nodiscard]] ForeignId increment_of(const std::string& variable) const;
    [[nodiscard]] std::optional<bool> is_assigned_first(const std::vector<int>& statements,
                                                        const std::string& variable) const;
    void enter_step();
    [[nodiscard]] ForeignId first_value(const std::string& global, SourceSpan span);
    [[nodiscard]] const CpfgStatement& statement_at(int index) const {
        return session_.statements[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] ForeignId unsupported(SourceSpan span, const std::string& message) {
        if (!quiet_) {
            session_.report_unsupported(span, message);
        }
        return tree_.number("0", span);
    }

    CpfgSession& session_;
    ForeignExpressions& tree_;
    const std::vector<CpfgCurve>& curves_;
    Variables variables_;
    Variables globals_;
    Variables state_;                             // values of changing globals in this production
    std::map<std::string, ForeignId> increments_; // per global: amount that each step adds
    std::set<std::string> assigned_each_step_; // globals that each step assigns before reading them
    std::map<std::string, Array> arrays_;
    std::map<std::string, DataFile> files_; // by the variable
    /// Names of functions in .lsys, by index in curves_; only of curves that expressions call.
    std::map<std::size_t, CpfgCurveNames> curve_names_;
    std::map<std::size_t, std::vector<double>> tables_; // by index in curves_
    std::set<std::string> function_names_;
    std::set<std::string> formals_;
    std::set<std::string> changed_globals_; // globals that blocks of a step assign
    std::set<Stage> reported_stages_;       // stages whose step statements have been reported
    std::set<std::string> warned_;
    KnownValues known_values_;
    int loops_ = 0;                   // loops that are being unrolled, one in another
    std::size_t loop_statements_ = 0; // statements of loops run so far
    std::uint32_t draws_ = 0;
    std::size_t end_of_constants_ = 0;
    Stage stage_ = Stage::Rewrite;
    bool binds_draws_ = false;
    bool in_header_ = false;
    bool in_axiom_ = false;
    bool in_step_ = false; // whether the current block runs in each step
    bool has_integer_part_ = false;
    bool has_normal_ = false;
    bool quiet_ = false;
};

/// `text` as a name of .lsys, or `fallback`.
[[nodiscard]] std::string cpfg_name_of(std::string_view text, std::string_view fallback);
[[nodiscard]] bool is_cpfg_number(std::string_view text);
/// Whether a number is 0. Precondition: is_cpfg_number(text).
[[nodiscard]] bool is_cpfg_zero(std::string_view text);

} // namespace lsys
