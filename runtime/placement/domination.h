// SPDX-License-Identifier: MIT
// Domination: simulates a forest that grows and thins itself, year by year, after Deussen et al. 1998,
// "Realistic modeling and rendering of plant ecosystems", section 4.1. Every plant has a growing
// circle of influence. If two circles overlap, the weaker plant is dominated: it grows less, has no
// seeds, and dies if it is dominated too long. Every plant dies of age in the end. No rule relates
// the number of plants to their size; the law of self-thinning (Yoda et al. 1963) emerges.
#pragma once

#include "grammar/base/result.h"
#include "runtime/base/large_vector.h"
#include "runtime/placement/placement.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace lsys {

struct ForestPlant {
    glm::vec2 place{};         // m, x and z
    float radius = 0.0F;       // m, radius of influence
    float vigour = 1.0F;       // 0 to 1, factor of growth and strength
    float stress = 0.0F;       // 0 to 1; the plant dies at 1
    std::uint32_t number = 0;  // number of the tree, in the order of sprouting
    std::uint16_t species = 0; // index in PlacementOptions::species
    std::uint16_t age = 0;     // years; 1 in the year of sprouting
    bool dominated = false;    // its circle overlaps the circle of a stronger plant
};
static_assert(sizeof(ForestPlant) <= 32);

class TreeMaker; // runtime/placement/impl/tree_maker.h

class Domination {
public:
    /// Starts in year 0 with `options.count` plants in their first year, at uniformly distributed
    /// places. Of `options` it uses only key, region, species, count and threads. `terrain` must
    /// outlive the result. Errors: as place_trees().
    [[nodiscard]] static Result<Domination> begin(const PlacementOptions& options,
                                                  const Terrain& terrain);

    /// Simulates one year: seeds, growth, domination, death. Time is about linear in the number of
    /// plants. The result is the same for any number of threads. Errors: more than kMaxTrees plants
    /// and seeds, more plant numbers than 32 bits hold, more than kMaxYears years. After an error
    /// the forest is unchanged.
    [[nodiscard]] Result<void> step();

    [[nodiscard]] std::uint32_t year() const { return year_; }
    /// The living plants by number. The circles of plants that are not dominated do not overlap.
    [[nodiscard]] const LargeVector<ForestPlant>& plants() const { return plants_; }
    /// The living plants as trees, in the same order. The scale of a tree is its random scale times
    /// the ratio of its radius to the radius that a plant of the same age and full vigour has if it
    /// was never dominated. A plant of year 0 may start at a later stage: the age of its tree is
    /// then greater by the years of the skipped stages. Seedlings start at the first stage.
    [[nodiscard]] LargeVector<Tree> trees() const;
    [[nodiscard]] const PlacementReport& report() const { return report_; }

private:
    Domination(const PlacementOptions& options, const Terrain& terrain);
    /// Age of the tree: includes the years of the stages that a plant of year 0 skipped.
    [[nodiscard]] std::uint16_t age_of(const ForestPlant& plant, const TreeMaker& maker) const;

    PlacementOptions options_;
    const Terrain* terrain_;
    std::uint32_t year_ = 0;
    std::uint32_t next_number_ = 0; // number of the next seedling
    LargeVector<ForestPlant> plants_;
    /// Radius by species and age of a plant of full vigour that was never dominated.
    std::vector<std::vector<float>> undominated_radii_;
    PlacementReport report_;
};

} // namespace lsys
