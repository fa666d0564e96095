// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/writer.h"

#include "grammar/ast/number.h"
#include "grammar/ast/reports.h"
#include "grammar/dialects/cpfg/clock_module.h"
#include "grammar/dialects/cpfg/commands.h"
#include "grammar/dialects/cpfg/module_sequences.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

/// Maximum random numbers of one choice, since each production of the module has all of them as
/// parameters.
constexpr std::uint32_t kMaxDraws = 1000;

/// Maximum nodes of a condition, in which variables are replaced by their values.
constexpr std::uint64_t kMaxCondition = 4'000;

/// Condition of a decomposition that does not rewrite the axiom, whose age is 0.
constexpr const char* kAfterAxiom = "step() > 0";

/// Label of the production that replaces a module of random numbers.
std::string bound_label(Stage stage, const std::string& name) {
    return (stage == Stage::Interpret ? "#interpret " : "#decompose ") + name;
}
/// Stage of the production that replaces a module of random numbers of `stage`.
Stage bound_stage(Stage stage) {
    return stage == Stage::Rewrite ? Stage::Decompose : stage;
}

} // namespace

CpfgWriter::CpfgWriter(CpfgSession& session, Translation& out)
    : session_(session), context_(session.context), out_(out), header_{out.file(), 0, 1},
      expressions_(session, view_.curves), tree_(session.expressions) {}

void CpfgWriter::write(std::string_view turtle) {
    add_productions_of_commands(session_);
    join_module_sequences(session_);
    move_statements_of_clock(session_);
    collect_names();
    read_view_file();
    expressions_.read_header();
    lower_header();
    lower_productions();
    find_groups();
    name_local_values();
    write_settings(turtle);
    out_.put("\n#w : ", *session_.axiom_span);
    write_modules(session_.axiom, axiom_, {});
    out_.put(";\n\n", header_);
    for (std::size_t i = 0; i < session_.productions.size(); ++i) {
        if (lowered_[i].in_group) {
            if (groups_.count(i) != 0) {
                write_group(i);
            }
        } else if (lowered_[i].is_written) {
            write_production(i);
        }
    }
}

bool CpfgWriter::is_always(ForeignId condition) const {
    if (condition == kNoForeign) {
        return true;
    }
    const std::string_view number = tree_.literal(condition);
    return !number.empty() && !is_cpfg_zero(number);
}

bool CpfgWriter::is_random_choice(const CpfgProduction& production) const {
    return session_.seed != kNoForeign && production.stage == Stage::Rewrite &&
           !production.predecessor.empty() && alternatives_.at(key_of(production)) > 1;
}

void CpfgWriter::lower_header() {
    expressions_.begin_axiom();
    for (const auto& [expression, setting] : {std::pair{session_.derivation_length, &length_},
                                              {session_.seed, &seed_},
                                              {session_.decompose_depth, &decompose_depth_},
                                              {session_.interpret_depth, &interpret_depth_}}) {
        if (expression == kNoForeign) {
            continue;
        }
        *setting = expressions_.term(expression);
        if (tree_.has_draw(*setting)) {
            session_.report_unsupported(this->expression(expression).span,
                                        "a random number in the header");
        }
    }
    axiom_ = terms_of(session_.axiom);
}

std::vector<std::vector<ForeignId>> CpfgWriter::terms_of(const std::vector<CpfgModule>& list) {
    std::vector<std::vector<ForeignId>> terms(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (const ForeignId argument : list[i].arguments) {
            terms[i].push_back(expressions_.term(argument));
        }
    }
    return terms;
}

void CpfgWriter::lower_productions() {
    lowered_.resize(session_.productions.size());
    for (std::size_t i = 0; i < lowered_.size(); ++i) {
        const CpfgProduction& production = session_.productions[i];
        if (!check_production(production)) {
            continue;
        }
        const std::vector<std::string> names = formals_of(production);
        lowered_[i].is_written = true;
        lowered_[i].first_local = tree_.locals().size();
        expressions_.begin({names.begin(), names.end()}, production.stage);
        lower(i);
        warn_weight(production);
    }
}

