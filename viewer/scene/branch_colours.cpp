// SPDX-License-Identifier: MIT
#include "viewer/scene/branch_colours.h"

#include "grammar/base/contract.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>

namespace lsys::view {

namespace {

/// Linear RGB of a hue in turns: 0 is red, 1/3 green, 2/3 blue.
glm::vec3 hue_colour(float hue, float saturation, float value) {
    const glm::vec3 turns = glm::fract(glm::vec3(hue) + glm::vec3(0.0F, 2.0F / 3.0F, 1.0F / 3.0F));
    const glm::vec3 pure = glm::clamp(glm::abs(6.0F * turns - 3.0F) - 1.0F, 0.0F, 1.0F);
    const glm::vec3 display = value * glm::mix(glm::vec3(1.0F), pure, saturation);
    return display * display; // a gamma of 2
}

/// Colour of a ramp from dark blue through green to yellow, whose lightness rises evenly. `part`: 0
/// to 1.
glm::vec3 ramp_colour(float part) {
    constexpr std::array<glm::vec3, 5> kStops = {{{0.27F, 0.13F, 0.55F},
                                                  {0.20F, 0.42F, 0.72F},
                                                  {0.13F, 0.65F, 0.55F},
                                                  {0.50F, 0.82F, 0.30F},
                                                  {0.99F, 0.91F, 0.15F}}};
    const float at = std::clamp(part, 0.0F, 1.0F) * static_cast<float>(kStops.size() - 1);
    const auto stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const glm::vec3 display =
        glm::mix(kStops[stop], kStops[stop + 1], at - static_cast<float>(stop));
    return display * display;
}

std::set<std::uint32_t> values_of(const ForestModel& model, BranchColours by) {
    std::set<std::uint32_t> values;
    for (const TreeForm& form : model.forms) {
        for (std::uint32_t i = 0; i < form.cache->instances.size(); ++i) {
            values.insert(branch_value(by, *form.cache, i));
        }
    }
    return values;
}

} // namespace

std::uint32_t branch_value(BranchColours by, const InstanceCache& cache, std::uint32_t instance) {
    const Instance& branch = cache.instances[instance];
    switch (by) {
    case BranchColours::Id:
        return cache.slots[branch.slot].id;
    case BranchColours::Age:
        return cache.slots[branch.slot].age;
    case BranchColours::Hero:
        return branch.hero;
    case BranchColours::Natural:
        break;
    }
    LSYS_CHECK(false);
    return 0;
}

glm::vec3 branch_colour(BranchColours by, std::uint32_t value, std::uint32_t last) {
    LSYS_CHECK(by != BranchColours::Natural);
    if (by == BranchColours::Age) {
        return ramp_colour(last == 0 ? 0.0F : static_cast<float>(value) / static_cast<float>(last));
    }
    // Hues are multiples of the golden ratio, so those of consecutive numbers differ much;
    // lightness distinguishes numbers with similar hues.
    constexpr double kGolden = 0.6180339887498949;
    const double turns = 0.07 + kGolden * static_cast<double>(value);
    const auto hue = static_cast<float>(turns - std::floor(turns));
    return hue_colour(hue, value % 2 == 0 ? 0.75F : 0.6F, value % 3 == 1 ? 0.7F : 0.95F);
}

std::vector<LegendEntry> legend_of(const ForestModel& model, BranchColours by) {
    std::vector<LegendEntry> legend;
    if (by == BranchColours::Natural) {
        return legend;
    }
    const std::set<std::uint32_t> values = values_of(model, by);
    for (const std::uint32_t value : values) {
        legend.push_back({value, branch_colour(by, value, *values.rbegin())});
    }
    return legend;
}

} // namespace lsys::view
