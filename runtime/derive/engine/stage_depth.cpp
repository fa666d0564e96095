// SPDX-License-Identifier: MIT
#include "runtime/derive/engine/stage_depth.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace lsys {

namespace {

/// The graph of rewriting in a stage: edges lead from each symbol to the symbols of its successors
/// that productions of the stage match.
std::vector<std::vector<std::uint32_t>> rewriting_graph(const Bytecode& bytecode,
                                                        TableRange stage) {
    std::vector<std::vector<std::uint32_t>> edges(bytecode.symbols.size());
    std::vector<bool> matched(bytecode.symbols.size(), false);
    const auto head = [&](std::uint32_t p) {
        const TableRange predecessor = bytecode.productions[p].predecessor;
        return static_cast<std::size_t>(bytecode.patterns[predecessor.first].symbol);
    };
    for (std::uint32_t p = stage.first; p < stage.first + stage.count; ++p) {
        matched[head(p)] = true;
    }
    for (std::uint32_t p = stage.first; p < stage.first + stage.count; ++p) {
        const TableRange codes = bytecode.productions[p].successor.codes;
        for (std::uint32_t i = codes.first; i < codes.first + codes.count; ++i) {
            const auto symbol =
                static_cast<std::uint32_t>(bytecode.symbol_of(bytecode.template_codes[i]));
            if (matched[symbol]) {
                edges[head(p)].push_back(symbol);
            }
        }
    }
    for (std::vector<std::uint32_t>& list : edges) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return edges;
}

/// The number of edges of the longest path of the graph `edges`; nothing if it has a cycle.
std::optional<std::uint32_t> longest_path(const std::vector<std::vector<std::uint32_t>>& edges) {
    std::vector<std::uint32_t> in_degrees(edges.size(), 0);
    for (const std::vector<std::uint32_t>& list : edges) {
        for (const std::uint32_t target : list) {
            ++in_degrees[target];
        }
    }
    std::vector<std::uint32_t> ready;
    for (std::uint32_t s = 0; s < edges.size(); ++s) {
        if (in_degrees[s] == 0) {
            ready.push_back(s);
        }
    }
    std::vector<std::uint32_t> steps(edges.size(), 0);
    std::uint32_t max_steps = 0;
    std::size_t done = 0;
    for (; done < ready.size(); ++done) {
        const std::uint32_t s = ready[done];
        max_steps = std::max(max_steps, steps[s]);
        for (const std::uint32_t target : edges[s]) {
            steps[target] = std::max(steps[target], steps[s] + 1);
            if (--in_degrees[target] == 0) {
                ready.push_back(target);
            }
        }
    }
    return done == edges.size() ? std::optional(max_steps) : std::nullopt;
}

} // namespace

StageDepth stage_depth(const Bytecode& bytecode, Stage stage) {
    const TableRange range = bytecode.productions_of(stage);
    if (range.count == 0) {
        return {};
    }
    const std::uint32_t max_passes = stage == Stage::Decompose ? bytecode.settings.decompose_depth
                                                               : bytecode.settings.interpret_depth;
    const std::optional<std::uint32_t> edges = longest_path(rewriting_graph(bytecode, range));
    const std::uint32_t needed = edges ? *edges + 1 : max_passes + 1;
    return {std::min(needed, max_passes),
            needed > max_passes && bytecode.settings.at_depth == AtDepth::Error};
}

} // namespace lsys
