// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/triangle_tree.h"

#include "runtime/environment/impl/orientation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsys {

namespace {

constexpr std::size_t kTrianglesPerLeaf = 4;

float rounded_down(double value) {
    constexpr double kMax = std::numeric_limits<float>::max();
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

Vector3 middle_of(const std::array<float, 3>& low, const std::array<float, 3>& high) {
    Vector3 middle;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        middle[axis] = 0.5 * (static_cast<double>(low[axis]) + static_cast<double>(high[axis]));
    }
    return middle;
}

/// orientation() seen from p + (e, e^2) for a positive number e that is smaller than all others:
/// never on a line through two different points.
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
    : mesh_(mesh), closure_(mesh_closure(mesh)) {
    order_triangles(context);
    if (!nodes_.empty()) {
        fill_boxes();
        fill_cylinders(*context.workers);
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
    corners_.resize(items.size());
    for (std::size_t at = 0; at < items.size(); ++at) {
        corners_[at] = {mesh_.triangles[items[at].index], items[at].index};
    }
    nodes_.resize(split.size());
    for (std::size_t i = 0; i < split.size(); ++i) {
        const SplitNode& node = split[i];
        nodes_[i].begin = node.second == 0 ? node.begin : node.second;
        nodes_[i].count = node.second == 0 ? node.end - node.begin : 0;
    }
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
            for (const std::uint32_t vertex : corners_[at].vertices) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double coordinate = mesh_.vertices[vertex][axis];
                    node.low[axis] = std::min(node.low[axis], rounded_down(coordinate));
                    node.high[axis] = std::max(node.high[axis], rounded_up(coordinate));
                }
            }
        }
    }
}

void TriangleTree::fill_cylinders(Workers& workers) {
    constexpr std::size_t kMaxTriangles = 128; // of a node with a cylinder
    constexpr std::size_t kNodes = 1U << 10;   // of one piece of work
    // The triangles of each node are those of its leaves, which are in order.
    LargeVector<std::uint32_t> ends(nodes_.size());
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        const Node& node = nodes_[i];
        ends[i] = node.count > 0 ? node.begin + node.count : ends[node.begin];
    }
    LargeVector<std::uint32_t> begins(nodes_.size());
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        begins[i] = nodes_[i].count > 0 ? nodes_[i].begin : begins[i + 1];
    }
    workers.for_each((nodes_.size() + kNodes - 1) / kNodes, [&](std::uint64_t piece) {
        const std::size_t end = std::min(nodes_.size(), (piece + 1) * kNodes);
        for (std::size_t i = piece * kNodes; i < end; ++i) {
            if (ends[i] - begins[i] <= kMaxTriangles) {
                fill_cylinder(nodes_[i], begins[i], ends[i]);
            }
        }
    });
}

void TriangleTree::fill_cylinder(Node& node, std::size_t begin, std::size_t end) const {
    Vector3 sum{};
    for (std::size_t at = begin; at < end; ++at) {
        const Vector3 area = area_vector(triangle(at));
        sum = dot(sum, area) < 0.0 ? minus(sum, area) : plus(sum, area);
    }
    node.axis = normalised(sum);
    if (!is_finite(node.axis) || node.axis == Vector3{}) {
        return;
    }
    const Vector3 middle = middle_of(node.low, node.high);
    double half_length = 0.0;
    double radius_squared = 0.0;
    double magnitude = 0.0;
    for (std::size_t at = begin; at < end; ++at) {
        for (const std::uint32_t index : corners_[at].vertices) {
            const Vector3& vertex = mesh_.vertices[index];
            const Vector3 offset = minus(vertex, middle);
            const double along = dot(node.axis, offset);
            half_length = std::max(half_length, std::abs(along));
            radius_squared = std::max(radius_squared, squared_length(offset) - along * along);
            magnitude = std::max(magnitude, squared_length(vertex));
        }
    }
    // Nearest points as computed are beside the triangle by some units in the last place of the
    // largest coordinate; the cylinder is larger by far more.
    const double more = 1e-12 * std::sqrt(magnitude);
    const auto enlarged = [&](double length) { return rounded_up(length * (1.0 + 1e-6) + more); };
    node.half_length = enlarged(half_length);
    node.radius = enlarged(std::sqrt(radius_squared) + 1e-7 * half_length);
}