void CpfgWriter::lower(std::size_t index) {
    const CpfgProduction& production = session_.productions[index];
    Lowered& lowered = lowered_[index];
    expressions_.run(production.before);
    if (production.condition != kNoForeign) {
        lowered.condition = expressions_.term(production.condition);
        if (tree_.expanded_size(lowered.condition) > kMaxCondition) {
            session_.report_unsupported(
                expression(production.condition).span,
                "a condition that is too long once its variables are replaced");
        }
    }
    if (production.weight != kNoForeign && is_random_choice(production)) {
        lowered.weight = expressions_.term(production.weight);
    }
    expressions_.run(production.after);
    lowered.arguments = terms_of(production.successor);
    lowered.end_local = tree_.locals().size();
    lowered.draws = expressions_.draws();
}

void CpfgWriter::find_groups() {
    std::map<std::pair<Stage, std::string>, std::vector<std::size_t>> by_module;
    std::set<std::pair<Stage, std::string>> drawn;
    for (std::size_t i = 0; i < lowered_.size(); ++i) {
        const Lowered& lowered = lowered_[i];
        if (!lowered.is_written) {
            continue;
        }
        const CpfgProduction& production = session_.productions[i];
        const std::pair<Stage, std::string> module{production.stage, key_of(production)};
        by_module[module].push_back(i);
        for (const ForeignId id : {lowered.condition, lowered.weight}) {
            if (id != kNoForeign && tree_.has_draw(id)) {
                drawn.insert(module);
            }
        }
    }
    for (const auto& module : drawn) {
        const std::vector<std::size_t>& members = by_module[module];
        if (!can_bind(members)) {
            continue;
        }
        bind_group(members);
        const CpfgProduction& first = session_.productions[members.front()];
        if (bound_.insert(first.stage).second && first.stage != Stage::Rewrite) {
            expressions_.warn_left_out(first.span, "passes",
                                       "a random number in a condition takes a pass of its own: "
                                       "`maximum depth` counts twice");
        }
    }
}

bool CpfgWriter::can_bind(const std::vector<std::size_t>& members) {
    std::uint32_t draws = 0;
    for (const std::size_t i : members) {
        const CpfgProduction& production = session_.productions[i];
        if (!production.left.empty() || !production.right.empty() ||
            production.predecessor.size() != 1) {
            session_.report_unsupported(production.span,
                                        "a choice by a random number among productions with "
                                        "contexts or of several modules");
            return false;
        }
        draws += lowered_[i].draws;
        if (draws > kMaxDraws) {
            session_.report_unsupported(production.span,
                                        "the choice among the productions of one module, up to "
                                        "here, needs more than 1000 random numbers");
            return false;
        }
    }
    return true;
}

void CpfgWriter::bind_group(const std::vector<std::size_t>& members) {
    groups_[members.front()] = members;
    expressions_.set_quiet(true);
    std::uint32_t draws = 0;
    for (const std::size_t i : members) {
        const CpfgProduction& production = session_.productions[i];
        const std::vector<std::string> names = formals_of(production);
        lowered_[i].in_group = true;
        lowered_[i].first_draw = draws;
        lowered_[i].first_local = tree_.locals().size();
        expressions_.begin({names.begin(), names.end()}, bound_stage(production.stage));
        expressions_.bind_draws(draws);
        draws += lowered_[i].draws;
        lower(i);
    }
    const bool chooses = is_random_choice(session_.productions[members.front()]);
    for (const std::size_t i : members) {
        lowered_[i].draws = draws + (chooses ? 1 : 0);
    }
    if (chooses) {
        weigh_group(members);
    }
    expressions_.set_quiet(false);
}

void CpfgWriter::weigh_group(const std::vector<std::size_t>& members) {
    std::vector<ForeignId> conditions;
    for (const std::size_t i : members) {
        conditions.push_back(weighted_condition(members, i));
        if (conditions.back() != kNoForeign &&
            tree_.expanded_size(conditions.back()) > kMaxCondition) {
            session_.report_unsupported(
                session_.productions[members.front()].span,
                "one module has so many productions that the sum of their weights is "
                "too long for one expression");
            return;
        }
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
        lowered_[members[i]].condition = conditions[i];
    }
}

