// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/triangulate.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lsys {

namespace {

// Coordinates are scaled to 0 ... 1 first; an area below this is a rounding error.
constexpr double kFlat = 1e-13;
// Min number of corners for which an index is used: with fewer, comparing an ear with all corners
// is faster.
constexpr std::uint32_t kIndexedFrom = 64;
// Approximate max number of corners visited in rounds that find no ear. After that, corners are cut
// off without a search for ears.
constexpr std::uint32_t kSearches = 400'000;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Twice the area of a triangle, positive if it is counter-clockwise.
double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return cross(b - a, c - a);
}

std::uint32_t spread_bits(std::uint32_t x) {
    x = (x | (x << 8)) & 0x00FF00FFu;
    x = (x | (x << 4)) & 0x0F0F0F0Fu;
    x = (x | (x << 2)) & 0x33333333u;
    return (x | (x << 1)) & 0x55555555u;
}

/// Morton number of a point of the unit square; increases with both coordinates.
std::uint32_t order_of(const glm::dvec2& point) {
    const auto bits = [](double x) { return spread_bits(static_cast<std::uint32_t>(x * 32767.0)); };
    return bits(point.x) | (bits(point.y) << 1);
}

/// Whether `direction` lies in the angle, below 180 degrees, from `from` counter-clockwise to `to`.
bool inside(const glm::dvec2& direction, const glm::dvec2& from, const glm::dvec2& to) {
    return cross(from, direction) > 0.0 && cross(direction, to) > 0.0;
}

/// Whether the lines a b and c d cross.
bool cross_each_other(const glm::dvec2& a,
                      const glm::dvec2& b,
                      const glm::dvec2& c,
                      const glm::dvec2& d) {
    return (area(a, b, c) > 0.0) != (area(a, b, d) > 0.0) &&
           (area(c, d, a) > 0.0) != (area(c, d, b) > 0.0);
}

} // namespace

/// Scales the corners to the unit square and links them in a counter-clockwise ring.
void Triangulator::load(std::span<const glm::dvec2> corners) {
    nodes_.clear();
    remaining_ = 0;
    if (corners.empty()) {
        return;
    }
    glm::dvec2 low = corners.front();
    glm::dvec2 high = low;
    for (const glm::dvec2& corner : corners) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    const double extent = std::max(high.x - low.x, high.y - low.y);
    if (!(extent > 0.0)) {
        return;
    }
    double twice_area = 0.0;
    nodes_.resize(corners.size());
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        nodes_[i].at = (corners[i] - low) / extent;
        nodes_[i].corner = i;
        if (i > 0) {
            twice_area += area(nodes_[0].at, nodes_[i - 1].at, nodes_[i].at);
        }
    }
    const auto count = static_cast<std::uint32_t>(nodes_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        nodes_[i].next = i + 1 < count ? i + 1 : 0;
        nodes_[i].previous = i > 0 ? i - 1 : count - 1;
        if (twice_area < 0.0) {
            std::swap(nodes_[i].next, nodes_[i].previous);
        }
    }
    remaining_ = count;
}

/// Twice the area of the triangle at a corner; positive if the corner is convex.
double Triangulator::turn(std::uint32_t node) const {
    const Node& own = nodes_[node];
    return area(nodes_[own.previous].at, own.at, nodes_[own.next].at);
}

/// Whether all corners turn left and the outline goes around once.
bool Triangulator::is_convex() const {
    int changes = 0;
    bool was_right = false;
    bool known = false;
    std::uint32_t node = 0;
    // The loop visits the first edge twice, to compare it with the last edge.
    for (std::uint32_t i = 0; i <= remaining_; ++i, node = nodes_[node].next) {
        if (turn(node) < 0.0) {
            return false;
        }
        const double dx = nodes_[nodes_[node].next].at.x - nodes_[node].at.x;
        if (dx != 0.0) {
            changes += known && was_right != (dx > 0.0) ? 1 : 0;
            was_right = dx > 0.0;
            known = true;
        }
    }
    return changes <= 2;
}

