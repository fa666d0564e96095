// SPDX-License-Identifier: MIT
// MarkerSearch: the place of a word that a marker belongs to. Made by SpaceEnvironment for each
// word; its header comment (space.cpp) defines the arithmetic.
#pragma once

#include "runtime/environment/environment.h"
#include "runtime/environment/impl/point_tree.h"

#include <cstdint>
#include <span>

namespace lsys {

inline constexpr std::uint32_t kNoPlace = ~std::uint32_t{0};

/// Which markers a place sees and kills.
struct MarkerReach {
    double radius_squared = 0.0; // m^2
    double cosine = -1.0;        // of the half angle of the cone of view
    bool sees_all = false;
    double kill_squared = 0.0; // m^2
};
[[nodiscard]] MarkerReach marker_reach(const BytecodeEnvironment& declared);

class MarkerSearch {
public:
    /// `places` outlive the search and are finite.
    MarkerSearch(std::span<const SensePlace> places,
                 const MarkerReach& reach,
                 const EnvironmentContext& context);

    /// Without places, or cancelled: nothing can be found.
    [[nodiscard]] bool empty() const { return tree_.nodes.empty(); }
    /// Whether a place is strictly nearer to `marker` than the kill distance.
    [[nodiscard]] bool kills(const Vector3& marker) const;
    /// Index of the nearest place that sees the marker, the lowest of several; kNoPlace if there is
    /// none.
    [[nodiscard]] std::uint32_t find(const Vector3& marker) const;

private:
    [[nodiscard]] bool sees(std::uint32_t position, const Vector3& way, double squared) const;

    std::span<const SensePlace> places_;
    MarkerReach reach_;
    PointTree tree_;
};

} // namespace lsys
