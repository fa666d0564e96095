// SPDX-License-Identifier: MIT
// Colours that distinguish the branches of a forest by id, age or hero (docs/language.md section
// 9). An id or a hero has the same colour in every forest; the colour of an age depends on the
// greatest age in the forest. Colours are the same on every machine.
#pragma once

#include "viewer/scene/forest_model.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace lsys::view {

enum class BranchColours : std::uint8_t {
    Natural, // colours of the materials
    Id,      // id of the branch in its grammar; 0: the axiom
    Age,     // age of the word in which the branch was written
    Hero,    // number of the hero from which the branch was cut
};

struct LegendEntry {
    std::uint32_t value = 0; // id, age or number of the hero
    glm::vec3 colour{};      // linear RGB

    friend bool operator==(const LegendEntry&, const LegendEntry&) = default;
};

/// The id, age or hero of an instance, as `by` selects. Precondition: `by` is not Natural.
[[nodiscard]] std::uint32_t
branch_value(BranchColours by, const InstanceCache& cache, std::uint32_t instance);

/// Colour of a value as linear RGB. Consecutive ids and heroes have very different hues; the
/// colours of ages go from dark blue through green to yellow. `last`: the greatest age.
/// Precondition: `by` is not Natural.
[[nodiscard]] glm::vec3 branch_colour(BranchColours by, std::uint32_t value, std::uint32_t last);

/// Colours of all branches of the heroes, sorted by value. Empty for Natural.
[[nodiscard]] std::vector<LegendEntry> legend_of(const ForestModel& model, BranchColours by);

} // namespace lsys::view