void Triangulator::append_fan(std::vector<std::uint32_t>& triangles) const {
    const std::uint32_t first = 0;
    for (std::uint32_t b = nodes_[first].next; nodes_[b].next != first; b = nodes_[b].next) {
        const std::uint32_t c = nodes_[b].next;
        if (area(nodes_[first].at, nodes_[b].at, nodes_[c].at) > kFlat) {
            triangles.insert(triangles.end(), {first, b, c});
        }
    }
}

void Triangulator::index_nodes() {
    sorted_.resize(nodes_.size());
    std::iota(sorted_.begin(), sorted_.end(), 0U);
    for (Node& node : nodes_) {
        node.order = order_of(node.at);
    }
    std::sort(sorted_.begin(), sorted_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return nodes_[a].order != nodes_[b].order ? nodes_[a].order < nodes_[b].order : a < b;
    });
    for (std::size_t i = 0; i < sorted_.size(); ++i) {
        nodes_[sorted_[i]].lower = i > 0 ? sorted_[i - 1] : kNone;
        nodes_[sorted_[i]].higher = i + 1 < sorted_.size() ? sorted_[i + 1] : kNone;
    }
}

void Triangulator::remove(std::uint32_t node) {
    const Node& own = nodes_[node];
    nodes_[own.previous].next = own.next;
    nodes_[own.next].previous = own.previous;
    if (own.lower != kNone) {
        nodes_[own.lower].higher = own.higher;
    }
    if (own.higher != kNone) {
        nodes_[own.higher].lower = own.lower;
    }
    --remaining_;
}

/// Whether the corner `node` blocks `ear`: it is reflex and lies within the triangle of the ear. A
/// corner that coincides with a corner of the triangle blocks if one of its edges leads into the
/// triangle.
bool Triangulator::is_blocked_by(std::uint32_t node, std::uint32_t ear) const {
    const Node& own = nodes_[ear];
    if (node == ear || node == own.previous || node == own.next) {
        return false;
    }
    const glm::dvec2& a = nodes_[own.previous].at;
    const glm::dvec2& b = own.at;
    const glm::dvec2& c = nodes_[own.next].at;
    const glm::dvec2& p = nodes_[node].at;
    if (area(a, b, p) < 0.0 || area(b, c, p) < 0.0 || area(c, a, p) < 0.0 || turn(node) > 0.0) {
        return false;
    }
    const glm::dvec2 from = nodes_[nodes_[node].previous].at - p;
    const glm::dvec2 to = nodes_[nodes_[node].next].at - p;
    if (p == a) {
        return inside(from, b - a, c - a) || inside(to, b - a, c - a);
    }
    if (p == b) {
        return inside(from, c - b, a - b) || inside(to, c - b, a - b);
    }
    if (p == c) {
        return inside(from, a - c, b - c) || inside(to, a - c, b - c);
    }
    return true;
}

bool Triangulator::is_ear(std::uint32_t node) const {
    const Node& own = nodes_[node];
    if (turn(node) <= 0.0) {
        return false;
    }
    if (!indexed_) {
        for (std::uint32_t p = nodes_[own.next].next; p != own.previous; p = nodes_[p].next) {
            if (is_blocked_by(p, node)) {
                return false;
            }
        }
        return true;
    }
    const glm::dvec2& a = nodes_[own.previous].at;
    const glm::dvec2& c = nodes_[own.next].at;
    const glm::dvec2 low = glm::min(glm::min(a, own.at), c);
    const glm::dvec2 high = glm::max(glm::max(a, own.at), c);
    const std::uint32_t first = order_of(low);
    const std::uint32_t last = order_of(high);
    // Searches in both directions of the Morton order at once, because blocking corners are near.
    std::uint32_t down = own.lower;
    std::uint32_t up = own.higher;
    const auto blocks = [&](std::uint32_t p) {
        const glm::dvec2& at = nodes_[p].at;
        return at.x >= low.x && at.x <= high.x && at.y >= low.y && at.y <= high.y &&
               is_blocked_by(p, node);
    };
    while (true) {
        const bool goes_down = down != kNone && nodes_[down].order >= first;
        const bool goes_up = up != kNone && nodes_[up].order <= last;
        if (!goes_down && !goes_up) {
            return true;
        }
        if ((goes_down && blocks(down)) || (goes_up && blocks(up))) {
            return false;
        }
        down = goes_down ? nodes_[down].lower : kNone;
        up = goes_up ? nodes_[up].higher : kNone;
    }
}

