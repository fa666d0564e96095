// SPDX-License-Identifier: MIT
// Finds dominated plants: plants whose circle overlaps the circle of a stronger plant.
#pragma once

#include "runtime/base/workers.h"
#include "runtime/placement/domination.h"

#include <span>

namespace lsys {

/// Whether `a` is stronger than `b`: its product of radius and vigour is greater or, with equal
/// products, it sprouted first.
[[nodiscard]] inline bool is_stronger(const ForestPlant& a, const ForestPlant& b) {
    const float strength_a = a.radius * a.vigour;
    const float strength_b = b.radius * b.vigour;
    return strength_a > strength_b || (strength_a == strength_b && a.number < b.number);
}

[[nodiscard]] inline bool circles_overlap(const ForestPlant& a, const ForestPlant& b) {
    const auto dx = static_cast<double>(a.place.x - b.place.x);
    const auto dz = static_cast<double>(a.place.y - b.place.y);
    const double reach = static_cast<double>(a.radius) + static_cast<double>(b.radius);
    return dx * dx + dz * dz < reach * reach;
}

/// Sets ForestPlant::dominated of each plant.
void find_dominated(const Region& region, std::span<ForestPlant> plants, Workers& workers);

} // namespace lsys
