#include "grammar/ast/reports.h"
#include "grammar/dialects/cpfg/expressions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

/// Procedures without effect on the word.
constexpr std::array<std::string_view, 10> kProcedures{
    "printf", "fprintf", "fopen", "fclose", "fflush", "stop", "play", "Display", "srand", "fputs"};

} // namespace

void CpfgExpressions::find_changed_globals(const std::vector<int>& statements) {
    for (const int index : statements) {
        const CpfgStatement& statement = statement_at(index);
        if (statement.kind == CpfgStatementKind::Assign) {
            changed_globals_.insert(node_at(statement.target).text);
        }
        find_changed_globals(statement.block);
        find_changed_globals(statement.otherwise);
    }
}

void CpfgExpressions::read_header() {
    in_header_ = true;
    for (const int index : session_.definitions) {
        define_array(statement_at(index));
    }
    run(session_.start);
    globals_ = std::exchange(variables_, {});
    read_each_step();
    for (const int index : session_.end) {
        warn_left_out(statement_at(index).span, "End",
                      "`End:` is left out: it cannot change the word");
    }
    in_header_ = false;
}

/// Classifies the variables that blocks of a step assign: incremented by each step, assigned anew
/// by each step, or unknown.
void CpfgExpressions::read_each_step() {
    find_changed_globals(session_.start_each);
    find_changed_globals(session_.end_each);
    for (const std::string& variable : changed_globals_) {
        const int added = step_of(variable);
        if (added >= 0) {
            increments_[variable] = added;
        } else if (is_assigned_first(session_.start_each, variable).value_or(false)) {
            reset_.insert(variable);
        }
    }
    std::set<std::string> unknown; // includes the variables that depend on an unknown one
    for (std::size_t before = changed_globals_.size() + 1; before != unknown.size();) {
        before = unknown.size();
        for (const std::string& variable : changed_globals_) {
            const bool known = increments_.count(variable) != 0 || reset_.count(variable) != 0;
            if (!known || depends(session_.start_each, variable, unknown) ||
                depends(session_.end_each, variable, unknown)) {
                reset_.erase(variable);
                unknown.insert(variable);
            }
        }
    }
    for (const std::vector<int>* block : {&session_.start_each, &session_.end_each}) {
        for (const int index : *block) {
            if (statement_at(index).kind == CpfgStatementKind::Call) {
                call_statement(statement_at(index));
            }
        }
    }
}

int CpfgExpressions::assignments(const std::vector<int>& statements, const std::string& to) const {
    int count = 0;
    for (const int index : statements) {
        const CpfgStatement& statement = statement_at(index);
        count += statement.kind == CpfgStatementKind::Assign && node_at(statement.target).text == to
                     ? 1
                     : 0;
        count += assignments(statement.block, to) + assignments(statement.otherwise, to);
    }
    return count;
}

bool CpfgExpressions::uses(int expression, const std::set<std::string>& names) const {
    if (expression < 0) {
        return false;
    }
    const CpfgExpression& node = node_at(expression);
    return (node.kind == CpfgKind::Name && names.count(node.text) != 0) ||
           (node.kind == CpfgKind::Call && (node.text == "ran" || node.text == "nran")) ||
           std::any_of(node.parts.begin(), node.parts.end(),
                       [&](int part) { return uses(part, names); });
}

/// Returns true when a value assigned to `to` has a random number or one of the names in it.
bool CpfgExpressions::depends(const std::vector<int>& statements,
                              const std::string& to,
                              const std::set<std::string>& names) const {
    return std::any_of(statements.begin(), statements.end(), [&](int index) {
        const CpfgStatement& statement = statement_at(index);
        const bool assigns = assignments({index}, to) != 0;
        return assigns && (uses(statement.value, names) || depends(statement.block, to, names) ||
                           depends(statement.otherwise, to, names));
    });
}

