// SPDX-License-Identifier: MIT
#include "grammar/ast/reports.h"
#include "grammar/dialects/cpfg/expressions.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

/// Procedures without effect on the word.
constexpr std::array<std::string_view, 10> kProcedures{
    "printf", "fprintf", "fopen", "fclose", "fflush", "stop", "play", "Display", "srand", "fputs"};

/// Names that arrays and functions of a file cannot have in .lsys.
constexpr std::array<std::string_view, 32> kFunctionNames{
    "sin", "cos", "tan",  "asin",   "acos",    "atan",     "atan2", "sqrt",
    "exp", "log", "pow",  "abs",    "floor",   "ceil",     "round", "sign",
    "min", "max", "mod",  "step",   "steps",   "if",       "clamp", "mix",
    "let", "int", "nran", "normal", "poisson", "binomial", "_",     "define"};

} // namespace

void CpfgExpressions::collect_changed_globals(const std::vector<int>& statements) {
    for (const int index : statements) {
        const CpfgStatement& statement = statement_at(index);
        if (statement.kind == CpfgStatementKind::Assign) {
            changed_globals_.insert(tree_[statement.target].text);
        }
        collect_changed_globals(statement.block);
        collect_changed_globals(statement.otherwise);
    }
}

void CpfgExpressions::read_header() {
    function_names_ = {kFunctionNames.begin(), kFunctionNames.end()};
    in_header_ = true;
    for (const int index : session_.definitions) {
        define_array(statement_at(index));
    }
    run(session_.start);
    globals_ = std::exchange(variables_, {});
    end_of_constants_ = tree_.locals().size();
    for (ForeignLocal& constant : tree_.locals()) {
        constant.is_constant = true;
        // A random constant is drawn once, before the derivation begins.
        constant.is_final = constant.is_final || tree_.has_draw(constant.value);
        constant.is_inline |= tree_.has(constant.value, [](const ForeignNode& node) {
            return node.kind == ForeignKind::Call && (node.text == "step" || node.text == "steps");
        }); // step() and steps() are allowed only in productions
    }
    classify_changed_globals();
    for (const int index : session_.end) {
        warn_left_out(statement_at(index).span, "End",
                      "`End:` is left out: it cannot change the word");
    }
    in_header_ = false;
}

