// Domination: a forest that grows and thins itself, year by year, after Deussen et al. 1998,
// "Realistic modeling and rendering of plant ecosystems", section 4.1. Every plant has a circle of
// influence that grows. Where two circles meet the weaker plant is dominated: it is stunted, and
// dies when it has been too long. Plants that are not dominated have seeds, and die of age. No rule
// says how many plants there are for their size; the law of self-thinning (Yoda et al. 1963) comes
// out.
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
    float radius = 0.0F;       // m, of influence
    float vigour = 1.0F;       // 0 to 1: of growth and strength
    float stress = 0.0F;       // from 0; the plant dies at 1
    std::uint32_t number = 0;  // of its tree, in the order in which plants sprouted
    std::uint16_t species = 0; // in PlacementOptions::species
    std::uint16_t age = 0;     // years; 1 in that in which it sprouted
    bool dominated = false;    // a circle of a stronger plant meets its own
};
static_assert(sizeof(ForestPlant) <= 32);

class Domination {
public:
    /// Year 0: `options.count` plants in their first year, at uniform places. Options other than
    /// key, region, species, count and threads are not read. `terrain` must outlive the value.
    /// Error: as of place_trees().
    [[nodiscard]] static Result<Domination> begin(const PlacementOptions& options,
                                                  const Terrain& terrain);

    /// One year: seeds, growth, domination, death. Time is about linear in the plants. The same for
    /// any number of threads. Error: more than kMaxTrees plants and seeds, more numbers than 32
    /// bits hold, or the end of kMaxYears; the forest is then as it was.
    [[nodiscard]] Result<Done> step();

    [[nodiscard]] std::uint32_t year() const { return year_; }
    /// The living, by number. No two circles of plants that are not dominated meet.
    [[nodiscard]] const LargeVector<ForestPlant>& plants() const { return plants_; }
    /// The living as trees, in the same order. A tree's scale is that drawn for it times its radius
    /// by that of a plant of its age and full vigour that was never dominated.
    [[nodiscard]] LargeVector<Tree> trees() const;
    [[nodiscard]] const PlacementReport& report() const { return report_; }

private:
    Domination(const PlacementOptions& options, const Terrain& terrain);

    PlacementOptions options_;
    const Terrain* terrain_;
    std::uint32_t year_ = 0;
    std::uint32_t next_number_ = 0;
    LargeVector<ForestPlant> plants_;
    /// Radius at each age, of each species, in the open and of full vigour.
    std::vector<std::vector<float>> open_radii_;
    PlacementReport report_;
};

} // namespace lsys
