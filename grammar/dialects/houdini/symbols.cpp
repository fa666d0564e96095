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
    see(session.premise, true);
    for (const HoudiniRule& rule : session.rules) {
        see(rule.left, false);
        see(rule.predecessor, false);
        see(rule.right, false);
        see(rule.successor, true);
        const HoudiniList& head = session.lists[static_cast<std::size_t>(rule.predecessor)];
        HoudiniSymbol& symbol = symbol_of(session.modules[head.begin]);
        symbol.is_rewritten = true;
        symbol.ages = symbol.ages || asks_for_age(rule);
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

const HoudiniSymbol& HoudiniSymbols::of(const HoudiniModule& module) const {
    return symbols_.find(session_.context.sources.text(module.symbol))->second;
}

std::uint32_t HoudiniSymbols::count(const HoudiniModule& module) const {
    if (module.arguments == -1) {
        return 0;
    }
    std::uint32_t given = 0;
    std::uint32_t index = 0;
    for (int node = session_.arguments[static_cast<std::size_t>(module.arguments)].first;
         node != -1; node = session_.nodes[static_cast<std::size_t>(node)].next) {
        ++index;
        if (session_.nodes[static_cast<std::size_t>(node)].kind != HoudiniNodeKind::Missing) {
            given = index;
        }
    }
    return given;
}

void HoudiniSymbols::see(int list, bool is_word) {
    if (list == -1) {
        return;
    }
    const HoudiniList& modules = session_.lists[static_cast<std::size_t>(list)];
    for (std::uint32_t i = modules.begin; i < modules.end; ++i) {
        const HoudiniModule& module = session_.modules[i];
        HoudiniSymbol& symbol = symbol_of(module);
        const std::uint32_t parameters = count(module);
        symbol.most = std::max(symbol.most, parameters);
        if (is_word) {
            symbol.counts |= std::uint64_t{1} << std::min(parameters, kMostParameters);
        }
    }
}

bool HoudiniSymbols::asks_for_age(const HoudiniRule& rule) const {
    for (std::uint32_t i = rule.first_node; i < rule.end_node; ++i) {
        const HoudiniNode& node = session_.nodes[i];
        if (node.kind == HoudiniNodeKind::Name && session_.context.sources.text(node.span) == "g") {
            return !names_parameter(rule, "g");
        }
    }
    return false;
}

} // namespace lsys
