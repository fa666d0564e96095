// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/commands.h"

#include "grammar/ast/reports.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace lsys {

namespace {

/// Maximum productions added for one production, since contexts multiply them.
constexpr std::size_t kMaxCopies = 100;

using Modules = std::vector<CpfgModule>;

/// Name and number of parameters of a command.
using Command = std::pair<std::string, std::size_t>;

bool is_command(const CpfgModule& module) {
    return module.name.size() > 1 && module.name[0] == '@';
}

class Commands {
public:
    explicit Commands(CpfgSession& session) : session_(session) {
        note(session.axiom);
        for (const CpfgProduction& production : session.productions) {
            note(production.successor);
            note(production.left);
            note(production.right);
        }
        const auto& named = session.considers ? session.considered : session.ignored;
        const bool is_named = std::any_of(
            named.begin(), named.end(), [](const CpfgModule& each) { return each.name[0] == '@'; });
        skips_prefix_ = session.considers ? !is_named : is_named;
    }

    void add() {
        if (commands_.empty()) {
            return;
        }
        find_rewritten();
        std::vector<CpfgProduction> all;
        std::vector<std::size_t> originals; // per production of `all`: the index of its original
        for (const CpfgProduction& production : session_.productions) {
            std::vector<CpfgProduction> copies{production};
            if (production.stage == Stage::Rewrite) { // others have no contexts
                add_contexts(copies, &CpfgProduction::left);
                add_contexts(copies, &CpfgProduction::right);
            }
            const std::size_t first = all.size();
            all.insert(all.end(), copies.begin(), copies.end());
            for (const CpfgProduction& copy : copies) {
                add_predecessors(copy, all);
            }
            originals.resize(all.size(), first);
        }
        remove_unused(all, originals);
        session_.productions = std::move(all);
    }

private:
    /// Adds the commands of a list to commands_.
    void note(const Modules& list) {
        for (const CpfgModule& module : list) {
            if (is_command(module)) {
                commands_.emplace(Command{module.name, module.arguments.size()}, module.span);
            }
        }
    }

