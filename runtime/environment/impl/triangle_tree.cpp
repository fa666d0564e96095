// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/triangle_tree.h"

#include "runtime/environment/impl/orientation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

float rounded_down(double value) {
    constexpr auto kMax = static_cast<double>(std::numeric_limits<float>::max());
    if (value > kMax) {
        return std::numeric_limits<float>::max();
    }
    if (value < -kMax) {
        return -std::numeric_limits<float>::infinity();
    }
    const auto nearest = static_cast<float>(value);
    return static_cast<double>(nearest) <= value
               ? nearest
               : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

float rounded_up(double value) {
    return -rounded_down(-value);
}

/// orientation(a, b, q) with q = p + (e, e^2), for a positive number e that is smaller than any
/// other: not 0 if a and b differ, because q is on no line through two different points.
int perturbed_orientation(const Vector2& a, const Vector2& b, const Vector2& p) {
    if (const int sign = orientation(a, b, p); sign != 0) {
        return sign;
    }
    // The derivatives of the cross product by the coordinates of p (Edelsbrunner & Mücke 1990,
    // "Simulation of simplicity").
    const auto sign_of = [](double x, double y) { return x > y ? 1 : x < y ? -1 : 0; };
    const int first = sign_of(a[1], b[1]);
    return first != 0 ? first : sign_of(b[0], a[0]);
}

} // namespace

TriangleTree::TriangleTree(const EnvironmentMesh& mesh, const EnvironmentContext& context)
    : mesh_(mesh), closure_(mesh_closure(mesh, context.cancelled)),
      nearest_triangle_(mesh.vertices) {
    order_triangles(context);
    if (!nodes_.empty()) {
        fill_boxes();
    }
}

void TriangleTree::order_triangles(const EnvironmentContext& context) {
    LargeVector<SplitItem> items;
    items.reserve(mesh_.triangles.size());
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
        const std::array<std::uint32_t, 3>& corners = mesh_.triangles[i];
        const Triangle triangle{mesh_.vertices[corners[0]], mesh_.vertices[corners[1]],
                                mesh_.vertices[corners[2]]};
        if (area_vector(triangle) == Vector3{}) {
            continue;
        }
        SplitItem item;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            item.centre[axis] =
                centre_coordinate((triangle.a[axis] + triangle.b[axis] + triangle.c[axis]) / 3.0);
        }
        item.index = static_cast<std::uint32_t>(i);
        items.push_back(item);
    }
    if (items.empty()) {
        return;
    }
    const LargeVector<SplitNode> split =
        build_split_tree(items, kTrianglesPerLeaf, *context.workers, context.cancelled);
    if (split.empty()) { // cancelled
        return;
    }
    triangles_.resize(items.size());
    for (std::size_t at = 0; at < items.size(); ++at) {
        triangles_[at] = {mesh_.triangles[items[at].index], items[at].index};
    }
    nodes_.resize(split.size());
    for (std::size_t i = 0; i < split.size(); ++i) {
        const SplitNode& node = split[i];
        nodes_[i].begin = node.second == 0 ? node.begin : node.second;
        nodes_[i].count = node.second == 0 ? node.end - node.begin : 0;
    }
    nearest_triangle_.build(triangles_, split, *context.workers);
}

void TriangleTree::fill_boxes() {
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& node = nodes_[i];
        if (node.count == 0) {
            const Node& first = nodes_[i + 1];
            const Node& second = nodes_[node.begin];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.low[axis] = std::min(first.low[axis], second.low[axis]);
                node.high[axis] = std::max(first.high[axis], second.high[axis]);
            }
            continue;
        }
        node.low.fill(std::numeric_limits<float>::infinity());
        node.high.fill(-std::numeric_limits<float>::infinity());
        for (std::size_t at = node.begin; at < node.begin + node.count; ++at) {
            for (const std::uint32_t vertex : triangles_[at].vertices) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double coordinate = mesh_.vertices[vertex][axis];
                    node.low[axis] = std::min(node.low[axis], rounded_down(coordinate));
                    node.high[axis] = std::max(node.high[axis], rounded_up(coordinate));
                }
            }
        }
    }
}

