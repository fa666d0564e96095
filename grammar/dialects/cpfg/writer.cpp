#include "grammar/dialects/cpfg/writer.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

/// Maximum random numbers of one choice, since each production of the module has all of them as
/// parameters.
constexpr int kMaxDraws = 1000;

} // namespace

CpfgWriter::CpfgWriter(CpfgSession& session, Translation& out)
    : session_(session), context_(session.context), out_(out), header_{out.file(), 0, 1},
      expressions_(session, view_.curves) {}

void CpfgWriter::write(std::string_view turtle) {
    find_names();
    read_view_file();
    expressions_.read_header();
    find_bindings();
    expressions_.begin({}, Stage::Rewrite);
    write_settings(turtle);
    out_.put("\n#w : ", *session_.axiom_span);
    write_modules(session_.axiom);
    out_.put(";\n\n", header_);
    for (std::size_t i = 0; i < session_.productions.size(); ++i) {
        write_production(i);
    }
}

bool CpfgWriter::is_always(const CpfgProduction& production) const {
    if (production.condition < 0) {
        return true;
    }
    const CpfgExpression& test = expression(production.condition);
    return test.kind == CpfgKind::Number && !is_cpfg_zero(test.text);
}

/// Returns true if the production is chosen at random among others.
bool CpfgWriter::is_random_choice(const CpfgProduction& production) const {
    return session_.seed >= 0 && production.stage == Stage::Rewrite &&
           !production.predecessor.empty() && alternatives_.at(key_of(production)) > 1;
}

/// Finds the productions whose random numbers must be bound.
void CpfgWriter::find_bindings() {
    bindings_.resize(session_.productions.size());
    std::map<std::pair<Stage, std::string>, std::vector<std::size_t>> by_module;
    std::set<std::pair<Stage, std::string>> grouped;
    for (std::size_t i = 0; i < session_.productions.size(); ++i) {
        const CpfgProduction& production = session_.productions[i];
        if (production.predecessor.empty()) {
            continue;
        }
        const std::vector<std::string> names = formals_of(production);
        CpfgExpressions probe = expressions_.probe();
        probe.begin({names.begin(), names.end()}, production.stage);
        probe.run(production.before);
        const bool drawn_test =
            production.condition >= 0 && probe.term(production.condition).is_random;
        bool weighted = false;
        if (is_random_choice(production) && production.weight >= 0) {
            const std::string text = probe.term(production.weight).text;
            weighted = !is_cpfg_number(text);
        }
        probe.run(production.after);
        for (const CpfgModule& module : production.successor) {
            for (const int argument : module.arguments) {
                static_cast<void>(probe.term(argument));
            }
        }
        const std::pair<Stage, std::string> module{production.stage, key_of(production)};
        by_module[module].push_back(i);
        bindings_[i] = {probe.random_needs().bound_draws ? Binding::Own : Binding::None, 0,
                        probe.random_needs().draws};
        if (drawn_test || weighted) {
            grouped.insert(module);
        }
    }
    for (const auto& module : grouped) {
        bind_group(by_module[module]);
    }
    for (std::size_t i = 0; i < bindings_.size(); ++i) {
        const CpfgProduction& production = session_.productions[i];
        if (bindings_[i].binding != Binding::None && bound_.insert(production.stage).second &&
            production.stage != Stage::Rewrite) {
            expressions_.warn_left_out(production.span, "passes",
                                       "random numbers that are used more than once take a pass of "
                                       "their own: `maximum depth` counts twice");
        }
    }
}

void CpfgWriter::bind_group(const std::vector<std::size_t>& members) {
    int draws = 0;
    for (const std::size_t i : members) {
        const CpfgProduction& production = session_.productions[i];
        if (!production.left.empty() || !production.right.empty() ||
            production.predecessor.size() != 1) {
            session_.report_unsupported(production.span,
                                        "a choice by a random number, or by weights that depend on "
                                        "parameters, among productions with contexts or of several "
                                        "modules");
            return;
        }
        draws += bindings_[i].draws;
        if (draws > kMaxDraws) {
            session_.report_unsupported(production.span,
                                        "more than 1000 random numbers, here and before, that the "
                                        "choice among the productions of one module needs");
            return;
        }
    }
    draws += is_random_choice(session_.productions[members.front()]) ? 1 : 0;
    int first = 0;
    for (const std::size_t i : members) {
        const int own = bindings_[i].draws;
        bindings_[i] = {Binding::Group, first, draws};
        first += own;
    }
    groups_[members.front()] = members;
}

