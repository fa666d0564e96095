// Expressions and statements of cpfg as expressions of .lsys: variables that statements assign are
// replaced by their values. Global variables are replaced too if each step adds the same amount to
// them or assigns them before reading them.
#pragma once

#include "grammar/dialects/cpfg/curves.h"
#include "grammar/dialects/cpfg/session.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lsys {

/// An expression of .lsys.
struct CpfgTerm {
    std::string text;
    bool is_random = false; // has a random range
    int uses = 0;
};

struct CpfgConstant {
    std::string name;
    std::string value;
    SourceSpan span;
};

/// Place where random numbers of a production are drawn.
enum class CpfgDraws : std::uint8_t {
    Inline,    // in the expression that uses them
    Bound,     // in advance, as parameters of the module
    Elsewhere, // by another .lsys statement; the terms of this one do not depend on them
};

/// Random numbers that a production needs.
struct CpfgRandomNeeds {
    bool bound_draws = false; // a random number is used twice or decides a choice
    int draws = 0;            // count of bound random numbers
};

class CpfgExpressions {
public:
    CpfgExpressions(CpfgSession& session, const std::vector<CpfgCurve>& curves)
        : session_(session), curves_(curves) {}

    /// Runs `define:`, `Start:` and the other blocks of the header.
    void read_header();
    /// Begins a production with its formals and without variables. `stage`: of the .lsys statement
    /// to be written.
    void begin(std::set<std::string> formals, Stage stage, CpfgDraws draws = CpfgDraws::Inline);
    /// Sets the index of the next bound random number.
    void draw_from(int index) { random_needs_.draws = index; }
    /// Defines a variable of the production.
    void let(const std::string& name, const std::string& value);
    void run(const std::vector<int>& statements);
    [[nodiscard]] CpfgTerm term(int expression);
    /// Constants that are drawn when the derivation begins, with their values.
    [[nodiscard]] const std::vector<CpfgConstant>& constants() const { return constants_; }

    /// A copy that reports nothing, to find the random numbers that a production needs.
    [[nodiscard]] CpfgExpressions probe() const;
    [[nodiscard]] const CpfgRandomNeeds& random_needs() const { return random_needs_; }
    /// Name of the parameter that holds bound random number `index`.
    [[nodiscard]] std::string draw_name(int index) const;
    /// Notes that a decision depends on a random number, which must be bound; reports an error if
    /// random numbers are drawn inline. Returns the term 0, so that reading
    /// goes on.
    [[nodiscard]] CpfgTerm chosen_by_chance(SourceSpan span, const std::string& message);

    /// Warns once per `what` that lsc leaves it out.
    void warn_left_out(SourceSpan span, const std::string& what, const std::string& message);

private:
    using Variables = std::map<std::string, CpfgTerm>;
    struct Array {
        std::vector<int> sizes;
        std::vector<std::string> values;
    };

    [[nodiscard]] CpfgTerm name(const CpfgExpression& node);
    [[nodiscard]] CpfgTerm call(const CpfgExpression& node);
    [[nodiscard]] CpfgTerm curve(const CpfgExpression& node);
    [[nodiscard]] CpfgTerm element(const CpfgExpression& node);
    [[nodiscard]] CpfgTerm binary(const CpfgExpression& node);
    [[nodiscard]] CpfgTerm draw();
    [[nodiscard]] CpfgTerm
    choose(const CpfgTerm& test, const CpfgTerm& yes, const CpfgTerm& no, SourceSpan span);
    void run(const CpfgStatement& statement);
    void branch(const CpfgStatement& statement);
    void call_statement(const CpfgStatement& statement);
    void define_array(const CpfgStatement& statement);
    void find_changed_globals(const std::vector<int>& statements);
    void read_each_step();
    [[nodiscard]] int assignments(const std::vector<int>& statements, const std::string& to) const;
    /// Returns true when the expression has one of the names, or a random number.
    [[nodiscard]] bool uses(int expression, const std::set<std::string>& names) const;
    [[nodiscard]] bool depends(const std::vector<int>& statements,
                               const std::string& to,
                               const std::set<std::string>& names) const;
    [[nodiscard]] int step_of(const std::string& variable) const;
    [[nodiscard]] std::optional<bool> is_assigned_first(const std::vector<int>& statements,
                                                        const std::string& variable) const;
    void enter_step();
    [[nodiscard]] const CpfgExpression& node_at(int index) const {
        return session_.expressions[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] const CpfgStatement& statement_at(int index) const {
        return session_.statements[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] CpfgTerm unsupported(SourceSpan span, const std::string& message) const {
        if (!probes_) {
            session_.report_unsupported(span, message);
        }
        return {"0", false, 0};
    }

    CpfgSession& session_;
    const std::vector<CpfgCurve>& curves_;
    Variables variables_;
    Variables globals_;
    std::map<Stage, Variables> states_;     // values of changing globals in productions, by stage
    std::map<std::string, int> increments_; // by global: the expression that each step adds to it
    std::set<std::string> reset_;           // globals that each step assigns before reading them
    std::vector<CpfgConstant> constants_;
    std::map<std::string, Array> arrays_;
    std::set<std::string> formals_;
    std::set<std::string> changed_globals_; // globals that blocks of a step assign
    std::set<std::string> warned_;
    CpfgRandomNeeds random_needs_;
    Stage stage_ = Stage::Rewrite;
    bool in_header_ = false;
    bool in_step_ = false; // in a block that runs in each step
    CpfgDraws draws_ = CpfgDraws::Inline;
    bool probes_ = false;
};

[[nodiscard]] bool is_cpfg_number(std::string_view text);
/// Whether a number is 0. Precondition: is_cpfg_number(text).
[[nodiscard]] bool is_cpfg_zero(std::string_view text);
[[nodiscard]] std::string in_cpfg_parentheses(const std::string& text);
/// Maximum bytes of an expression, which grows as variables are replaced by their values.
inline constexpr std::size_t kMaxCpfgTerm = 20'000;

} // namespace lsys