    /// Removes productions that match a command which no word derived from the axiom contains. If
    /// an original and all its copies would go, the original stays, so that a warning reports it.
    void remove_unused(std::vector<CpfgProduction>& all,
                       const std::vector<std::size_t>& originals) const {
        std::set<Command> written;
        const auto add = [&](const Modules& list) {
            for (const CpfgModule& module : list) {
                written.emplace(module.name, module.arguments.size());
            }
        };
        const auto has = [&](const Modules& list) {
            return std::all_of(list.begin(), list.end(), [&](const CpfgModule& module) {
                return !concerns_commands(module) ||
                       written.count({module.name, module.arguments.size()}) != 0;
            });
        };
        add(session_.axiom);
        std::vector<bool> is_used(all.size(), false);
        for (std::size_t before = 0; before != written.size();) {
            before = written.size();
            for (std::size_t i = 0; i < all.size(); ++i) {
                is_used[i] = has(all[i].left) && has(all[i].predecessor) && has(all[i].right);
                if (is_used[i]) {
                    add(all[i].successor);
                }
            }
        }
        std::set<std::size_t> used; // originals of productions that are used
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (is_used[i]) {
                used.insert(originals[i]);
            }
        }
        std::vector<CpfgProduction> remaining;
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (is_used[i] || (originals[i] == i && used.count(i) == 0)) {
                remaining.push_back(std::move(all[i]));
            }
        }
        all = std::move(remaining);
    }

    /// Whether a production of the stage may rewrite letter `at` of a command. When cpfg interprets
    /// a word, it reads a command as a whole, so that a homomorphism matches only its `@`.
    static bool may_rewrite(Stage stage, std::size_t at) {
        return stage != Stage::Interpret || at == 0;
    }

    /// Whether `module`, a letter, is letter `at` of a command.
    static bool is_part(const CpfgModule& module, const Command& command, std::size_t at) {
        const auto& [name, arguments] = command;
        return module.name.size() == 1 && module.name[0] == name[at] &&
               module.arguments.size() == (at + 1 == name.size() ? arguments : 0);
    }

    /// Whether a module is a command or a letter of one.
    [[nodiscard]] bool concerns_commands(const CpfgModule& module) const {
        return is_command(module) ||
               std::any_of(commands_.begin(), commands_.end(), [&](const auto& entry) {
                   return entry.first.first.find(module.name) != std::string::npos;
               });
    }

    /// Reports commands of which several letters are rewritten: one production would have to
    /// rewrite both.
    void find_rewritten() {
        for (const auto& [command, span] : commands_) {
            std::map<Stage, std::set<std::size_t>> rewritten;
            for (const CpfgProduction& production : session_.productions) {
                for (std::size_t at = 0; at < command.first.size(); ++at) {
                    if (production.predecessor.size() == 1 && may_rewrite(production.stage, at) &&
                        is_part(production.predecessor[0], command, at)) {
                        rewritten[production.stage].insert(at);
                    }
                }
            }
            for (const auto& [stage, letters] : rewritten) {
                if (letters.size() > 1) {
                    session_.report_unsupported(span, "productions for several letters of `" +
                                                          shown(command.first) + "`");
                    break;
                }
            }
        }
    }

    /// Adds copies in which a command replaces its own last letter in a context. The other letters
    /// of the command must be ignored in contexts, or lie beyond the context.
    void add_contexts(std::vector<CpfgProduction>& copies, Modules CpfgProduction::*context) {
        const bool is_left = context == &CpfgProduction::left;
        const std::size_t count = (copies.front().*context).size();
        for (std::size_t i = 0; i < count; ++i) {
            if (!skips_prefix_ && !(is_left && i == 0)) {
                continue;
            }
            const std::size_t original_count = copies.size();
            for (const auto& [command, span] : commands_) {
                const std::size_t last = command.first.size() - 1;
                if (!is_part((copies.front().*context)[i], command, last)) {
                    continue;
                }
                for (std::size_t k = 0; k < original_count; ++k) {
                    if (copies.size() > kMaxCopies) {
                        session_.report_unsupported(
                            copies.front().span,
                            "a production whose contexts may be letters of so many commands");
                        return;
                    }
                    CpfgProduction copy = copies[k];
                    (copy.*context)[i].name = command.first;
                    copies.push_back(std::move(copy));
                }
            }
        }
    }

    void add_predecessors(const CpfgProduction& production, std::vector<CpfgProduction>& all) {
        if (production.predecessor.size() != 1) {
            return;
        }
        for (const auto& [command, span] : commands_) {
            for (std::size_t at = 0; at < command.first.size(); ++at) {
                if (may_rewrite(production.stage, at) &&
                    is_part(production.predecessor[0], command, at)) {
                    add_predecessor(production, command, at, all);
                }
            }
        }
    }

    /// Adds the production of a command, of which `production` rewrites letter `at`.
    void add_predecessor(const CpfgProduction& production,
                         const Command& command,
                         std::size_t at,
                         std::vector<CpfgProduction>& all) {
        CpfgProduction new_production = production;
        const std::string& name = command.first;
        // The letters before `at` are the nearest left context, those behind it the nearest right
        // one.
        for (std::size_t i = at; i > 0 && !skips_prefix_ && !new_production.left.empty(); --i) {
            if (new_production.left.back().name != name.substr(i - 1, 1)) {
                return;
            }
            new_production.left.pop_back();
        }
        if (at + 1 < name.size() && !new_production.right.empty() && !skips_prefix_) {
            return;
        }
        CpfgModule& predecessor = new_production.predecessor[0];
        const CpfgModule letter = predecessor;
        predecessor.name = name;
        if (at + 1 < name.size()) {
            predecessor.arguments = formals(command.second, production);
            predecessor.has_arguments = command.second != 0;
        }
        Modules written;
        const auto add_letters = [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i) {
                written.push_back({name.substr(i, 1), letter.span, false, {}});
            }
        };
        add_letters(0, at);
        written.insert(written.end(), new_production.successor.begin(),
                       new_production.successor.end());
        if (at + 1 < name.size()) {
            add_letters(at + 1, name.size() - 1);
            written.push_back({name.substr(name.size() - 1), letter.span, predecessor.has_arguments,
                               predecessor.arguments});
        }
        new_production.successor = joined(std::move(written));
        all.push_back(std::move(new_production));
    }

    /// Parameters whose names the production does not use.
    std::vector<ForeignId> formals(std::size_t count, const CpfgProduction& production) {
        std::set<std::string> taken;
        for (const Modules* list : {&production.left, &production.right}) {
            for (const CpfgModule& module : *list) {
                for (const ForeignId argument : module.arguments) {
                    taken.insert(session_.expressions[argument].text);
                }
            }
        }
        std::vector<ForeignId> names;
        for (std::size_t i = 0; i < count; ++i) {
            const std::string name = unique_name("kept" + std::to_string(i + 1), taken);
            names.push_back(session_.expressions.name(name, production.span));
        }
        return names;
    }

    /// Joins `@` and the letters after it to commands, as the scanner does.
    static Modules joined(Modules letters) {
        constexpr std::string_view kTwoLetters = "GTCDPBS"; // `@` and these take another letter
        const auto letter = [&](std::size_t i) {
            return i < letters.size() && letters[i].name.size() == 1 ? letters[i].name[0] : '\0';
        };
        Modules modules;
        for (std::size_t i = 0; i < letters.size(); ++i) {
            if (letter(i) != '@' || letters[i].has_arguments || letter(i + 1) == '\0') {
                modules.push_back(std::move(letters[i]));
                continue;
            }
            const bool has_two = kTwoLetters.find(letter(i + 1)) != kTwoLetters.npos &&
                                 !letters[i + 1].has_arguments && letter(i + 2) >= 'a' &&
                                 letter(i + 2) <= 'z';
            const std::size_t last = i + (has_two ? 2 : 1);
            CpfgModule command = letters[last];
            command.name = "@" + (has_two ? letters[i + 1].name : std::string()) + command.name;
            modules.push_back(std::move(command));
            i = last;
        }
        return modules;
    }

    CpfgSession& session_;
    std::map<Command, SourceSpan> commands_; // with their first places
    bool skips_prefix_ = false;              // contexts ignore `@`
};

} // namespace

void add_productions_of_commands(CpfgSession& session) {
    Commands(session).add();
}

} // namespace lsys