std::vector<std::string> CpfgWriter::formals_of(const CpfgProduction& production) const {
    std::vector<std::string> names;
    for (const auto* list : {&production.left, &production.predecessor, &production.right}) {
        for (const CpfgModule& module : *list) {
            for (const int argument : module.arguments) {
                names.push_back(expression(argument).text);
            }
        }
    }
    return names;
}

void CpfgWriter::write_name(const CpfgModule& module) {
    const std::string name = spelled(module.name, module.has_arguments);
    out_.put(name, module.span);
    if (name[0] != '`' && name != module.name && used_.count(name) == 0) {
        out_.replace_name(name, module.name);
    }
}

void CpfgWriter::write_modules(const std::vector<CpfgModule>& list) {
    for (const CpfgModule& module : list) {
        const bool polygon = module.name == "{" || module.name == "}";
        write_name(module);
        if (!module.has_arguments || polygon) {
            continue;
        }
        for (std::size_t i = 0; i < module.arguments.size(); ++i) {
            const SourceSpan span = expression(module.arguments[i]).span;
            out_.put(i == 0 ? "(" : ", ", span);
            out_.put(expressions_.term(module.arguments[i]).text, span);
        }
        out_.put(")", module.span);
    }
}

/// Writes a predecessor or context, whose parameters are names.
void CpfgWriter::write_pattern(const std::vector<CpfgModule>& list) {
    for (const CpfgModule& module : list) {
        const CpfgModule* const next = &module == &list.back() ? nullptr : &module + 1;
        if (module.name == "=" && next != nullptr && next->name == "]") {
            continue; // the rest of the branch does not matter, as in .lsys
        }
        write_name(module);
        for (std::size_t i = 0; i < module.arguments.size(); ++i) {
            const CpfgExpression& formal = expression(module.arguments[i]);
            if (formal.kind != CpfgKind::Name) {
                context_.diagnostics.add(DiagnosticCode::ForeignSyntax, formal.span,
                                         "a parameter is a name here");
            }
            out_.put(i == 0 ? "(" : ", ", formal.span);
            out_.put(formal.text, formal.span);
        }
        if (module.has_arguments) {
            out_.put(")", module.span);
        }
    }
}

/// Reports productions that .lsys does not have; returns false for those.
bool CpfgWriter::check(const CpfgProduction& production) {
    if (production.predecessor.empty()) {
        session_.report_unsupported(production.span, "a production without a module");
        return false;
    }
    if (production.predecessor.size() != 1 && production.stage != Stage::Rewrite) {
        session_.report_unsupported(production.span,
                                    "a decomposition or a homomorphism of several modules as one");
        return false;
    }
    const bool contexts = !production.left.empty() || !production.right.empty();
    if (contexts && production.stage == Stage::Decompose) {
        session_.report_unsupported(production.span, "contexts in a decomposition");
        return false;
    }
    if (contexts && production.stage == Stage::Interpret) {
        expressions_.warn_left_out(production.span, "context",
                                   "contexts in a homomorphism are left out, as cpfg does");
    }
    return true;
}

/// `#p1 : left < module > right : `
void CpfgWriter::write_head(const CpfgProduction& production, const std::string& label) {
    const bool rewrites = production.stage == Stage::Rewrite;
    out_.put(label + " : ", production.span);
    if (!production.left.empty() && rewrites) {
        write_pattern(production.left);
        out_.put(" < ", production.span);
    }
    write_pattern(production.predecessor);
    if (!production.right.empty() && rewrites) {
        out_.put(" > ", production.span);
        write_pattern(production.right);
    }
    out_.put(" : ", production.span);
}

namespace {

std::string label_of(Stage stage, std::size_t index) {
    const std::string number = std::to_string(index + 1);
    return stage == Stage::Rewrite     ? "#p" + number
           : stage == Stage::Decompose ? "#decompose d" + number
                                       : "#interpret i" + number;
}

/// Label of the production that replaces a module of random numbers.
std::string bound_label(Stage stage, const std::string& name) {
    return (stage == Stage::Interpret ? "#interpret " : "#decompose ") + name;
}
Stage bound_stage(Stage stage) {
    return stage == Stage::Rewrite ? Stage::Decompose : stage;
}

} // namespace

std::string CpfgWriter::drawing_module(std::size_t index) const {
    return "`random" + std::to_string(index + 1) + "`";
}