void CpfgExpressions::classify_changed_globals() {
    collect_changed_globals(session_.start_each);
    collect_changed_globals(session_.end_each);
    for (const std::string& variable : changed_globals_) {
        const ForeignId added = increment_of(variable);
        if (added != kNoForeign) {
            increments_[variable] = added;
        } else if (is_assigned_first(session_.start_each, variable).value_or(false)) {
            assigned_each_step_.insert(variable);
        }
    }
    // Rename the constants of changing variables, whose own names are for local values.
    for (const auto& [variable, value] : globals_) {
        if (changed_globals_.count(variable) != 0 && tree_[value].kind == ForeignKind::Local) {
            tree_.locals()[tree_[value].index].name = "start_" + variable;
        }
    }
    std::set<std::string> unknown; // includes the variables that depend on an unknown one
    for (std::size_t before = changed_globals_.size() + 1; before != unknown.size();) {
        before = unknown.size();
        for (const std::string& variable : changed_globals_) {
            const bool known =
                increments_.count(variable) != 0 || assigned_each_step_.count(variable) != 0;
            if (!known || depends(session_.start_each, variable, unknown) ||
                depends(session_.end_each, variable, unknown)) {
                assigned_each_step_.erase(variable);
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

int CpfgExpressions::count_assignments(const std::vector<int>& statements,
                                       const std::string& to) const {
    int count = 0;
    for (const int index : statements) {
        const CpfgStatement& statement = statement_at(index);
        count += statement.kind == CpfgStatementKind::Assign && tree_[statement.target].text == to
                     ? 1
                     : 0;
        count +=
            count_assignments(statement.block, to) + count_assignments(statement.otherwise, to);
    }
    return count;
}

bool CpfgExpressions::uses(ForeignId expression, const std::set<std::string>& names) const {
    if (expression == kNoForeign) {
        return false;
    }
    const ForeignNode& node = tree_[expression];
    return (node.kind == ForeignKind::Name && names.count(node.text) != 0) ||
           (node.kind == ForeignKind::Call && (node.text == "ran" || node.text == "nran")) ||
           std::any_of(node.parts.begin(), node.parts.end(),
                       [&](ForeignId part) { return uses(part, names); });
}

bool CpfgExpressions::depends(const std::vector<int>& statements,
                              const std::string& to,
                              const std::set<std::string>& names) const {
    return std::any_of(statements.begin(), statements.end(), [&](int index) {
        const CpfgStatement& statement = statement_at(index);
        const bool assigns = count_assignments({index}, to) != 0;
        return assigns && (uses(statement.value, names) || depends(statement.block, to, names) ||
                           depends(statement.otherwise, to, names));
    });
}

ForeignId CpfgExpressions::increment_of(const std::string& variable) const {
    if (count_assignments(session_.start_each, variable) +
            count_assignments(session_.end_each, variable) !=
        1) {
        return kNoForeign;
    }
    for (const std::vector<int>* block : {&session_.start_each, &session_.end_each}) {
        for (const int index : *block) {
            const CpfgStatement& statement = statement_at(index);
            if (statement.kind != CpfgStatementKind::Assign ||
                tree_[statement.target].text != variable) {
                continue;
            }
            const ForeignNode& value = tree_[statement.value];
            const bool sum = value.kind == ForeignKind::Binary && value.text == "+" &&
                             tree_[value.parts[0]].kind == ForeignKind::Name &&
                             tree_[value.parts[0]].text == variable;
            return sum && !uses(value.parts[1], changed_globals_) ? value.parts[1] : kNoForeign;
        }
    }
    return kNoForeign;
}

std::optional<bool> CpfgExpressions::is_assigned_first(const std::vector<int>& statements,
                                                       const std::string& variable) const {
    for (const int index : statements) {
        const CpfgStatement& statement = statement_at(index);
        if (uses(statement.value, {variable})) {
            return false;
        }
        if (statement.kind == CpfgStatementKind::Assign &&
            tree_[statement.target].text == variable) {
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

void CpfgExpressions::enter_step() {
    const bool was_quiet = std::exchange(quiet_, quiet_ || !reported_stages_.insert(stage_).second);
    in_header_ = true;
    in_step_ = true;
    for (const auto& [variable, added] : increments_) {
        const SourceSpan span = tree_[added].span;
        const ForeignId first = first_value(variable, span);
        const std::string start = known_literal(first); // makes `first` inline
        ForeignId finished_steps = tree_.call("step", {}, span);
        if (stage_ != Stage::Rewrite) {
            finished_steps = tree_.binary("-", finished_steps, tree_.number("1", span), span);
        }
        const ForeignId each = term(added);
        const bool by_one = tree_.literal(each) == "1";
        const ForeignId all =
            by_one ? finished_steps : tree_.binary("*", each, finished_steps, span);
        const bool from_zero = by_one && is_cpfg_number(start) && is_cpfg_zero(start);
        assign(variable, from_zero ? all : tree_.binary("+", first, all, span), span);
    }
    run(session_.start_each);
    if (stage_ == Stage::Interpret) {
        run(session_.end_each);
    }
    in_header_ = false;
    in_step_ = false;
    quiet_ = was_quiet;
    for (const auto& [variable, value] : std::exchange(variables_, {})) {
        if (increments_.count(variable) == 0 && assigned_each_step_.count(variable) == 0) {
            continue;
        }
        if (stage_ == Stage::Decompose) { // the axiom is decomposed before any step
            const SourceSpan span = tree_[value].span;
            static_cast<void>(known_literal(first_value(variable, span)));
            const ForeignId begins =
                tree_.binary("==", tree_.call("step", {}, span), tree_.number("0", span), span);
            variables_[variable] = value;
            assign(variable,
                   tree_.call("if", {begins, first_value(variable, span), read(value, span)}, span),
                   span);
            state_[variable] = variables_[variable];
        } else {
            state_[variable] = value;
        }
    }
    variables_.clear();
}

void CpfgExpressions::begin_axiom() {
    formals_.clear();
    variables_.clear();
    state_.clear();
    stage_ = Stage::Rewrite;
    in_axiom_ = true;
    binds_draws_ = false;
}

void CpfgExpressions::begin(std::set<std::string> formals, Stage stage) {
    begin_axiom();
    in_axiom_ = false;
    stage_ = stage;
    if (!changed_globals_.empty()) {
        enter_step();
    }
    formals_ = std::move(formals);
    draws_ = 0;
}

void CpfgExpressions::bind_draws(std::uint32_t first) {
    binds_draws_ = true;
    draws_ = first;
}

void CpfgExpressions::assign(const std::string& variable, ForeignId value, SourceSpan span) {
    const ForeignKind kind = tree_[value].kind;
    const auto before = variables_.find(variable);
    if (before != variables_.end() && tree_[before->second].kind == ForeignKind::Local) {
        ForeignLocal& old = tree_.locals()[tree_[before->second].index];
        old.is_final = old.is_final && old.name != variable;
    }
    const bool has_name = kind == ForeignKind::Name || kind == ForeignKind::Local;
    variables_[variable] =
        has_name ? value
                 : tree_.local({.name = variable, .value = value, .span = span, .is_final = true});
}

void CpfgExpressions::run(const std::vector<int>& statements) {
    for (const int index : statements) {
        run(statement_at(index));
    }
}

void CpfgExpressions::run(const CpfgStatement& statement) {
    loop_statements_ += loops_ != 0 ? 1 : 0;
    switch (statement.kind) {
    case CpfgStatementKind::Assign: {
        const ForeignNode target = tree_[statement.target];
        if (target.kind == ForeignKind::Index) {
            assign_element(statement);
            return;
        }
        if (open_file(statement)) {
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
        assign(target.text, folded(term(statement.value)), statement.span);
        break;
    }
    case CpfgStatementKind::Call:
        call_statement(statement);
        break;
    case CpfgStatementKind::If:
        branch(statement);
        break;
    case CpfgStatementKind::Loop:
        loop(statement);
        break;
    case CpfgStatementKind::Array:
        define_array(statement);
        break;
    }
}

void CpfgExpressions::call_statement(const CpfgStatement& statement) {
    const ForeignNode called = tree_[statement.value];
    if (called.kind != ForeignKind::Call) {
        return; // an expression without effect
    }
    const bool known =
        std::find(kProcedures.begin(), kProcedures.end(), called.text) != kProcedures.end();
    const bool is_read = !called.parts.empty() && files_.count(tree_[called.parts[0]].text) != 0;
    if (called.text == "fclose" && is_read) {
        return; // needs no equivalent in .lsys
    }
    if (called.text == "fscanf") {
        read_numbers(called);
    } else if (called.text == "srand") {
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
    const SourceSpan span = tree_[statement.value].span;
    ForeignId test = term(statement.value);
    if (const std::string known = known_literal(folded(test)); !known.empty()) {
        run(is_cpfg_zero(known) ? statement.otherwise : statement.block);
        return;
    }
    if (!tree_[test].parts.empty()) { // store a test that may decide several variables
        test = tree_.local({.name = "test", .value = test, .span = span});
    }
    const Variables before = variables_;
    run(statement.block);
    const Variables yes = std::exchange(variables_, before);
    run(statement.otherwise);
    const Variables no = std::exchange(variables_, before);
    const auto value_in = [&](const Variables& values, const std::string& name) {
        const auto found = values.find(name);
        if (found != values.end()) {
            return read(found->second, span);
        }
        return formals_.count(name) != 0 ? tree_.name(name, span) : tree_.number("0", span);
    };
    std::set<std::string> names;
    for (const Variables* values : {&yes, &no}) {
        for (const auto& [name, value] : *values) {
            names.insert(name);
        }
    }
    for (const std::string& name : names) {
        const auto in_yes = yes.find(name);
        const auto in_no = no.find(name);
        if (in_yes != yes.end() && in_no != no.end() && in_yes->second == in_no->second) {
            continue; // neither block assigns it
        }
        const ForeignId a = value_in(yes, name);
        const ForeignId b = value_in(no, name);
        for (const ForeignId value : {a, b}) { // the result of the `if` takes over their name
            if (tree_[value].kind == ForeignKind::Local) {
                ForeignLocal& old = tree_.locals()[tree_[value].index];
                old.is_final = old.is_final && old.name != name;
            }
        }
        assign(name, tree_.call("if", {read(test, span), a, b}, span), span);
    }
}

} // namespace lsys
