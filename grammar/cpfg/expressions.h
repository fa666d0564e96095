// Expressions and statements of cpfg as expressions of .lsys: variables that statements assign are
// replaced by what they stand for.
#pragma once

#include "grammar/cpfg/session.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace lsys {

/// An expression of .lsys.
struct CpfgTerm {
    std::string text;
    bool drawn = false; // has a random range
    int uses = 0;
};

class CpfgExpressions {
public:
    explicit CpfgExpressions(CpfgSession& session) : session_(session) {}

    /// Reads what `define:`, `Start:` and the other blocks of the header say.
    void read_header();
    /// Begins a production: its formals, and no variable.
    void begin(std::set<std::string> formals, Stage stage);
    void run(const std::vector<int>& statements);
    [[nodiscard]] CpfgTerm term(int expression);

    /// Reports once for each `what` that lsc leaves it out.
    void leave_out(SourceSpan span, const std::string& what, const std::string& message);

private:
    using Variables = std::map<std::string, CpfgTerm>;
    struct Array {
        std::vector<int> sizes;
        std::vector<std::string> values;
    };

    [[nodiscard]] CpfgTerm name(const CpfgExpression& node);
    [[nodiscard]] CpfgTerm call(const CpfgExpression& node);
    [[nodiscard]] CpfgTerm element(const CpfgExpression& node);
    [[nodiscard]] CpfgTerm binary(const CpfgExpression& node);
    [[nodiscard]] CpfgTerm
    choose(const CpfgTerm& test, const CpfgTerm& yes, const CpfgTerm& no, SourceSpan span);
    void run(const CpfgStatement& statement);
    void branch(const CpfgStatement& statement);
    void call_statement(const CpfgStatement& statement);
    void define_array(const CpfgStatement& statement);
    void find_changed(const std::vector<int>& statements);
    [[nodiscard]] const CpfgExpression& node(int index) const {
        return session_.expressions[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] const CpfgStatement& statement(int index) const {
        return session_.statements[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] CpfgTerm unable(SourceSpan span, const std::string& message) const {
        session_.unable(span, message);
        return {"0", false, 0};
    }

    CpfgSession& session_;
    Variables variables_;
    Variables globals_;
    std::map<std::string, Array> arrays_;
    std::set<std::string> formals_;
    std::set<std::string> changed_; // globals that blocks of a step assign
    std::set<std::string> left_out_;
    Stage stage_ = Stage::Rewrite;
    bool in_header_ = false;
};

} // namespace lsys