Triangle TriangleTree::triangle(std::size_t at) const {
    const std::array<std::uint32_t, 3>& corners = triangles_[at].vertices;
    return {mesh_.vertices[corners[0]], mesh_.vertices[corners[1]], mesh_.vertices[corners[2]]};
}

int TriangleTree::crossing(std::size_t at, const Vector3& place, bool upwards) const {
    const Triangle t = triangle(at);
    const auto is_beside = [&](std::size_t axis) {
        return std::min({t.a[axis], t.b[axis], t.c[axis]}) > place[axis] ||
               std::max({t.a[axis], t.b[axis], t.c[axis]}) < place[axis];
    };
    if (is_beside(1) || is_beside(2)) {
        return 0;
    }
    const auto flat = [](const Vector3& point) { return Vector2{point[1], point[2]}; };
    const Vector2 p = flat(place);
    const int side = perturbed_orientation(flat(t.a), flat(t.b), p);
    if (side == 0 || side != perturbed_orientation(flat(t.b), flat(t.c), p) ||
        side != perturbed_orientation(flat(t.c), flat(t.a), p)) {
        return 0;
    }
    const int towards = upwards ? 1 : -1;
    if (orientation(t.a, t.b, t.c, place) != side * towards) {
        return 0;
    }
    const bool turned = !closure_.turned.empty() && closure_.turned[triangles_[at].index] != 0;
    return turned ? -side * towards : side * towards;
}

bool TriangleTree::is_inside(const Vector3& place) const {
    const auto is_beside = [&](const Node& node, std::size_t axis) {
        return place[axis] < static_cast<double>(node.low[axis]) ||
               place[axis] > static_cast<double>(node.high[axis]);
    };
    if (!closure_.closed || is_beside(nodes_[0], 0)) {
        return false;
    }
    // Shoot the ray towards the nearer end of the mesh's box along X, so that it meets fewer nodes.
    const double middle =
        0.5 * (static_cast<double>(nodes_[0].low[0]) + static_cast<double>(nodes_[0].high[0]));
    const bool upwards = place[0] > middle;
    int winding = 0;
    unsigned crossings = 0;
    std::array<std::uint32_t, kMaxSplitDepth> open{};
    std::size_t open_count = 1;
    while (open_count > 0) {
        const std::uint32_t index = open[--open_count];
        const Node& node = nodes_[index];
        if (is_beside(node, 1) || is_beside(node, 2) ||
            (upwards ? static_cast<double>(node.high[0]) < place[0]
                     : static_cast<double>(node.low[0]) > place[0])) {
            continue;
        }
        if (node.count == 0) {
            open[open_count++] = node.begin;
            open[open_count++] = index + 1;
            continue;
        }
        for (std::size_t at = node.begin; at < node.begin + node.count; ++at) {
            const int side = crossing(at, place, upwards);
            winding += side;
            crossings += side != 0 ? 1 : 0;
        }
    }
    // A closed surface with one side only (Klein's bottle) has no winding number: a place is inside
    // if the number of crossings is odd.
    return closure_.orientable ? winding != 0 : crossings % 2 == 1;
}

std::uint64_t TriangleTree::bytes(const EnvironmentMesh& mesh) {
    // The max of two stages: edges and the order of vertices; then items, nodes and corners. Bytes
    // per triangle, with the buffer of a merge sort.
    constexpr std::uint64_t kEdgeBytes = 3 * 16 * 3 / 2;
    constexpr std::uint64_t kTurnedBytes = 9;
    constexpr std::uint64_t kTreeBytes =
        sizeof(SplitItem) + sizeof(LeafTriangle) + (sizeof(SplitNode) + sizeof(Node)) / 2;
    const std::size_t count = mesh.triangles.size();
    return std::max(count * (kEdgeBytes + kTurnedBytes),
                    count * kTreeBytes + NearestTriangle::bytes(count)) +
           mesh.vertices.size() * 2 * sizeof(std::uint32_t);
}

} // namespace lsys
