// SPDX-License-Identifier: MIT
// Modules that #decompose or #interpret replace without end, which a run reports as an error only
// after the last pass. Decided without parameter values, as a greatest fixed point: a module is
// endless if some production always matches it and every production that may match it writes an
// endless module.
#include "compiler/lint/impl/lints.h"
#include "compiler/lint/impl/places.h"
#include "compiler/lint/impl/reachable.h"
#include "grammar/base/grouped_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

namespace {

/// The value of a condition, or nothing if it is not constant.
std::optional<bool> constant_condition(const Program& program, const Production& production) {
    if (production.condition == kNoValue) {
        return true;
    }
    const Value& value = program.value(production.condition);
    return value.opcode == Opcode::Literal ? std::optional(value.literal != 0.0F) : std::nullopt;
}

/// The productions of one stage, by the modules that they replace.
class StageGraph {
public:
    StageGraph(const Program& program, Stage stage) : program_(program) {
        const std::size_t symbols = program.symbols.size();
        tried_.resize(symbols);
        is_certain_.assign(symbols, false);
        for (std::uint32_t p = 0; p < program.productions.size(); ++p) {
            const Production& production = program.productions[p];
            if (production.stage == stage && production.predecessor.items.size() == 1) {
                add(p, production);
            }
        }
        remove_ending();
    }

    /// Whether modules of the symbol are replaced without end.
    [[nodiscard]] bool is_endless(SymbolId symbol) const {
        return endless_[static_cast<std::size_t>(symbol)];
    }
    /// The first production of an endless symbol.
    [[nodiscard]] std::uint32_t first_production(SymbolId symbol) const {
        return tried_[static_cast<std::size_t>(symbol)].front();
    }
    /// Calls visit(next) for each endless symbol in a successor of `symbol`.
    template <typename Visit>
    void for_each_next(SymbolId symbol, const Visit& visit) const {
        for (const std::uint32_t p : tried_[static_cast<std::size_t>(symbol)]) {
            for_each_symbol(program_, program_.productions[p].successor,
                            [&](std::size_t, SymbolId next) {
                                if (is_endless(next)) {
                                    visit(next);
                                }
                            });
        }
    }

private:
    void add(std::uint32_t p, const Production& production) {
        const auto s = static_cast<std::size_t>(production.predecessor.items.front().symbol);
        const std::optional<bool> holds = constant_condition(program_, production);
        // Once a production always matches, only its stochastic alternatives can still be chosen.
        if (holds == false || (is_certain_[s] && !production.stochastic)) {
            return;
        }
        tried_[s].push_back(p);
        is_certain_[s] = is_certain_[s] ||
                         (holds == true && (!production.stochastic || production.weight > 0.0F));
    }

    /// Computes endless_: removes modules that have a production without endless modules, until
    /// each remaining module writes an endless one.
    void remove_ending() {
        endless_ = is_certain_;
        // By production: number of endless modules in its successor.
        std::vector<std::uint32_t> endless_counts(program_.productions.size(), 0);
        std::vector<SymbolId> removed;
        const GroupedLists writers(program_.symbols.size(), [&](auto&& add_to) {
            for (const std::vector<std::uint32_t>& list : tried_) {
                for (const std::uint32_t p : list) {
                    for_each_symbol(program_, program_.productions[p].successor,
                                    [&](std::size_t, SymbolId symbol) {
                                        add_to(static_cast<std::size_t>(symbol), p);
                                    });
                }
            }
        });
        for (std::size_t s = 0; s < endless_.size(); ++s) {
            for (const std::uint32_t p : writers[s]) {
                endless_counts[p] += endless_[s] ? 1U : 0U;
            }
        }
        const auto check = [&](std::size_t s) {
            const std::vector<std::uint32_t>& list = tried_[s];
            if (endless_[s] && std::any_of(list.begin(), list.end(), [&](std::uint32_t p) {
                    return endless_counts[p] == 0;
                })) {
                endless_[s] = false;
                removed.push_back(SymbolId{static_cast<std::uint32_t>(s)});
            }
        };
        for (std::size_t s = 0; s < endless_.size(); ++s) {
            check(s);
        }
        while (!removed.empty()) {
            const auto s = static_cast<std::size_t>(removed.back());
            removed.pop_back();
            for (const std::uint32_t p : writers[s]) {
                --endless_counts[p];
                check(static_cast<std::size_t>(
                    program_.productions[p].predecessor.items.front().symbol));
            }
        }
    }

    const Program& program_;
    /// By symbol: the productions that may match, in file order.
    std::vector<std::vector<std::uint32_t>> tried_;
    std::vector<bool> is_certain_; // by symbol: some production always matches
    std::vector<bool> endless_;    // by symbol
};

void report(const CheckInput& input,
            Stage stage,
            const Production& production,
            Diagnostics& diagnostics) {
    const Settings& settings = input.program.settings;
    const bool draws = stage == Stage::Interpret;
    const SymbolId symbol = production.predecessor.items.front().symbol;
    Diagnostic& diagnostic = diagnostics.add(
        DiagnosticCode::EndlessPasses, production.predecessor.span,
        fmt::format("`{}` replaces {} without end", keyword_of(stage), quoted(input.name(symbol))));
    diagnostic.notes.push_back(
        fmt::format("after {} passes this is an error when the grammar is derived",
                    draws ? settings.interpret_depth : settings.decompose_depth));
    diagnostic.help.emplace_back("let a condition end it, or keep what is left with "
                                 "`#set at_depth stop;`");
}

} // namespace

void check_endless_stages(const CheckInput& input, Diagnostics& diagnostics) {
    const Program& program = input.program;
    if (program.settings.at_depth == AtDepth::Stop || program.productions.empty() ||
        program.productions.back().stage == Stage::Rewrite) {
        return;
    }
    const Reachable reachable = find_reachable(program);
    std::uint64_t work_left = std::uint64_t{1} << 22; // modules of successors visited
    for (const Stage stage : {Stage::Decompose, Stage::Interpret}) {
        const StageGraph graph(program, stage);
        std::vector<bool> seen(program.symbols.size(), false); // reachable from a reported cycle
        for (const Production& production : program.productions) {
            if (production.stage != stage || production.predecessor.items.size() != 1) {
                continue;
            }
            const SymbolId start = production.predecessor.items.front().symbol;
            if (!graph.is_endless(start) || !reachable.occurs(start) ||
                seen[static_cast<std::size_t>(start)]) {
                continue;
            }
            std::vector<SymbolId> found{start};
            std::vector<bool> visited(program.symbols.size(), false);
            bool returns = false;
            for (std::size_t head = 0; head < found.size() && work_left != 0; ++head) {
                graph.for_each_next(found[head], [&](SymbolId next) {
                    work_left -= work_left == 0 ? 0 : 1;
                    returns = returns || next == start;
                    if (!visited[static_cast<std::size_t>(next)]) {
                        visited[static_cast<std::size_t>(next)] = true;
                        found.push_back(next);
                    }
                });
            }
            if (!returns) {
                continue;
            }
            for (const SymbolId symbol : found) {
                seen[static_cast<std::size_t>(symbol)] = true;
            }
            report(input, stage, program.productions[graph.first_production(start)], diagnostics);
        }
    }
}

} // namespace lsys
