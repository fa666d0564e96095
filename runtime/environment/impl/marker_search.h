// SPDX-License-Identifier: MIT
// MarkerSearch: finds the place of a word that a marker belongs to. Made by SpaceEnvironment for
// each word; the comment at the top of space.cpp defines the arithmetic. The places are in a tree
// with four children per node, whose bounds are computed in binary32, four at once. The search
// skips only places that are too far away, or look in another direction, by more than all rounding
// errors.
#pragma once

#include "runtime/environment/environment.h"
#include "runtime/environment/impl/frame.h"
#include "runtime/environment/impl/wide_tree.h"

#include <cstdint>
#include <span>

namespace lsys {

inline constexpr std::uint32_t kNoPlace = ~std::uint32_t{0};
inline constexpr std::uint32_t kKilled = kNoPlace - 1;

/// The distances and the angle that decide which markers a place sees and kills.
struct MarkerReach {
    double radius_squared = 0.0; // m^2; markers up to this distance may be seen
    double cosine = -1.0;        // cosine of half the opening of the cone of view
    bool sees_all = false;       // places see in all directions: the angle is not compared
    double kill_squared = 0.0;   // m^2; a marker nearer than this is killed
};
[[nodiscard]] MarkerReach marker_reach(const BytecodeEnvironment& declared);

class MarkerSearch {
public:
    /// `places` outlive the search and are finite.
    MarkerSearch(std::span<const SensePlace> places,
                 const MarkerReach& reach,
                 const EnvironmentContext& context);

    /// Whether the search has no places, or its construction was cancelled. find() must then not be
    /// called.
    [[nodiscard]] bool empty() const { return nodes_.empty(); }
    /// kKilled if a place is strictly nearer to `marker` than the kill distance. Otherwise the
    /// index of the nearest place that sees the marker, of equally near places the lowest; kNoPlace
    /// if no place sees it. `hint`: the result for a marker nearby, or kNoPlace; a good hint makes
    /// the search faster.
    [[nodiscard]] std::uint32_t find(const Vector3& marker, std::uint32_t hint) const;

    /// Max bytes of a search among `places` places while it is constructed.
    [[nodiscard]] static std::uint64_t bytes(std::size_t places);

private:
    /// A node; coordinates are those of frame_.
    struct Node : WideNode {
        std::array<Lanes, 3> low{};  // low corner of the box of each child; in a leaf: the place
        std::array<Lanes, 3> high{}; // high corner of that box; in a leaf: the heading
    };
    class Query;

    /// Fills the lanes of a leaf; its children become indexes of places of the word.
    void fill_leaf(Node& node, std::span<const SplitItem> items) const;
    /// Sets the boxes of the children of nodes that are not leaves.
    void fill_boxes(std::span<const WideChild> children, std::span<const SplitItem> items);
    /// Whether a place sees a marker at the vector `way` from it. `squared`: length of `way`,
    /// squared.
    [[nodiscard]] bool sees(std::uint32_t position, const Vector3& way, double squared) const;

    std::span<const SensePlace> places_;
    MarkerReach reach_;
    double radius_ = 0.0; // m, square root of reach_.radius_squared
    double kill_ = 0.0;   // m, square root of reach_.kill_squared
    Frame frame_;
    bool compares_headings_ = false; // whether the angle is tested in binary32
    LargeVector<Node> nodes_;        // the root first
};

} // namespace lsys