ForeignId CpfgWriter::weighted_condition(const std::vector<std::size_t>& members,
                                         std::size_t index) {
    const CpfgProduction& production = session_.productions[index];
    const SourceSpan span =
        production.weight == kNoForeign ? production.span : expression(production.weight).span;
    const std::vector<std::string> formals = formals_of(production);
    ForeignId all = kNoForeign;
    ForeignId until = kNoForeign;
    ForeignId test = kNoForeign;
    for (const std::size_t member : members) {
        const CpfgProduction& other = session_.productions[member];
        expressions_.begin({formals.begin(), formals.end()}, bound_stage(production.stage));
        expressions_.bind_draws(lowered_[member].first_draw);
        const std::vector<std::string> names = formals_of(other);
        for (std::size_t i = 0; i < names.size() && i < formals.size(); ++i) {
            if (names[i] != formals[i]) {
                expressions_.let(names[i], tree_.name(formals[i], span));
            }
        }
        expressions_.run(other.before);
        const ForeignId condition =
            other.condition == kNoForeign ? kNoForeign : expressions_.term(other.condition);
        ForeignId part =
            other.weight == kNoForeign ? tree_.number("1", span) : expressions_.term(other.weight);
        if (!is_always(condition)) {
            part = tree_.call("if", {condition, part, tree_.number("0", span)}, span);
        }
        all = all == kNoForeign ? part : tree_.binary("+", all, part, span);
        if (member == index) {
            until = all;
            test = condition;
        }
    }
    ForeignId chance = kNoForeign;
    if (index != members.back()) {
        const ForeignId drawn =
            tree_.binary("*", tree_.draw(lowered_[index].draws - 1, span), all, span);
        chance = tree_.binary("<", drawn, until, span);
    }
    if (is_always(test)) {
        return chance;
    }
    return chance == kNoForeign ? test : tree_.binary("&&", test, chance, span);
}

/// Decides which variables become local values and constants, and their names.
void CpfgWriter::name_local_values() {
    std::vector<ForeignId> roots{length_, seed_, decompose_depth_, interpret_depth_};
    std::vector<ForeignId> expanded;
    const auto add = [](std::vector<ForeignId>& to,
                        const std::vector<std::vector<ForeignId>>& arguments) {
        for (const std::vector<ForeignId>& list : arguments) {
            to.insert(to.end(), list.begin(), list.end());
        }
    };
    add(roots, axiom_);
    std::set<std::string> names;
    for (std::size_t i = 0; i < lowered_.size(); ++i) {
        if (lowered_[i].is_written) {
            add(roots, lowered_[i].arguments);
            expanded.push_back(lowered_[i].condition);
            expanded.push_back(lowered_[i].weight);
            for (const std::string& formal : formals_of(session_.productions[i])) {
                names.insert(formal);
            }
        }
    }
    std::erase(roots, kNoForeign);
    std::erase(expanded, kNoForeign);
    tree_.count_reads(roots, expanded, 0);
    tree_.name_locals(0, expressions_.end_of_constants(), names);
    std::set<std::string> constants;
    for (std::size_t i = 0; i < expressions_.end_of_constants(); ++i) {
        constants.insert(tree_.locals()[i].name);
    }
    for (std::size_t i = 0; i < lowered_.size(); ++i) {
        const Lowered& lowered = lowered_[i];
        if (!lowered.is_written) {
            continue;
        }
        const std::vector<std::string> formals = formals_of(session_.productions[i]);
        std::set<std::string> taken = constants;
        taken.insert(formals.begin(), formals.end());
        if (lowered.in_group) {
            const std::vector<std::string> draws = draw_names(formals, lowered.draws);
            taken.insert(draws.begin(), draws.end());
        }
        tree_.name_locals(lowered.first_local, lowered.end_local, taken);
    }
}

