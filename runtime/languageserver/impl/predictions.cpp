// SPDX-License-Identifier: MIT
#include "runtime/languageserver/impl/predictions.h"

#include "compiler/growth/growth.h"
#include "grammar/base/grouped_lists.h"

#include <fmt/format.h>

#include <cstddef>
#include <set>
#include <utility>

namespace lsys {

std::string predicted_length(const CompiledText& compiled) {
    if (!compiled.has_bytecode || !compiled.grammar.bytecode.generations) {
        return {};
    }
    const std::uint32_t generations = *compiled.grammar.bytecode.generations;
    const GrowthPrediction growth = predict_growth(compiled.grammar.bytecode, generations);
    if (!growth.has_last && growth.low.empty()) {
        return {};
    }
    const std::size_t last = growth.has_last ? generations : growth.low.size() - 1;
    const std::string low =
        to_text((growth.has_last ? growth.last_low : growth.low.back()).modules);
    const std::string high =
        to_text((growth.has_last ? growth.last_high : growth.high.back()).modules);
    std::string text =
        fmt::format("generation {}: {}{} module{}", last, low,
                    low == high ? std::string() : " to " + high, high == "1" ? "" : "s");
    if (growth.has_expected && last < growth.expected_modules.size()) {
        text += fmt::format(", {:.6g} expected", growth.expected_modules[last]);
    }
    return text;
}

std::vector<std::optional<std::uint32_t>> first_ages(const Program& program) {
    // Per production: the symbols of its predecessor and contexts that have not been written yet,
    // each once.
    std::vector<std::set<std::size_t>> needed(program.productions.size());
    for (std::size_t i = 0; i < program.productions.size(); ++i) {
        const Production& production = program.productions[i];
        for (const ProgramPattern* pattern :
             {&production.left, &production.predecessor, &production.right}) {
            for (const ProgramPatternItem& item : pattern->items) {
                if (const auto symbol = static_cast<std::size_t>(item.symbol);
                    symbol < program.symbols.size()) {
                    needed[i].insert(symbol);
                }
            }
        }
    }
    const GroupedLists users(program.symbols.size(), [&](auto&& add) {
        for (std::uint32_t i = 0; i < needed.size(); ++i) {
            for (const std::size_t symbol : needed[i]) {
                add(symbol, i);
            }
        }
    });
    // `now` and `next`: the symbols that occur for the first time in the word of this age, and of
    // the next age.
    std::vector<bool> is_written(program.symbols.size());
    std::vector<std::size_t> now;
    std::vector<std::size_t> next;
    const auto write = [&](const ProgramWord& word, std::vector<std::size_t>& age) {
        for_each_symbol(program, word, [&](std::size_t /*index*/, SymbolId id) {
            const auto symbol = static_cast<std::size_t>(id);
            if (!is_written[symbol]) {
                is_written[symbol] = true;
                age.push_back(symbol);
            }
        });
    };
    for (const Axiom& axiom : program.axioms) {
        write(axiom.word, now);
    }
    std::vector<std::optional<std::uint32_t>> ages(program.productions.size());
    for (std::uint32_t age = 0; !now.empty(); ++age) {
        for (std::size_t i = 0; i < now.size(); ++i) { // `now` grows by decomposition
            for (const std::uint32_t user : users[now[i]]) {
                const Production& production = program.productions[user];
                needed[user].erase(now[i]);
                if (needed[user].empty() && production.stage != Stage::Interpret) {
                    ages[user] = age;
                    write(production.successor, production.stage == Stage::Rewrite ? next : now);
                }
            }
        }
        now = std::exchange(next, {});
    }
    return ages;
}

} // namespace lsys
