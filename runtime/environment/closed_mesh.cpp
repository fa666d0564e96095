// SPDX-License-Identifier: MIT
#include "runtime/environment/closed_mesh.h"

#include "runtime/base/large_vector.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace lsys {

namespace {

/// Sorts blocks, then merges pairs of them. Returns false if it was cancelled between two steps.
template <typename T, typename Before>
[[nodiscard]] bool
sort_unless(const std::atomic<bool>* cancelled, LargeVector<T>& items, const Before& before) {
    constexpr std::size_t kBlock = std::size_t{1} << 16;
    const auto at = [&](std::size_t i) {
        return items.begin() + static_cast<std::ptrdiff_t>(std::min(i, items.size()));
    };
    const auto is_cancelled = [&] { return cancelled != nullptr && *cancelled; };
    for (std::size_t i = 0; i < items.size(); i += kBlock) {
        if (is_cancelled()) {
            return false;
        }
        std::sort(at(i), at(i + kBlock), before);
    }
    for (std::size_t block = kBlock; block < items.size(); block *= 2) {
        for (std::size_t i = 0; i + block < items.size(); i += 2 * block) {
            if (is_cancelled()) {
                return false;
            }
            std::inplace_merge(at(i), at(i + block), at(i + 2 * block), before);
        }
    }
    return !is_cancelled();
}

/// By vertex: the index of the first vertex at the same place; -0 equals 0. Empty when cancelled.
LargeVector<std::uint32_t> merged_vertices(const std::vector<Vector3>& vertices,
                                           const std::atomic<bool>* cancelled) {
    LargeVector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        return vertices[a] != vertices[b] ? vertices[a] < vertices[b] : a < b;
    };
    if (!sort_unless(cancelled, order, before)) {
        return {};
    }
    LargeVector<std::uint32_t> merged(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && vertices[order[i]] == vertices[order[i - 1]];
        merged[order[i]] = same ? merged[order[i - 1]] : order[i];
    }
    return merged;
}

/// A side of a triangle, between the vertices `low` and `high`.
struct EdgeUse {
    std::uint32_t low = 0; // the lower index of the two vertices
    std::uint32_t high = 0;
    std::uint32_t triangle = 0;
    bool upwards = false; // the triangle goes from `low` to `high`
};

/// The sides of all triangles with three different corners, sorted by edge, then by triangle. Empty
/// when cancelled.
LargeVector<EdgeUse> sorted_edges(const EnvironmentMesh& mesh, const std::atomic<bool>* cancelled) {
    const LargeVector<std::uint32_t> merged = merged_vertices(mesh.vertices, cancelled);
    LargeVector<EdgeUse> edges;
    if (merged.empty()) {
        return edges;
    }
    edges.reserve(mesh.triangles.size() * 3);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::array<std::uint32_t, 3>& corners = mesh.triangles[i];
        const std::array<std::uint32_t, 3> at{merged[corners[0]], merged[corners[1]],
                                              merged[corners[2]]};
        if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0]) {
            continue;
        }
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t from = at[side];
            const std::uint32_t to = at[(side + 1) % 3];
            edges.push_back(
                {std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(i), from < to});
        }
    }
    const auto before = [](const EdgeUse& a, const EdgeUse& b) {
        return a.low != b.low     ? a.low < b.low
               : a.high != b.high ? a.high < b.high
                                  : a.triangle < b.triangle;
    };
    if (!sort_unless(cancelled, edges, before)) {
        return {};
    }
    return edges;
}

bool is_same_edge(const EdgeUse& a, const EdgeUse& b) {
    return a.low == b.low && a.high == b.high;
}

/// Whether each edge has exactly two uses.
bool are_pairs(const LargeVector<EdgeUse>& edges) {
    for (std::size_t i = 0; i < edges.size(); i += 2) {
        if (i + 1 >= edges.size() || !is_same_edge(edges[i], edges[i + 1]) ||
            (i + 2 < edges.size() && is_same_edge(edges[i], edges[i + 2]))) {
            return false;
        }
    }
    return !edges.empty();
}

/// Sets of connected triangles: a union-find forest that also stores, per triangle, whether the
/// triangle faces the same side as the root of its set. The root is the first triangle of the set.
class ConnectedTriangles {
public:
    explicit ConnectedTriangles(std::size_t count) : parent_(count), turned_(count, 0) {
        std::iota(parent_.begin(), parent_.end(), 0U);
    }

    /// Connects two neighbours; `turned`: they face opposite sides. Returns false if earlier
    /// connections imply the contrary of `turned`.
    [[nodiscard]] bool connect(std::uint32_t a, std::uint32_t b, bool turned) {
        const std::uint32_t root_a = find(a);
        const std::uint32_t root_b = find(b);
        const std::uint8_t has_other_parity =
            static_cast<std::uint8_t>(turned_[a] ^ turned_[b] ^ (turned ? 1 : 0));
        if (root_a == root_b) {
            return has_other_parity == 0;
        }
        parent_[std::max(root_a, root_b)] = std::min(root_a, root_b);
        turned_[std::max(root_a, root_b)] = has_other_parity;
        return true;
    }

    /// By triangle: 1 if it must be turned to face the same side as the root of its set.
    [[nodiscard]] std::vector<std::uint8_t> turned() {
        for (std::size_t i = 0; i < parent_.size(); ++i) {
            static_cast<void>(find(static_cast<std::uint32_t>(i)));
        }
        return turned_;
    }

private:
    /// The root of the set of `triangle`. Makes the root the parent of all triangles on the path to
    /// it.
    std::uint32_t find(std::uint32_t triangle) {
        path_.clear();
        while (parent_[triangle] != triangle) {
            path_.push_back(triangle);
            triangle = parent_[triangle];
        }
        std::uint8_t turned = 0;
        for (std::size_t i = path_.size(); i-- > 0;) {
            turned ^= turned_[path_[i]];
            turned_[path_[i]] = turned;
            parent_[path_[i]] = triangle;
        }
        return triangle;
    }

    std::vector<std::uint32_t> parent_; // by triangle; a root is its own parent
    std::vector<std::uint8_t> turned_;  // 1: faces the side opposite to its parent's; 0 for roots
    std::vector<std::uint32_t> path_;   // triangles that find() has passed
};

} // namespace

MeshClosure mesh_closure(const EnvironmentMesh& mesh, const std::atomic<bool>* cancelled) {
    MeshClosure closure;
    const LargeVector<EdgeUse> edges = sorted_edges(mesh, cancelled);
    closure.closed = are_pairs(edges);
    if (!closure.closed) {
        return closure;
    }
    const auto same_direction = [&](std::size_t i) {
        return edges[i].upwards == edges[i + 1].upwards;
    };
    bool consistent = true;
    for (std::size_t i = 0; i < edges.size() && consistent; i += 2) {
        consistent = !same_direction(i);
    }
    if (!consistent) {
        ConnectedTriangles triangles(mesh.triangles.size());
        for (std::size_t i = 0; i < edges.size(); i += 2) {
            closure.orientable =
                triangles.connect(edges[i].triangle, edges[i + 1].triangle, same_direction(i)) &&
                closure.orientable;
        }
        closure.turned = triangles.turned();
    }
    return closure;
}

} // namespace lsys
