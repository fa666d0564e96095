// SPDX-License-Identifier: MIT
#include "compiler/lint/impl/reachable.h"

#include "grammar/base/grouped_lists.h"

#include <algorithm>

namespace lsys {

namespace {

bool never_holds(const Program& program, const Production& production) {
    if (production.condition == kNoValue) {
        return false;
    }
    const Value& value = program.value(production.condition);
    return value.opcode == Opcode::Literal && value.literal == 0.0F;
}

/// The symbols that must occur before the production can be used, each once.
std::vector<SymbolId> needed_symbols(const Production& production) {
    std::vector<SymbolId> symbols;
    for (const ProgramPattern* pattern :
         {&production.left, &production.predecessor, &production.right}) {
        for (const ProgramPatternItem& item : pattern->items) {
            if (item.kind == PatternKind::Module) {
                symbols.push_back(item.symbol);
            }
        }
    }
    std::sort(symbols.begin(), symbols.end());
    symbols.erase(std::unique(symbols.begin(), symbols.end()), symbols.end());
    return symbols;
}

} // namespace

Reachable find_reachable(const Program& program) {
    Reachable result;
    result.generation.assign(program.symbols.size(), kNone);
    result.usable.assign(program.productions.size(), false);

    std::vector<std::uint32_t> missing; // by production: number of needed symbols not yet reached
    for (const Production& production : program.productions) {
        missing.push_back(static_cast<std::uint32_t>(needed_symbols(production).size()));
    }
    const GroupedLists waiting(program.symbols.size(), [&](auto&& add) {
        for (std::uint32_t p = 0; p < program.productions.size(); ++p) {
            for (const SymbolId symbol : needed_symbols(program.productions[p])) {
                add(static_cast<std::size_t>(symbol), p);
            }
        }
    });

    // The queue is ordered by generation only if each rewriting step is one generation.
    const bool ordered =
        program.settings.rewriting != RewritingMode::Sequential &&
        (program.productions.empty() || program.productions.back().stage == Stage::Rewrite);
    std::vector<SymbolId> queue; // reached symbols, in the order of generations
    const auto reach = [&](const ProgramWord& word, std::uint32_t generation) {
        for_each_symbol(program, word, [&](std::size_t, SymbolId symbol) {
            std::uint32_t& known = result.generation[static_cast<std::size_t>(symbol)];
            if (known == kNone) {
                known = ordered ? generation : 0;
                queue.push_back(symbol);
            }
        });
    };
    for (const Axiom& axiom : program.axioms) {
        reach(axiom.word, 0);
    }
    for (std::size_t head = 0; head < queue.size(); ++head) {
        const auto s = static_cast<std::size_t>(queue[head]);
        for (const std::uint32_t p : waiting[s]) {
            if (--missing[p] == 0 && !never_holds(program, program.productions[p])) {
                result.usable[p] = true;
                reach(program.productions[p].successor, result.generation[s] + 1);
            }
        }
    }
    return result;
}

} // namespace lsys
