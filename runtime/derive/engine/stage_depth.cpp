#include "runtime/derive/engine/stage_depth.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace lsys {

namespace {

/// For each symbol, the symbols that productions of the stage write for it and that productions of
/// the stage match.
std::vector<std::vector<std::uint32_t>> parts_of(const Bytecode& bytecode, TableRange stage) {
    std::vector<std::vector<std::uint32_t>> parts(bytecode.symbols.size());
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
                parts[head(p)].push_back(symbol);
            }
        }
    }
    for (std::vector<std::uint32_t>& list : parts) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return parts;
}

/// The number of edges of the longest path of the graph `parts`; nothing if it has a cycle.
std::optional<std::uint32_t> longest_path(const std::vector<std::vector<std::uint32_t>>& parts) {
    std::vector<std::uint32_t> users(parts.size(), 0);
    for (const std::vector<std::uint32_t>& list : parts) {
        for (const std::uint32_t part : list) {
            ++users[part];
        }
    }
    std::vector<std::uint32_t> ready;
    for (std::uint32_t s = 0; s < parts.size(); ++s) {
        if (users[s] == 0) {
            ready.push_back(s);
        }
    }
    std::vector<std::uint32_t> steps(parts.size(), 0);
    std::uint32_t max_steps = 0;
    std::size_t done = 0;
    for (; done < ready.size(); ++done) {
        const std::uint32_t s = ready[done];
        max_steps = std::max(max_steps, steps[s]);
        for (const std::uint32_t part : parts[s]) {
            steps[part] = std::max(steps[part], steps[s] + 1);
            if (--users[part] == 0) {
                ready.push_back(part);
            }
        }
    }
    return done == parts.size() ? std::optional(max_steps) : std::nullopt;
}

} // namespace

StageDepth stage_depth(const Bytecode& bytecode, Stage stage) {
    const TableRange range = bytecode.productions_of(stage);
    if (range.count == 0) {
        return {};
    }
    const std::uint32_t max_passes = stage == Stage::Decompose ? bytecode.settings.decompose_depth
                                                               : bytecode.settings.interpret_depth;
    const std::optional<std::uint32_t> edges = longest_path(parts_of(bytecode, range));
    const std::uint32_t needed = edges ? *edges + 1 : max_passes + 1;
    return {std::min(needed, max_passes),
            needed > max_passes && bytecode.settings.at_depth == AtDepth::Error};
}

} // namespace lsys