Triangle TriangleTree::triangle(std::size_t at) const {
    const std::array<std::uint32_t, 3>& corners = corners_[at].vertices;
    return {mesh_.vertices[corners[0]], mesh_.vertices[corners[1]], mesh_.vertices[corners[2]]};
}

double TriangleTree::least_squared(const Node& node, const Vector3& place) {
    Vector3 apart;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        apart[axis] = std::max(std::max(static_cast<double>(node.low[axis]) - place[axis],
                                        place[axis] - static_cast<double>(node.high[axis])),
                               0.0);
    }
    return squared_length(apart);
}

/// Whether all triangles of the node are farther from `place` than the root of `squared`, by their
/// cylinder. A relative margin of 1e-6 is far above the rounding errors, so the answer is never
/// wrong for distances as computed; false if it is close.
bool TriangleTree::is_farther(const Node& node, const Vector3& place, double squared) {
    if (node.half_length < 0.0F) {
        return false;
    }
    const Vector3 offset = minus(place, middle_of(node.low, node.high));
    const double offset_squared = squared_length(offset);
    const double along = dot(node.axis, offset);
    const double beside = std::sqrt(std::max(offset_squared - along * along, 0.0));
    const double above = std::max(std::abs(along) - static_cast<double>(node.half_length), 0.0);
    const double outside = std::max(beside - static_cast<double>(node.radius), 0.0);
    return above * above + outside * outside > squared + 1e-6 * offset_squared;
}

void TriangleTree::find_nearest(const Vector3& place,
                                NearestPoint& nearest,
                                std::uint32_t& hint) const {
    struct Open {
        std::uint32_t node = 0;
        double least = 0.0;
    };
    std::uint32_t next_index = 0; // 1 + index of the nearest triangle; 0: of another mesh
    const auto consider = [&](std::size_t at) {
        const NearestPoint point = nearest_point(triangle(at), place);
        const std::uint32_t index = corners_[at].index + 1;
        if (point.squared < nearest.squared ||
            (point.squared == nearest.squared && index < next_index)) {
            nearest = point;
            next_index = index;
            hint = static_cast<std::uint32_t>(at);
        }
    };
    consider(hint);
    std::array<Open, kMaxSplitDepth> open;
    std::size_t open_count = 0;
    open[open_count++] = {0, least_squared(nodes_[0], place)};
    while (open_count > 0) {
        const Open next = open[--open_count];
        const Node& node = nodes_[next.node];
        if (!(next.least <= nearest.squared) || is_farther(node, place, nearest.squared)) {
            continue;
        }
        if (node.count == 0) {
            const Open first{next.node + 1, least_squared(nodes_[next.node + 1], place)};
            const Open second{node.begin, least_squared(nodes_[node.begin], place)};
            const bool first_is_nearer = first.least <= second.least;
            open[open_count++] = first_is_nearer ? second : first;
            open[open_count++] = first_is_nearer ? first : second;
            continue;
        }
        for (std::size_t at = node.begin; at < node.begin + node.count; ++at) {
            consider(at);
        }
    }
}

/// The crossing of the triangle by the ray from `place` along +x, or along -x unless `upwards`:
/// 1 or -1 by the side that the triangle faces; 0 without a crossing.
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
    const bool turned = !closure_.turned.empty() && closure_.turned[corners_[at].index] != 0;
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
    // The ray leaves the mesh on the nearer side.
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
    // A closed surface with one side only (Klein's bottle) has no winding number: parity decides.
    return closure_.orientable ? winding != 0 : crossings % 2 == 1;
}

std::uint64_t TriangleTree::bytes(const EnvironmentMesh& mesh) {
    // First the edges and the order of vertices, then items, nodes and corners.
    constexpr std::uint64_t kEdgeBytes = 3 * 16;
    constexpr std::uint64_t kTurnedBytes = 9;
    constexpr std::uint64_t kTreeBytes =
        sizeof(SplitItem) + sizeof(Corners) + (sizeof(SplitNode) + sizeof(Node)) / 2;
    return mesh.triangles.size() * std::max(kEdgeBytes + kTurnedBytes, kTreeBytes) +
           mesh.vertices.size() * 2 * sizeof(std::uint32_t);
}

} // namespace lsys
