// SPDX-License-Identifier: MIT
// TreeMaker: makes a tree from a place and a number. Chooses species, yaw and scale.
#pragma once

#include "runtime/base/random.h"
#include "runtime/base/workers.h"
#include "runtime/placement/placement.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace lsys {

/// The trees of one piece of work.
struct TreeChunk {
    std::vector<Tree> trees;
    std::uint64_t places = 0;  // as PlacementReport::places
    std::uint64_t refused = 0; // as PlacementReport::refused
};

class TreeMaker {
public:
    TreeMaker(const PlacementOptions& options, const Terrain& terrain);

    /// Adds the tree `number` at a place, or counts it as refused if no species can live there.
    void make(std::uint32_t number, float x, float z, TreeChunk& chunk) const;
    /// Whether `species` can live at a place.
    [[nodiscard]] bool can_live(std::uint16_t species, float x, float z) const;
    /// Sets shares[s] to the probability that a place has a tree of species s.
    void shares_at(float x, float z, std::span<double> shares) const;
    /// The tree `number` of a given species, without position. Its age is set as for all methods
    /// except Domination.
    [[nodiscard]] Tree appearance_of(std::uint32_t number, std::uint16_t species) const;
    /// The stage at which the tree `number` starts.
    [[nodiscard]] std::uint32_t start_of(std::uint32_t number, std::uint16_t species) const;

private:
    static constexpr std::uint32_t kNoSpecies = 0xFFFFFFFFu;

    [[nodiscard]] std::uint32_t
    choose_species(std::uint32_t word, float x, float height, float z) const;
    [[nodiscard]] Tree
    make_appearance(std::uint32_t number, std::uint16_t species, const PhiloxBlock& words) const;

    const PlacementOptions& options_;
    const Terrain& terrain_;
    double total_share_ = 0.0;  // sum over all species
    bool has_limits_ = false;   // whether limits keep some species out of some places
    bool has_steepest_ = false; // whether some species has a max slope
};

/// Appends the trees of the pieces 0 to `pieces` - 1, in this order, and adds up their reports.
/// Never stores more than a few pieces besides `placement`.
void collect_trees(Workers& workers,
                   std::uint64_t pieces,
                   const std::function<void(std::uint64_t, TreeChunk&)>& piece,
                   Placement& placement);

} // namespace lsys