void CpfgWriter::write_formals(const std::vector<std::string>& names, int count, SourceSpan span) {
    std::string text;
    for (const std::string& name : names) {
        text += (text.empty() ? "(" : ", ") + name;
    }
    for (int i = 0; i < count; ++i) {
        text += (text.empty() ? "(" : ", ") + expressions_.draw_name(i);
    }
    out_.put(text.empty() ? text : text + ")", span);
}

void CpfgWriter::write_draws(const std::vector<std::string>& names, int count, SourceSpan span) {
    std::string text;
    for (const std::string& name : names) {
        text += (text.empty() ? "(" : ", ") + name;
    }
    for (int i = 0; i < count; ++i) {
        text += text.empty() ? "({0, 1}" : ", {0, 1}";
    }
    out_.put(text.empty() ? text : text + ")", span);
}

void CpfgWriter::write_production(std::size_t index) {
    const CpfgProduction& production = session_.productions[index];
    const BoundDraws& bound = bindings_[index];
    if (!check(production)) {
        return;
    }
    if (bound.binding == Binding::Group) {
        if (groups_.count(index) != 0) {
            write_group(index);
        }
        return;
    }
    const std::vector<std::string> names = formals_of(production);
    write_head(production, label_of(production.stage, index));
    const bool own = bound.binding == Binding::Own;
    expressions_.begin({names.begin(), names.end()}, production.stage,
                       own ? CpfgDraws::Elsewhere : CpfgDraws::Inline);
    expressions_.run(production.before);
    write_condition(production);
    write_weight(production);
    if (own) {
        write_bound_production(index);
        return;
    }
    expressions_.run(production.after);
    out_.put(" : ", production.arrow);
    write_modules(production.successor);
    out_.put(";\n", production.arrow);
}

void CpfgWriter::begin_bound(const CpfgProduction& production, int first_draw) {
    const std::vector<std::string> names = formals_of(production);
    expressions_.begin({names.begin(), names.end()}, bound_stage(production.stage),
                       CpfgDraws::Bound);
    expressions_.draw_from(first_draw);
}

/// The formals that the successor reads.
std::vector<std::string> CpfgWriter::read_formals(const CpfgProduction& production) {
    begin_bound(production, 0);
    expressions_.run(production.before);
    expressions_.run(production.after);
    std::string text;
    for (const CpfgModule& module : production.successor) {
        for (const int argument : module.arguments) {
            text += " " + expressions_.term(argument).text;
        }
    }
    std::set<std::string> read;
    const auto is_part = [&](std::size_t at) {
        return std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_';
    };
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t begin = at;
        while (at < text.size() && is_part(at)) {
            ++at;
        }
        read.insert(text.substr(begin, at - begin));
        at += at == begin ? 1 : 0;
    }
    std::vector<std::string> names = formals_of(production);
    std::erase_if(names, [&](const std::string& name) { return read.count(name) == 0; });
    return names;
}

/// Draws the random numbers of a production that matches, and writes its successor with them.
void CpfgWriter::write_bound_production(std::size_t index) {
    const CpfgProduction& production = session_.productions[index];
    const int count = bindings_[index].draws;
    const std::vector<std::string> names = read_formals(production);
    out_.put(" : " + drawing_module(index), production.arrow);
    write_draws(names, count, production.arrow);
    out_.put(";\n" + bound_label(production.stage, "b" + std::to_string(index + 1)) + " : " +
                 drawing_module(index),
             production.arrow);
    begin_bound(production, 0);
    write_formals(names, count, production.arrow);
    out_.put(" : * : ", production.arrow);
    expressions_.run(production.before);
    expressions_.run(production.after);
    write_modules(production.successor);
    out_.put(";\n", production.arrow);
}