/// Removes `node`; adds its triangle unless it is flat.
void Triangulator::cut(std::uint32_t node, std::vector<std::uint32_t>& triangles) {
    if (turn(node) > kFlat) {
        triangles.insert(triangles.end(), {nodes_[nodes_[node].previous].corner,
                                           nodes_[node].corner, nodes_[nodes_[node].next].corner});
    }
    remove(node);
}

/// Cuts off the small triangle where the edges before and after an edge cross.
std::uint32_t Triangulator::cut_small_crossings(std::uint32_t start,
                                                std::vector<std::uint32_t>& out) {
    std::uint32_t node = start;
    for (std::uint32_t i = 0, count = remaining_; i < count && remaining_ > 4; ++i) {
        const std::uint32_t a = nodes_[node].previous;
        const std::uint32_t after = nodes_[node].next;
        const std::uint32_t b = nodes_[after].next;
        if (nodes_[a].at != nodes_[b].at &&
            cross_each_other(nodes_[a].at, nodes_[node].at, nodes_[after].at, nodes_[b].at)) {
            cut(node, out);
            cut(after, out);
            node = b;
        }
        node = nodes_[node].next;
    }
    return node;
}

/// Cuts off the next convex corner of a ring without ears.
std::uint32_t Triangulator::cut_convex_corner(std::uint32_t start,
                                              std::vector<std::uint32_t>& out) {
    std::uint32_t node = start;
    for (std::uint32_t i = 0; i < remaining_ && turn(node) <= kFlat; ++i) {
        node = nodes_[node].next;
    }
    const std::uint32_t next = nodes_[node].next;
    cut(node, out);
    return next;
}

/// Cuts off corners, ears if there are any, until two are left.
void Triangulator::clip(std::vector<std::uint32_t>& triangles) {
    indexed_ = remaining_ >= kIndexedFrom;
    if (indexed_) {
        index_nodes();
    }
    const std::uint32_t max_failed_rounds = 2 + kSearches / remaining_;
    std::uint32_t node = 0;
    std::uint32_t failed_rounds = 0;     // rounds without an ear
    std::uint32_t corners_since_ear = 0; // corners seen since the last ear
    while (remaining_ > 2) {
        const std::uint32_t after = nodes_[node].next;
        if (nodes_[node].at == nodes_[after].at || turn(node) == 0.0) {
            // Removes a corner that is collinear with its neighbours or coincides with one of them.
            remove(node);
            node = nodes_[node].previous;
            corners_since_ear = 0;
        } else if (failed_rounds >= max_failed_rounds) {
            node = cut_convex_corner(node, triangles);
        } else if (is_ear(node)) {
            cut(node, triangles);
            node = nodes_[after].next; // skipping a corner makes better triangles than a fan
            corners_since_ear = 0;
        } else if (++corners_since_ear <= remaining_) {
            node = after;
        } else {
            const std::uint32_t before = remaining_;
            node = cut_small_crossings(node, triangles);
            node = remaining_ == before ? cut_convex_corner(node, triangles) : node;
            corners_since_ear = 0;
            ++failed_rounds;
        }
    }
}

void Triangulator::append(std::span<const glm::dvec2> corners,
                          std::vector<std::uint32_t>& triangles) {
    load(corners);
    if (remaining_ < 3) {
        return;
    }
    if (is_convex()) {
        append_fan(triangles);
    } else {
        clip(triangles);
    }
}

} // namespace lsys
