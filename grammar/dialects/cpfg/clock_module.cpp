// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/clock_module.h"

#include "grammar/dialects/cpfg/known_values.h"

#include <algorithm>
#include <set>
#include <string>

namespace lsys {

namespace {

using Modules = std::vector<CpfgModule>;

bool is_same(const CpfgModule& a, const CpfgModule& b) {
    return a.name == b.name && a.arguments.size() == b.arguments.size();
}

/// Finds the clock: a production that rewrites, once in each step, the first module of the word
/// that is rewritten at all, and that changes only variables of the whole system.
class Clock {
public:
    explicit Clock(CpfgSession& session) : session_(session) {
        find_assigned(session.start, globals_);
        for (const CpfgProduction& production : session.productions) {
            if (production.stage == Stage::Rewrite) {
                for (const CpfgModule& module : production.predecessor) {
                    rewritten_.insert(module.name);
                }
            }
        }
    }

    void move_statements() {
        for (CpfgProduction& production : session_.productions) {
            if (!changes_globals(production) || !applies_first(production)) {
                continue;
            }
            for (std::vector<int>* const block : {&production.before, &production.after}) {
                session_.start_each.insert(session_.start_each.end(), block->begin(), block->end());
                block->clear();
            }
            return; // a word has one first module
        }
    }

private:
    [[nodiscard]] const CpfgStatement& statement(int index) const {
        return session_.statements[static_cast<std::size_t>(index)];
    }

    /// Adds the names of the variables that statements assign.
    void find_assigned(const std::vector<int>& block, std::set<std::string>& names) const {
        for (const int index : block) {
            if (statement(index).kind == CpfgStatementKind::Assign) {
                names.insert(session_.expressions[statement(index).target].text);
            }
            find_assigned(statement(index).block, names);
            find_assigned(statement(index).otherwise, names);
        }
    }

    /// Whether an expression has one of the names.
    [[nodiscard]] bool reads(ForeignId root, const std::set<std::string>& names) const {
        return root != kNoForeign && session_.expressions.has(root, [&](const ForeignNode& node) {
            return node.kind == ForeignKind::Name && names.count(node.text) != 0;
        });
    }
    [[nodiscard]] bool reads(const std::vector<int>& block,
                             const std::set<std::string>& names) const {
        return std::any_of(block.begin(), block.end(), [&](int index) {
            const CpfgStatement& each = statement(index);
            return reads(each.value, names) || reads(each.block, names) ||
                   reads(each.otherwise, names);
        });
    }

    /// Whether the production assigns variables of the system, no others, and reads no parameters.
    [[nodiscard]] bool changes_globals(const CpfgProduction& production) const {
        std::set<std::string> assigned;
        find_assigned(production.before, assigned);
        find_assigned(production.after, assigned);
        std::set<std::string> formals;
        for (const CpfgModule& module : production.predecessor) {
            for (const ForeignId argument : module.arguments) {
                formals.insert(session_.expressions[argument].text);
            }
        }
        return !assigned.empty() &&
               std::includes(globals_.begin(), globals_.end(), assigned.begin(), assigned.end()) &&
               !reads(production.before, formals) && !reads(production.after, formals);
    }

    /// Index of the first module that a production may rewrite; the size of the list if there is
    /// none.
    [[nodiscard]] std::size_t first_rewritten(const Modules& list) const {
        const auto found = std::find_if(list.begin(), list.end(), [&](const CpfgModule& module) {
            return rewritten_.count(module.name) != 0;
        });
        return static_cast<std::size_t>(found - list.begin());
    }

    /// Whether `list` has the module as its first module that is rewritten, and only once.
    [[nodiscard]] bool leads(const Modules& list, const CpfgModule& module) const {
        const std::size_t first = first_rewritten(list);
        return first < list.size() && is_same(list[first], module) &&
               std::count_if(list.begin(), list.end(),
                             [&](const CpfgModule& each) { return each.name == module.name; }) == 1;
    }

    /// Whether the production rewrites, in each step, the first module that is rewritten at all.
    [[nodiscard]] bool applies_first(const CpfgProduction& production) const {
        const bool is_simple =
            production.stage == Stage::Rewrite && production.predecessor.size() == 1 &&
            production.left.empty() && production.right.empty() &&
            (production.condition == kNoForeign ||
             KnownValues(session_.expressions).of(production.condition).value_or(0.0) != 0.0);
        if (!is_simple) {
            return false;
        }
        const CpfgModule& module = production.predecessor[0];
        return leads(session_.axiom, module) && leads(production.successor, module) &&
               std::all_of(session_.productions.begin(), session_.productions.end(),
                           [&](const CpfgProduction& other) {
                               return &other == &production || !mentions(other, module);
                           });
    }

    /// Whether a production rewrites or writes a module of this name.
    static bool mentions(const CpfgProduction& production, const CpfgModule& module) {
        const auto has = [&](const Modules& list) {
            return std::any_of(list.begin(), list.end(),
                               [&](const CpfgModule& each) { return each.name == module.name; });
        };
        return production.stage != Stage::Interpret &&
               (has(production.predecessor) || has(production.successor));
    }

    CpfgSession& session_;
    std::set<std::string> globals_;   // variables of `Start:`
    std::set<std::string> rewritten_; // names of predecessors
};

} // namespace

void move_statements_of_clock(CpfgSession& session) {
    Clock(session).move_statements();
}

} // namespace lsys
