// SPDX-License-Identifier: MIT
// MarkerSearch: the place of a word that a marker belongs to. Made by SpaceEnvironment for each
// word; its header comment (space.cpp) defines the arithmetic. A tree with four children a node:
// bounds are computed four at once in binary32, and leave out only places that are too far away or
// look elsewhere by more than all rounding errors.
#pragma once

#include "runtime/environment/environment.h"
#include "runtime/environment/impl/frame.h"
#include "runtime/environment/impl/wide_tree.h"

#include <cstdint>
#include <span>

namespace lsys {

inline constexpr std::uint32_t kNoPlace = ~std::uint32_t{0};
inline constexpr std::uint32_t kKilled = kNoPlace - 1;

/// Which markers a place sees and kills.
struct MarkerReach {
    double radius_squared = 0.0; // m^2
    double cosine = -1.0;        // cosine of half the opening of the cone of view
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
    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    /// kKilled if a place is strictly nearer to `marker` than the kill distance. Otherwise the
    /// index of the nearest place that sees it, the lowest of several; kNoPlace if there is none.
    /// `hint` is the result for a marker nearby, or kNoPlace: only the time depends on it.
    [[nodiscard]] std::uint32_t find(const Vector3& marker, std::uint32_t hint) const;

    /// Bytes over so many places while it is made.
    [[nodiscard]] static std::uint64_t bytes(std::size_t places);

private:
    /// Children in coordinates of the frame.
    struct Node : WideNode {
        std::array<Lanes, 3> low{};  // low corner of the box of each child; in a leaf: the place
        std::array<Lanes, 3> high{}; // high corner of that box; in a leaf: the heading
    };
    class Query;

    void fill_node(Node& node, std::span<const SplitItem> items) const;
    void fill_boxes(std::span<const WideChild> children, std::span<const SplitItem> items);
    [[nodiscard]] bool sees(std::uint32_t position, const Vector3& way, double squared) const;

    std::span<const SensePlace> places_;
    MarkerReach reach_;
    Frame frame_;
    bool compares_headings_ = false; // whether the angle is tested in binary32
    LargeVector<Node> nodes_;        // the root first
};

} // namespace lsys
