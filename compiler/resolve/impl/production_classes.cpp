// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/production_classes.h"

#include "grammar/base/hash.h"

#include <utility>

namespace lsys {

namespace {

std::uint64_t hash_of(const ProgramPattern& pattern, std::uint64_t state) {
    state = combine(state, pattern.items.size());
    for (const ProgramPatternItem& item : pattern.items) {
        state = combine(state, static_cast<std::uint64_t>(item.symbol));
        state = combine(state, static_cast<std::uint64_t>(item.kind));
    }
    return state;
}

std::uint64_t rule_hash(const Production& production) {
    return hash_of(production.predecessor, static_cast<std::uint64_t>(production.stage));
}

std::uint64_t group_hash(const Production& production) {
    return hash_of(production.right, hash_of(production.left, rule_hash(production)));
}

/// Whether two patterns have the same symbols and brackets in the same order.
bool equal_patterns(const ProgramPattern& a, const ProgramPattern& b) {
    if (a.items.size() != b.items.size()) {
        return false;
    }
    for (std::size_t i = 0; i < a.items.size(); ++i) {
        if (a.items[i].kind != b.items[i].kind || a.items[i].symbol != b.items[i].symbol) {
            return false;
        }
    }
    return true;
}

bool same_rule(const Production& a, const Production& b) {
    return a.stage == b.stage && equal_patterns(a.predecessor, b.predecessor);
}

bool same_group(const Production& a, const Production& b) {
    return same_rule(a, b) && equal_patterns(a.left, b.left) && equal_patterns(a.right, b.right);
}

} // namespace

std::uint32_t
ProductionClasses::first_equal(Table& table, std::uint32_t index, Hash hash, Equal equal) {
    const std::vector<Production>& productions = program_.productions;
    const auto slot_of = [&](std::uint32_t production) {
        const std::size_t mask = table.firsts.size() - 1;
        std::size_t slot = hash(productions[production]) & mask;
        while (table.firsts[slot] != kNone &&
               !equal(productions[table.firsts[slot]], productions[production])) {
            slot = (slot + 1) & mask;
        }
        return slot;
    };
    const std::size_t slot = slot_of(index);
    if (table.firsts[slot] != kNone) {
        return table.firsts[slot];
    }
    table.firsts[slot] = index;
    if (++table.count * std::size_t{2} > table.firsts.size()) {
        const std::vector<std::uint32_t> old =
            std::exchange(table.firsts, std::vector<std::uint32_t>(table.firsts.size() * 2, kNone));
        for (const std::uint32_t first : old) {
            if (first != kNone) {
                table.firsts[slot_of(first)] = first;
            }
        }
    }
    return index;
}

void ProductionClasses::classify_last() {
    const auto index = static_cast<std::uint32_t>(program_.productions.size() - 1);
    Production& production = program_.productions[index];
    const std::uint32_t rule = first_equal(rules_, index, rule_hash, same_rule);
    production.rule = rule == index ? program_.rule_count++ : program_.productions[rule].rule;
    const std::uint32_t group = first_equal(groups_, index, group_hash, same_group);
    production.group =
        group == index ? program_.context_group_count++ : program_.productions[group].group;
}

} // namespace lsys
