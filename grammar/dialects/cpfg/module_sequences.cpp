// SPDX-License-Identifier: MIT
#include "grammar/dialects/cpfg/module_sequences.h"

#include "grammar/dialects/cpfg/known_values.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>

namespace lsys {

namespace {

using Modules = std::vector<CpfgModule>;

constexpr std::size_t kMaxLetters = 16; // max length of a module name in back quotes

bool is_same(const CpfgModule& a, const CpfgModule& b) {
    return a.name == b.name && a.arguments.size() == b.arguments.size();
}

/// Whether `list` has the modules of `sequence` from index `at` on.
bool has_at(const Modules& list, std::size_t at, const Modules& sequence) {
    return at + sequence.size() <= list.size() &&
           std::equal(sequence.begin(), sequence.end(),
                      list.begin() + static_cast<std::ptrdiff_t>(at), is_same);
}

class Sequences {
public:
    explicit Sequences(CpfgSession& session)
        : session_(session), known_values_(session.expressions) {}

    void join() {
        for (const CpfgProduction& production : session_.productions) {
            const Modules& modules = production.predecessor;
            if (production.stage != Stage::Rewrite && modules.size() > 1 &&
                !is_listed(production.stage, modules) && may_join(production.stage, modules)) {
                found_.push_back({production.stage, modules});
            }
        }
        std::vector<CpfgProduction> all;
        for (CpfgProduction& production : session_.productions) {
            join_in(production);
            all.push_back(std::move(production));
        }
        for (const Sequence& sequence : found_) {
            if (!always_holds(sequence, all)) {
                all.push_back(taking_apart(sequence));
            }
        }
        session_.productions = std::move(all);
    }

private:
    struct Sequence {
        Stage stage{};
        Modules modules;
    };

    [[nodiscard]] bool is_listed(Stage stage, const Modules& modules) const {
        return std::any_of(found_.begin(), found_.end(), [&](const Sequence& each) {
            return each.stage == stage && each.modules.size() == modules.size() &&
                   has_at(modules, 0, each.modules);
        });
    }

    /// Whether the condition of a production always holds.
    [[nodiscard]] bool is_always(const CpfgProduction& production) {
        return production.condition == kNoForeign ||
               known_values_.of(production.condition).value_or(0.0) != 0.0;
    }

    /// Whether one module can replace the sequence in all words of the stage.
    [[nodiscard]] bool may_join(Stage stage, const Modules& modules) {
        std::size_t letters = 0;
        for (const CpfgModule& module : modules) {
            letters += module.name.size();
        }
        const bool has_brackets =
            std::any_of(modules.begin(), modules.end(), [](const CpfgModule& module) {
                return std::string_view("[]{}%@?$").find(module.name[0]) != std::string_view::npos;
            });
        return letters <= kMaxLetters && !has_brackets && is_first(stage, modules) &&
               !may_stay(stage, modules);
    }

    /// Whether only productions of the sequence can apply to it. Up to its first production that
    /// always holds, no other may match its beginning, or it and modules behind it. If none always
    /// holds, the stage must be Interpret, and no other may begin with a module of the sequence.
    [[nodiscard]] bool is_first(Stage stage, const Modules& modules) {
        bool always = false;      // a production of the whole sequence always holds
        bool parts_alone = false; // another production begins with a module of the sequence
        for (const CpfgProduction& production : session_.productions) {
            const Modules& other = production.predecessor;
            if (production.stage != stage || other.empty()) {
                continue;
            }
            const bool is_own = other.size() == modules.size() && has_at(other, 0, modules);
            always = always || (is_own && is_always(production));
            if (is_own) {
                continue;
            }
            if (is_same(other[0], modules[0]) && !always &&
                (other.size() == 1 || has_at(other, 0, modules) || has_at(modules, 0, other))) {
                return false;
            }
            parts_alone = parts_alone ||
                          std::any_of(modules.begin(), modules.end(), [&](const CpfgModule& part) {
                              return is_same(part, other[0]);
                          });
        }
        return always || (stage == Stage::Interpret && !parts_alone);
    }

    /// Whether the first module of the sequence may be in a word: then cpfg would find the sequence
    /// among modules of different successors.
    [[nodiscard]] bool may_stay(Stage stage, const Modules& modules) const {
        const auto occurs = [&](const Modules& list) {
            return std::any_of(list.begin(), list.end(), [&](const CpfgModule& module) {
                return is_same(module, modules[0]);
            });
        };
        const auto occurs_apart = [&](const Modules& list) {
            for (std::size_t i = 0; i < list.size(); ++i) {
                if (has_at(list, i, modules)) {
                    i += modules.size() - 1;
                } else if (is_same(list[i], modules[0])) {
                    return true;
                }
            }
            return false;
        };
        return occurs(session_.axiom) ||
               std::any_of(session_.productions.begin(), session_.productions.end(),
                           [&](const CpfgProduction& production) {
                               const Modules& list = production.successor;
                               return production.stage == Stage::Interpret ? false
                                      : stage == Stage::Decompose          ? occurs_apart(list)
                                                                           : occurs(list);
                           });
    }

    /// One module in place of `count` modules from `first` on.
    static CpfgModule joined(const CpfgModule* first, std::size_t count) {
        CpfgModule joined_module = *first;
        for (std::size_t i = 1; i < count; ++i) {
            joined_module.name += first[i].name;
            joined_module.arguments.insert(joined_module.arguments.end(),
                                           first[i].arguments.begin(), first[i].arguments.end());
        }
        joined_module.has_arguments = !joined_module.arguments.empty();
        return joined_module;
    }

    /// Joins the sequences of the predecessor and the successor. The word that a stage reads is
    /// written by that stage and by those before it.
    void join_in(CpfgProduction& production) const {
        for (const Sequence& sequence : found_) {
            const std::size_t count = sequence.modules.size();
            if (production.stage == sequence.stage && production.predecessor.size() == count &&
                has_at(production.predecessor, 0, sequence.modules)) {
                production.predecessor = {joined(production.predecessor.data(), count)};
            }
            if (production.stage == Stage::Interpret && sequence.stage != Stage::Interpret) {
                continue;
            }
            Modules joined_modules;
            for (std::size_t i = 0; i < production.successor.size(); ++i) {
                if (has_at(production.successor, i, sequence.modules)) {
                    joined_modules.push_back(joined(&production.successor[i], count));
                    i += count - 1;
                } else {
                    joined_modules.push_back(production.successor[i]);
                }
            }
            production.successor = std::move(joined_modules);
        }
    }

    /// Whether some production of the joined module always holds.
    [[nodiscard]] bool always_holds(const Sequence& sequence,
                                    const std::vector<CpfgProduction>& productions) {
        const CpfgModule module = joined(sequence.modules.data(), sequence.modules.size());
        return std::any_of(
            productions.begin(), productions.end(), [&](const CpfgProduction& production) {
                return production.stage == sequence.stage && production.predecessor.size() == 1 &&
                       is_same(production.predecessor[0], module) && is_always(production);
            });
    }

    /// The production that writes the modules of a sequence if no other applies.
    static CpfgProduction taking_apart(const Sequence& sequence) {
        CpfgProduction production;
        production.stage = sequence.stage;
        production.predecessor = {joined(sequence.modules.data(), sequence.modules.size())};
        production.successor = sequence.modules;
        production.span = production.arrow = sequence.modules[0].span;
        return production;
    }

    CpfgSession& session_;
    KnownValues known_values_;
    std::vector<Sequence> found_; // sequences to join
};

} // namespace

void join_module_sequences(CpfgSession& session) {
    Sequences(session).join();
}

} // namespace lsys
