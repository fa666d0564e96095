// SPDX-License-Identifier: MIT
// Triangulates a flat polygon, concave or not, by ear clipping. Corners are indexed in Morton
// order, so that an ear is compared only with corners near to it (the method of mapbox/earcut,
// after Held 2001, "FIST: Fast Industrial-Strength Triangulation of Polygons", section 3.4). A
// convex polygon becomes a fan.
//
// The triangles of a polygon that crosses itself are valid but may overlap.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// Reuses its memory from one polygon to the next.
class Triangulator {
public:
    /// Appends three corner numbers per triangle, counter-clockwise. Precondition: finite
    /// coordinates. Each triangle has an area larger than rounding errors.
    void append(std::span<const glm::dvec2> corners, std::vector<std::uint32_t>& triangles);

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

    /// A corner that is not cut off yet, in the ring of corners and in a list sorted by `order`.
    struct Node {
        glm::dvec2 at{};
        std::uint32_t corner = 0;
        std::uint32_t previous = kNone;
        std::uint32_t next = kNone;
        std::uint32_t order = 0;     // interleaved bits of the coordinates
        std::uint32_t lower = kNone; // neighbours in the list sorted by `order`
        std::uint32_t higher = kNone;
    };

    [[nodiscard]] bool is_convex() const; // of the whole ring
    /// Twice the area of the triangle at a corner; > 0: convex.
    [[nodiscard]] double turn(std::uint32_t node) const;
    /// Whether the corner `node` lies in the triangle of `ear`, so that the ear cannot be cut off.
    [[nodiscard]] bool is_blocked_by(std::uint32_t node, std::uint32_t ear) const;
    [[nodiscard]] bool is_ear(std::uint32_t node) const; // may be cut off
    /// Fills the ring with the corners, scaled to the unit square.
    void load(std::span<const glm::dvec2> corners);
    void append_fan(std::vector<std::uint32_t>& triangles) const; // triangles of a convex ring
    void index_nodes();              // makes the list sorted by `order`
    void remove(std::uint32_t node); // from the ring and the list
    /// Cuts off small triangles where the edges before and after an edge cross.
    std::uint32_t cut_small_crossings(std::uint32_t start, std::vector<std::uint32_t>& out);
    /// Cuts off the next convex corner of a ring without ears.
    std::uint32_t cut_convex_corner(std::uint32_t start, std::vector<std::uint32_t>& out);
    /// Removes the node and adds its triangle, unless flat.
    void cut(std::uint32_t node, std::vector<std::uint32_t>& triangles);
    void clip(std::vector<std::uint32_t>& triangles); // cuts off corners until two are left

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> sorted_; // nodes by ascending Node::order
    bool indexed_ = false;              // nodes are in the list sorted by `order`
    std::uint32_t remaining_ = 0;       // nodes in the ring
};

} // namespace lsys
