// SPDX-License-Identifier: MIT
#include "grammar/dialects/houdini/symbols.h"

#include <algorithm>

namespace lsys {

namespace {

constexpr std::string_view kCommands = "FHGfhJKMT+-&^\\/|*~\"!;_?@'#%$[]{}.ga";

} // namespace

bool names_parameter(const HoudiniRule& rule, std::string_view name) {
    return std::binary_search(rule.formals.begin(), rule.formals.end(), name);
}

HoudiniSymbols::HoudiniSymbols(const HoudiniSession& session) : session_(session) {
    count_symbols(session.premise, true);
    for (const HoudiniRule& rule : session.rules) {
        count_symbols(rule.left, false);
        count_symbols(rule.predecessor, false);
        count_symbols(rule.right, false);
        count_symbols(rule.successor, true);
        HoudiniSymbol& symbol = symbol_of(rule.predecessor.front());
        symbol.is_rewritten = true;
        symbol.has_age = symbol.has_age || reads_age(rule);
    }
}

HoudiniSymbol& HoudiniSymbols::symbol_of(const HoudiniModule& module) {
    const std::string_view name = session_.context.sources.text(module.symbol);
    const auto [known, is_new] = symbols_.try_emplace(name);
    if (is_new) {
        known->second.is_command =
            name.size() == 1 && kCommands.find(name[0]) != std::string_view::npos;
    }
    return known->second;
}

const HoudiniSymbol& HoudiniSymbols::symbol(const HoudiniModule& module) const {
    return symbols_.find(session_.context.sources.text(module.symbol))->second;
}

std::uint32_t HoudiniSymbols::count(const HoudiniModule& module) const {
    auto written_count = static_cast<std::uint32_t>(module.arguments.size());
    while (written_count != 0 &&
           session_.node(module.arguments[written_count - 1]).kind == ForeignKind::Missing) {
        --written_count;
    }
    return written_count;
}

void HoudiniSymbols::count_symbols(const std::vector<HoudiniModule>& modules, bool is_word) {
    for (const HoudiniModule& module : modules) {
        HoudiniSymbol& symbol = symbol_of(module);
        const std::uint32_t parameters = count(module);
        symbol.max_count = std::max(symbol.max_count, parameters);
        if (is_word) {
            symbol.counts |= std::uint64_t{1} << std::min(parameters, kMaxParameters);
        }
    }
}

bool HoudiniSymbols::reads_age(const HoudiniRule& rule) const {
    for (std::uint32_t i = rule.first_node; i < rule.end_node; ++i) {
        const ForeignNode& node = session_.node(static_cast<ForeignId>(i));
        if (node.kind == ForeignKind::Name && node.text == "g") {
            return !names_parameter(rule, "g");
        }
    }
    return false;
}

} // namespace lsys