/// The expression that each step adds to the variable, or -1. It exists if the only assignment to
/// the variable is `v = v + e;` outside of any `if`, and no step changes `e`.
int CpfgExpressions::step_of(const std::string& variable) const {
    if (assignments(session_.start_each, variable) + assignments(session_.end_each, variable) !=
        1) {
        return -1;
    }
    for (const std::vector<int>* block : {&session_.start_each, &session_.end_each}) {
        for (const int index : *block) {
            const CpfgStatement& statement = statement_at(index);
            if (statement.kind != CpfgStatementKind::Assign ||
                node_at(statement.target).text != variable) {
                continue;
            }
            const CpfgExpression& value = node_at(statement.value);
            const bool sum = value.kind == CpfgKind::Binary && value.text == "+" &&
                             node_at(value.parts[0]).kind == CpfgKind::Name &&
                             node_at(value.parts[0]).text == variable;
            return sum && !uses(value.parts[1], changed_globals_) ? value.parts[1] : -1;
        }
    }
    return -1;
}

/// Whether statements assign the variable before they read it; nullopt if they do neither.
std::optional<bool> CpfgExpressions::is_assigned_first(const std::vector<int>& statements,
                                                       const std::string& variable) const {
    for (const int index : statements) {
        const CpfgStatement& statement = statement_at(index);
        if (uses(statement.value, {variable})) {
            return false;
        }
        if (statement.kind == CpfgStatementKind::Assign &&
            node_at(statement.target).text == variable) {
            return true;
        }
        const std::optional<bool> yes = is_assigned_first(statement.block, variable);
        const std::optional<bool> no = is_assigned_first(statement.otherwise, variable);
        if (yes || no) {
            return yes.value_or(false) && no.value_or(false);
        }
    }
    return std::nullopt;
}

/// Finds the values of global variables in productions of the stage.
void CpfgExpressions::enter_step() {
    const auto [known, is_new] = states_.try_emplace(stage_);
    if (!is_new) {
        return;
    }
    const std::string done = stage_ == Stage::Rewrite ? "step()" : "(step() - 1)";
    in_header_ = true;
    in_step_ = true;
    variables_.clear();
    for (const auto& [variable, added] : increments_) {
        const auto start = globals_.find(variable);
        const std::string from = start == globals_.end() ? "0" : start->second.text;
        variables_[variable] = {in_cpfg_parentheses(from) + " + " +
                                    in_cpfg_parentheses(term(added).text) + " * " + done,
                                false, 0};
    }
    run(session_.start_each);
    if (stage_ == Stage::Interpret) {
        run(session_.end_each);
    }
    in_header_ = false;
    in_step_ = false;
    for (auto& [variable, value] : variables_) {
        if (increments_.count(variable) != 0 || reset_.count(variable) != 0) {
            const auto start = globals_.find(variable);
            const CpfgTerm first =
                start == globals_.end() ? CpfgTerm{"0", false, 0} : start->second;
            // the axiom is decomposed before any step
            known->second[variable] = stage_ == Stage::Decompose && first.text != value.text
                                          ? choose({"step() == 0", false, 0}, first, value, {})
                                          : value;
        }
    }
    variables_.clear();
}

CpfgExpressions CpfgExpressions::probe() const {
    CpfgExpressions copy = *this;
    copy.probes_ = true;
    return copy;
}

std::string CpfgExpressions::draw_name(int index) const {
    std::string name = "random" + std::to_string(index + 1);
    while (formals_.count(name) != 0) {
        name += "x";
    }
    return name;
}

void CpfgExpressions::begin(std::set<std::string> formals, Stage stage, CpfgDraws draws) {
    formals_.clear();
    stage_ = stage;
    draws_ = CpfgDraws::Inline;
    if (!changed_globals_.empty()) {
        enter_step();
    }
    formals_ = std::move(formals);
    variables_.clear();
    draws_ = draws;
    random_needs_ = {};
}

void CpfgExpressions::let(const std::string& name, const std::string& value) {
    variables_[name] = {value, false, 0};
}

void CpfgExpressions::run(const std::vector<int>& statements) {
    for (const int index : statements) {
        run(statement_at(index));
    }
}