/// Writes the productions of a module that is rewritten by a random choice: the first draws the
/// random numbers, on which the others depend.
void CpfgWriter::write_group(std::size_t index) {
    const std::vector<std::size_t>& members = groups_.at(index);
    const CpfgProduction& first = session_.productions[index];
    const int count = bindings_[index].draws;
    const std::vector<std::string> names = formals_of(first);
    write_head(first, label_of(first.stage, index));
    out_.put("* : " + drawing_module(index), first.arrow);
    write_draws(names, count, first.arrow);
    out_.put(";\n", first.arrow);
    bool always = false;
    for (const std::size_t member : members) {
        const CpfgProduction& production = session_.productions[member];
        const std::vector<std::string> own = formals_of(production);
        out_.put(bound_label(production.stage, "b" + std::to_string(member + 1)) + " : " +
                     drawing_module(index),
                 production.span);
        begin_bound(production, bindings_[member].first_draw);
        write_formals(own, count, production.span);
        out_.put(" : ", production.span);
        if (is_random_choice(production)) {
            write_weighted_condition(production, index);
            begin_bound(production, bindings_[member].first_draw);
            expressions_.run(production.before);
        } else {
            expressions_.run(production.before);
            write_condition(production);
        }
        always = always || is_always(production);
        expressions_.run(production.after);
        out_.put(" : ", production.arrow);
        write_modules(production.successor);
        out_.put(";\n", production.arrow);
    }
    if (!always) { // if no production matches, the module stays
        out_.put(bound_label(first.stage, "k" + std::to_string(index + 1)) + " : " +
                     drawing_module(index),
                 first.span);
        begin_bound(first, 0);
        write_formals(names, count, first.span);
        out_.put(" : * : " + spelled(first.predecessor.front().name,
                                     first.predecessor.front().has_arguments),
                 first.span);
        write_draws(names, 0, first.span);
        out_.put(";\n", first.span);
    }
}

void CpfgWriter::write_condition(const CpfgProduction& production) {
    if (production.condition < 0) {
        out_.put("*", production.span);
        return;
    }
    const SourceSpan span = expression(production.condition).span;
    const CpfgTerm test = expressions_.term(production.condition);
    const bool number = is_cpfg_number(test.text);
    const bool always = number && !is_cpfg_zero(test.text);
    out_.put(always ? "*" : test.text, span);
}

void CpfgWriter::write_weight(const CpfgProduction& production) {
    if (production.weight >= 0 && session_.seed < 0) {
        expressions_.warn_left_out(
            expression(production.weight).span, "weight",
            "without `seed:` the first production that matches is taken: this is left out");
    }
    if (!is_random_choice(production)) {
        return;
    }
    if (!production.left.empty() || !production.right.empty()) {
        expressions_.warn_left_out(production.span, "choice " + key_of(production),
                                   "the choice is among productions with the same contexts; cpfg "
                                   "chooses among all that match");
    }
    if (production.weight < 0) {
        out_.put(" ~ 1", production.span);
        return;
    }
    const SourceSpan span = expression(production.weight).span;
    out_.put(" ~ ", span);
    out_.put("(" + expressions_.term(production.weight).text + ")", span);
}

/// Writes the condition of the choice: the last random number, times the sum of the weights of all
/// matching productions, lies in the interval of the weight of this one.
void CpfgWriter::write_weighted_condition(const CpfgProduction& production, std::size_t index) {
    const std::vector<std::string> own = formals_of(production);
    std::string until;
    std::string all;
    std::string test;
    bool last = false;
    for (const std::size_t member : groups_.at(index)) {
        const CpfgProduction& other = session_.productions[member];
        begin_bound(production, bindings_[member].first_draw);
        const std::vector<std::string> names = formals_of(other);
        for (std::size_t i = 0; i < names.size() && i < own.size(); ++i) {
            if (names[i] != own[i]) {
                expressions_.let(names[i], own[i]);
            }
        }
        expressions_.run(other.before);
        const std::string condition =
            is_always(other) ? "" : in_cpfg_parentheses(expressions_.term(other.condition).text);
        std::string part =
            other.weight < 0 ? "1" : in_cpfg_parentheses(expressions_.term(other.weight).text);
        part += condition.empty() ? "" : " * (" + condition + " != 0)";
        all += (all.empty() ? "" : " + ") + part;
        if (all.size() > kMaxCpfgTerm) { // the sum is part of the condition of each production
            session_.report_unsupported(
                session_.productions[groups_.at(index).front()].span,
                "so many productions for one module that the sum of their weights is "
                "too long for one expression");
            return;
        }
        if (until.empty() || !last) {
            until = all;
        }
        last = last || &other == &production;
        test = &other == &production ? condition : test;
    }
    const SourceSpan span =
        production.weight < 0 ? production.span : expression(production.weight).span;
    const std::string u = expressions_.draw_name(bindings_[index].draws - 1);
    const std::string chance =
        until == all ? "" : u + " * (" + all + ") < " + in_cpfg_parentheses(until);
    const std::string both =
        test.empty() || chance.empty() ? test + chance : test + " != 0 && " + chance;
    out_.put(both.empty() ? "*" : both, span);
}

} // namespace lsys
