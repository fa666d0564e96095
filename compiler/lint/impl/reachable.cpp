#include "compiler/lint/impl/reachable.h"

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

    // By symbol: the productions that wait for it.
    std::vector<std::uint32_t> first(program.symbols.size() + 1, 0);
    std::vector<std::uint32_t> missing(program.productions.size(), 0);
    for (std::size_t p = 0; p < program.productions.size(); ++p) {
        for (const SymbolId symbol : needed_symbols(program.productions[p])) {
            ++first[static_cast<std::size_t>(symbol) + 1];
            ++missing[p];
        }
    }
    for (std::size_t i = 1; i < first.size(); ++i) {
        first[i] += first[i - 1];
    }
    std::vector<std::uint32_t> waiting(first.back());
    std::vector<std::uint32_t> next = first;
    for (std::uint32_t p = 0; p < program.productions.size(); ++p) {
        for (const SymbolId symbol : needed_symbols(program.productions[p])) {
            waiting[next[static_cast<std::size_t>(symbol)]++] = p;
        }
    }

    // The order of the queue is that of generations only where each step is one.
    const bool ordered =
        program.settings.rewriting != RewritingMode::Sequential &&
        (program.productions.empty() || program.productions.back().stage == Stage::Rewrite);
    std::vector<SymbolId> queue; // in order of generations
    const auto reach = [&](const ProgramWord& word, std::uint32_t generation) {
        for_each_symbol(program, word, [&](std::size_t, SymbolId symbol) {
            std::uint32_t& known = result.generation[static_cast<std::size_t>(symbol)];
            if (known == kNone) {
                known = ordered ? generation : 0;
                queue.push_back(symbol);
            }
        });
    };
    reach(program.axiom, 0);
    for (std::size_t head = 0; head < queue.size(); ++head) {
        const auto s = static_cast<std::size_t>(queue[head]);
        for (std::uint32_t i = first[s]; i < first[s + 1]; ++i) {
            const std::uint32_t p = waiting[i];
            if (--missing[p] == 0 && !never_holds(program, program.productions[p])) {
                result.usable[p] = true;
                reach(program.productions[p].successor, result.generation[s] + 1);
            }
        }
    }
    return result;
}

} // namespace lsys