void CpfgExpressions::run(const CpfgStatement& statement) {
    switch (statement.kind) {
    case CpfgStatementKind::Assign: {
        const CpfgExpression& target = node_at(statement.target);
        if (target.kind == CpfgKind::Index) {
            static_cast<void>(
                unsupported(statement.span,
                            "an element of an array that is changed while the word is derived"));
            return;
        }
        const bool global =
            globals_.count(target.text) != 0 || changed_globals_.count(target.text) != 0;
        if (!in_header_ && global && formals_.count(target.text) == 0) {
            static_cast<void>(
                unsupported(statement.span, "`" + shown(target.text) +
                                                "` belongs to the whole system and is changed by a "
                                                "production"));
            return;
        }
        CpfgTerm value = term(statement.value);
        if (value.text.size() > kMaxCpfgTerm) {
            value = unsupported(statement.span, "the value of `" + shown(target.text) +
                                                    "` is too long for one expression");
        }
        if (value.is_random && in_header_ &&
            !in_step_) { // drawn once, before the derivation begins
            constants_.push_back(
                {"start_" + std::to_string(constants_.size() + 1), value.text, statement.span});
            value = {constants_.back().name, false, 0};
        }
        value.uses = 0;
        variables_[target.text] = std::move(value);
        break;
    }
    case CpfgStatementKind::Call:
        call_statement(statement);
        break;
    case CpfgStatementKind::If:
        branch(statement);
        break;
    case CpfgStatementKind::Loop:
        static_cast<void>(unsupported(statement.span, "a loop"));
        break;
    case CpfgStatementKind::Array:
        define_array(statement);
        break;
    }
}

void CpfgExpressions::call_statement(const CpfgStatement& statement) {
    const CpfgExpression& called = node_at(statement.value);
    if (called.kind != CpfgKind::Call) {
        return; // an unused value
    }
    const bool known =
        std::find(kProcedures.begin(), kProcedures.end(), called.text) != kProcedures.end();
    if (called.text == "srand") {
        warn_left_out(called.span, "srand",
                      "`srand` is left out: random numbers are those of lsc, by its own seed");
    } else if (known) {
        warn_left_out(called.span, called.text,
                      "`" + shown(called.text) + "` is left out: it cannot change the word");
    } else {
        static_cast<void>(term(statement.value));
    }
}

void CpfgExpressions::branch(const CpfgStatement& statement) {
    const CpfgTerm test = term(statement.value);
    if (is_cpfg_number(test.text)) {
        run(is_cpfg_zero(test.text) ? statement.otherwise : statement.block);
        return;
    }
    const bool chance = test.is_random;
    if (chance) {
        static_cast<void>(
            chosen_by_chance(node_at(statement.value).span, "a random number in an `if`"));
    }
    const Variables before = variables_;
    run(statement.block);
    Variables yes = std::exchange(variables_, before);
    run(statement.otherwise);
    Variables no = std::exchange(variables_, before);
    const auto value_in = [&](const Variables& values, const std::string& name) {
        const auto found = values.find(name);
        if (found != values.end()) {
            return found->second;
        }
        return CpfgTerm{formals_.count(name) != 0 ? name : "0", false, 0};
    };
    std::set<std::string> names;
    for (const Variables* values : {&yes, &no}) {
        for (const auto& [name, value] : *values) {
            names.insert(name);
        }
    }
    for (const std::string& name : names) {
        const CpfgTerm a = value_in(yes, name);
        const CpfgTerm b = value_in(no, name);
        variables_[name] = a.text == b.text ? a
                           : chance         ? CpfgTerm{"0", true, 0}
                                            : choose(test, a, b, statement.span);
    }
}

void CpfgExpressions::define_array(const CpfgStatement& statement) {
    constexpr int kMaxElements = 256;
    const CpfgExpression& target = node_at(statement.target);
    Array array;
    int count = 1;
    for (const int part : target.parts) {
        const CpfgTerm size = term(part);
        int value = 0;
        std::from_chars(size.text.data(), size.text.data() + size.text.size(), value);
        if (!is_cpfg_number(size.text) || value <= 0 || value > kMaxElements / count) {
            static_cast<void>(
                unsupported(target.span, "an array whose size is no number from 1 to 256"));
            return;
        }
        array.sizes.push_back(value);
        count *= value;
    }
    for (const int value : statement.block) {
        const CpfgTerm made = term(value);
        if (made.is_random) {
            static_cast<void>(unsupported(statement.span, "random numbers in an array"));
            return;
        }
        array.values.push_back(made.text);
    }
    array.values.resize(static_cast<std::size_t>(count), "0");
    arrays_[target.text] = std::move(array);
}

} // namespace lsys