/// Appends the name of a parameter. For an expression, an error here, appends all names in it, so
/// that their uses give no further messages.
void CpfgWriter::append_names(ForeignId argument, std::vector<std::string>& names) const {
    std::vector<ForeignId> work{argument};
    while (!work.empty()) {
        const ForeignNode& node = expression(work.back());
        work.pop_back();
        if (node.kind == ForeignKind::Name || node.parts.empty()) {
            names.push_back(node.text);
        }
        work.insert(work.end(), node.parts.begin(), node.parts.end());
    }
}

std::vector<std::string> CpfgWriter::formals_of(const CpfgProduction& production) const {
    std::vector<std::string> names;
    for (const auto* list : {&production.left, &production.predecessor, &production.right}) {
        for (const CpfgModule& module : *list) {
            for (const ForeignId argument : module.arguments) {
                append_names(argument, names);
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

void CpfgWriter::write_modules(const std::vector<CpfgModule>& list,
                               const std::vector<std::vector<ForeignId>>& arguments,
                               const ForeignWriting& how) {
    for (std::size_t i = 0; i < list.size(); ++i) {
        const CpfgModule& module = list[i];
        const bool polygon = module.name == "{" || module.name == "}";
        write_name(module);
        if (!module.has_arguments || polygon) {
            continue;
        }
        for (std::size_t k = 0; k < arguments[i].size(); ++k) {
            out_.put(k == 0 ? "(" : ", ", expression(module.arguments[k]).span);
            tree_.write(arguments[i][k], how, out_);
        }
        out_.put(")", module.span);
    }
}

void CpfgWriter::write_pattern(const std::vector<CpfgModule>& list) {
    for (const CpfgModule& module : list) {
        const CpfgModule* const next = &module == &list.back() ? nullptr : &module + 1;
        if (module.name == "=" && next != nullptr && next->name == "]") {
            continue; // "the rest of the branch may be anything": always so in .lsys
        }
        write_name(module);
        for (std::size_t i = 0; i < module.arguments.size(); ++i) {
            const ForeignNode& formal = expression(module.arguments[i]);
            if (formal.kind != ForeignKind::Name) {
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

bool CpfgWriter::check_production(const CpfgProduction& production) {
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
    if (session_.ring && production.stage == Stage::Rewrite && production.predecessor.size() > 1) {
        session_.report_unsupported(*session_.ring, "predecessors of several modules in a ring "
                                                    "L-system, whose word has no ends");
        session_.ring.reset(); // report the ring once
        return false;
    }
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

} // namespace

std::string CpfgWriter::random_module(std::size_t index) const {
    return "`random" + std::to_string(index + 1) + "`";
}

void CpfgWriter::write_parameters(const std::vector<std::string>& names,
                                  const std::vector<std::string>& draws,
                                  SourceSpan span) {
    std::string text;
    for (const std::vector<std::string>* const list : {&names, &draws}) {
        for (const std::string& name : *list) {
            text += (text.empty() ? "(" : ", ") + name;
        }
    }
    out_.put(text.empty() ? text : text + ")", span);
}

std::vector<std::string> CpfgWriter::draw_names(const std::vector<std::string>& formals,
                                                std::uint32_t count) {
    std::set<std::string> taken(formals.begin(), formals.end());
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < count; ++i) {
        names.push_back(unique_name("random" + std::to_string(i + 1), taken));
    }
    return names;
}

void CpfgWriter::write_production(std::size_t index) {
    write_head(session_.productions[index], label_of(session_.productions[index].stage, index));
    write_condition(index, {.expands_locals = true});
    write_weight(index, {.expands_locals = true});
    write_successor(index, {});
}

/// Writes the local values, the successor and the end of a production.
void CpfgWriter::write_successor(std::size_t index, const ForeignWriting& how) {
    const CpfgProduction& production = session_.productions[index];
    const Lowered& lowered = lowered_[index];
    tree_.write_locals(" : ", lowered.first_local, lowered.end_local, how, out_);
    out_.put(" : ", production.arrow);
    write_modules(production.successor, lowered.arguments, how);
    out_.put(";\n", production.arrow);
}

/// Writes the productions of a module with random conditions or choices: the first production draws
/// the random numbers, and the others are chosen by these numbers.
void CpfgWriter::write_group(std::size_t index) {
    const std::vector<std::size_t>& members = groups_.at(index);
    const CpfgProduction& first = session_.productions[index];
    const std::uint32_t count = lowered_[index].draws;
    const std::vector<std::string> names = formals_of(first);
    write_head(first, label_of(first.stage, index));
    out_.put((may_decompose_axiom(first) ? std::string(kAfterAxiom) : "*") + " : " +
                 random_module(index),
             first.arrow);
    write_parameters(names, std::vector<std::string>(count, "{0, 1}"), first.arrow);
    out_.put(";\n", first.arrow);
    bool always = false;
    for (const std::size_t member : members) {
        const CpfgProduction& production = session_.productions[member];
        const std::vector<std::string> formals = formals_of(production);
        const std::vector<std::string> draws = draw_names(formals, count);
        out_.put(bound_label(production.stage, "b" + std::to_string(member + 1)) + " : " +
                     random_module(index),
                 production.span);
        write_parameters(formals, draws, production.span);
        out_.put(" : ", production.span);
        write_condition(member, {.expands_locals = true, .draws = draws});
        always = always || is_always(lowered_[member].condition);
        write_successor(member, {.draws = draws});
    }
    if (!always) { // if no production matches, the module stays
        out_.put(bound_label(first.stage, "k" + std::to_string(index + 1)) + " : " +
                     random_module(index),
                 first.span);
        write_parameters(names, draw_names(names, count), first.span);
        out_.put(" : * : " + spelled(first.predecessor.front().name,
                                     first.predecessor.front().has_arguments),
                 first.span);
        write_parameters(names, {}, first.span);
        out_.put(";\n", first.span);
    }
}

bool CpfgWriter::may_decompose_axiom(const CpfgProduction& production) const {
    return production.stage == Stage::Decompose &&
           std::any_of(session_.axiom.begin(), session_.axiom.end(), [&](const CpfgModule& module) {
               return module.name == production.predecessor.front().name &&
                      module.arguments.size() == production.predecessor.front().arguments.size();
           });
}

void CpfgWriter::write_condition(std::size_t index, const ForeignWriting& how) {
    const CpfgProduction& production = session_.productions[index];
    const ForeignId condition = lowered_[index].condition;
    const bool is_guarded = !lowered_[index].in_group && may_decompose_axiom(production);
    if (is_guarded) {
        out_.put(kAfterAxiom, production.span);
    }
    if (is_always(condition)) {
        out_.put(is_guarded ? "" : "*", production.span);
    } else {
        out_.put(is_guarded ? " && (" : "", production.span);
        tree_.write(condition, how, out_);
        out_.put(is_guarded ? ")" : "", production.span);
    }
}

void CpfgWriter::warn_weight(const CpfgProduction& production) {
    if (production.weight != kNoForeign && session_.seed == kNoForeign) {
        expressions_.warn_left_out(
            expression(production.weight).span, "weight",
            "without `seed:` the first matching production is taken, so this weight is ignored");
    }
    const auto is_valid = [&](const CpfgModule& module) { // write_pattern() reports others
        return std::ranges::all_of(module.arguments, [&](ForeignId argument) {
            return expression(argument).kind == ForeignKind::Name;
        });
    };
    if (is_random_choice(production) && (!production.left.empty() || !production.right.empty()) &&
        std::ranges::all_of(production.left, is_valid) &&
        std::ranges::all_of(production.right, is_valid)) {
        expressions_.warn_left_out(production.span, "choice " + key_of(production),
                                   "the choice is among productions with the same contexts; cpfg "
                                   "chooses among all that match");
    }
}

void CpfgWriter::write_weight(std::size_t index, const ForeignWriting& how) {
    const CpfgProduction& production = session_.productions[index];
    if (!is_random_choice(production)) {
        return;
    }
    const ForeignId weight = lowered_[index].weight;
    out_.put(" ~ ", weight == kNoForeign ? production.span : expression(production.weight).span);
    if (weight == kNoForeign) {
        out_.put("1", production.span);
    } else {
        tree_.write(weight, how, out_);
    }
}

} // namespace lsys
