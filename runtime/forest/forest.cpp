// SPDX-License-Identifier: MIT
#include "runtime/forest/forest.h"

#include "grammar/base/hash.h"
#include "runtime/base/workers.h"
#include "runtime/forest/surroundings.h"

#include <algorithm>
#include <bit>
#include <optional>

namespace lsys {

namespace {

constexpr std::uint64_t kTreesPerPiece = 4096;

/// Hash of a branch. The sum of the hashes of a set of branches identifies the set.
std::uint64_t digest_of(const Tree& tree, std::uint32_t node, const BranchInstance& branch) {
    const auto bits = [](float a, float b) {
        return std::uint64_t{std::bit_cast<std::uint32_t>(a)} << 32 |
               std::bit_cast<std::uint32_t>(b);
    };
    std::uint64_t mixed = golden_multiple(std::uint64_t{tree.number} << 32 | node);
    mixed = golden_multiple(mixed ^ bits(branch.position.x, branch.position.y));
    mixed = golden_multiple(mixed ^ (bits(branch.position.z, branch.scale) + (mixed >> 31)));
    mixed = golden_multiple(mixed ^ (bits(branch.rotation.w, branch.rotation.x) + (mixed >> 29)));
    mixed = golden_multiple(mixed ^ (bits(branch.rotation.y, branch.rotation.z) + (mixed >> 30)));
    return golden_multiple(mixed ^ (branch.instance + (mixed >> 32)));
}

ForestCounts count_trees(const Forest& forest, std::span<const Tree> trees) {
    ForestCounts counts;
    const InstanceCache* last = nullptr;
    std::optional<TreeExpander> expander;
    for (const Tree& tree : trees) {
        const InstanceCache& cache = forest.cache_of(tree);
        if (&cache != last) {
            expander.emplace(cache, forest.key);
            last = &cache;
        }
        std::uint32_t node = 0;
        expander->expand(tree, [&](const BranchInstance& branch) {
            const DrawnCounts& size = cache.instances[branch.instance].size;
            counts.segments += size.segments;
            counts.objects += size.objects;
            counts.polygons += size.polygons;
            counts.digest += digest_of(tree, node++, branch);
        });
        counts.branches += node;
        counts.max_branches = std::max(counts.max_branches, node);
    }
    counts.trees = trees.size();
    return counts;
}

} // namespace

std::string stage_name(const ForestSpecies& species, std::size_t stage) {
    const bool is_one_age = species.stages.size() == species.cases();
    std::string name;
    if (!is_one_age) {
        name = 'n' + std::to_string(species.stages[stage].generations);
    }
    if (species.senses_surroundings) {
        name += is_one_age ? "" : " ";
        name += kSurroundingsNames[stage % kSurroundings];
    }
    return name;
}

void ForestCounts::add(const ForestCounts& other) {
    trees += other.trees;
    branches += other.branches;
    segments += other.segments;
    objects += other.objects;
    polygons += other.polygons;
    max_branches = std::max(max_branches, other.max_branches);
    digest += other.digest;
}

std::uint64_t piece_count(const Forest& forest) {
    return (forest.trees.size() + kTreesPerPiece - 1) / kTreesPerPiece;
}

void for_each_piece(const Forest& forest,
                    std::uint32_t threads,
                    const std::function<void(std::uint64_t, std::span<const Tree>)>& visit) {
    Workers workers(threads);
    const std::span<const Tree> trees(forest.trees);
    workers.for_each(piece_count(forest), [&](std::uint64_t piece) {
        const std::uint64_t begin = piece * kTreesPerPiece;
        visit(piece, trees.subspan(begin, std::min(kTreesPerPiece, trees.size() - begin)));
    });
}

ForestCounts count_forest(const Forest& forest, std::uint32_t threads) {
    std::vector<ForestCounts> parts(piece_count(forest));
    for_each_piece(forest, threads, [&](std::uint64_t piece, std::span<const Tree> trees) {
        parts[piece] = count_trees(forest, trees);
    });
    ForestCounts counts;
    for (const ForestCounts& part : parts) {
        counts.add(part);
    }
    return counts;
}

} // namespace lsys
