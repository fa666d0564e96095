// SPDX-License-Identifier: MIT
// Forest: species with their instance caches, and trees as small records. Branches of a tree are
// computed on demand and not stored.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/forest/instance_cache.h"
#include "runtime/forest/tree.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lsys {

/// Plants of one species with the same number of generations and, if the species senses its
/// surroundings, with the same surroundings.
struct ForestStage {
    std::uint32_t generations = 0; // generations of each plant
    InstanceCache cache;
    /// Radius in m of the crowns of plants of scale 1 without neighbours; 0 unless the species
    /// senses its surroundings.
    double crown_radius = 0.0;
    /// Mean height in m of the trees numbered 0 to 15 at scale 1, without neighbours; 0 unless some
    /// species of the forest senses its surroundings.
    double plant_height = 0.0;
};

struct ForestSpecies {
    std::string name;
    /// By ascending generations; at least one. If the species senses its surroundings, each number
    /// of generations has kSurroundings stages, in the order of Surroundings.
    std::vector<ForestStage> stages;
    bool senses_surroundings = false; // see surroundings.h
    /// Years between two stages; 0: all plants have the last stage.
    float years_of_stage = 0.0F;
    /// Height in m of tree 0 of the last stage at scale 1, from the grammar's `#set height`; 0: not
    /// set.
    float height = 0.0F;

    /// Number of stages for each number of generations.
    [[nodiscard]] std::uint32_t cases() const { return senses_surroundings ? kSurroundings : 1; }
    /// The stage of full-grown plants, without neighbours if the species senses its surroundings.
    [[nodiscard]] const ForestStage& last_stage() const { return stages[stages.size() - cases()]; }
};

/// Name that distinguishes a stage from the other stages of its species: "n5", "closed", "n5
/// closed"; empty if the species has one stage.
[[nodiscard]] std::string stage_name(const ForestSpecies& species, std::size_t stage);

struct Forest {
    std::uint64_t key = 0;              // seed of all choices of the trees
    std::vector<ForestSpecies> species; // by Tree::species
    LargeVector<Tree> trees;

    /// Index of the tree's stage in ForestSpecies::stages.
    [[nodiscard]] std::uint32_t stage_of(const Tree& tree) const {
        const ForestSpecies& kind = species[tree.species];
        return first_stage_of(tree) + (kind.senses_surroundings ? surroundings_of(tree) : 0);
    }
    /// Index of the first stage with the tree's number of generations.
    [[nodiscard]] std::uint32_t first_stage_of(const Tree& tree) const {
        const ForestSpecies& kind = species[tree.species];
        const auto count = static_cast<std::uint32_t>(kind.stages.size());
        const std::uint32_t last = count / kind.cases() - 1;
        if (kind.years_of_stage <= 0.0F || tree.age == 0) {
            return last * kind.cases();
        }
        const float stage = static_cast<float>(tree.age) / kind.years_of_stage;
        return kind.cases() *
               (stage >= static_cast<float>(last) ? last : static_cast<std::uint32_t>(stage));
    }
    [[nodiscard]] const InstanceCache& cache_of(const Tree& tree) const {
        return species[tree.species].stages[stage_of(tree)].cache;
    }
};

struct ForestCounts {
    std::uint64_t trees = 0;
    std::uint64_t branches = 0; // number of placed instances, with the root of each tree
    std::uint64_t segments = 0;
    std::uint64_t objects = 0;
    std::uint64_t polygons = 0;
    std::uint32_t max_branches = 0; // max branches of one tree
    /// Hash of place, rotation, scale and instance of every branch. Independent of the number of
    /// threads and the order of trees.
    std::uint64_t digest = 0;

    void add(const ForestCounts& other);
};

/// Calls visit(piece, trees) for each piece, a run of up to 4,096 trees, on several threads.
/// `piece`: number of the piece, below piece_count(). 0 threads: as many as the machine has.
void for_each_piece(const Forest& forest,
                    std::uint32_t threads,
                    const std::function<void(std::uint64_t, std::span<const Tree>)>& visit);
/// Number of pieces of for_each_piece().
[[nodiscard]] std::uint64_t piece_count(const Forest& forest);

/// Counts the branches of all trees by expanding every tree. Time is linear in the number of
/// branches, which are not stored.
[[nodiscard]] ForestCounts count_forest(const Forest& forest, std::uint32_t threads);

} // namespace lsys
