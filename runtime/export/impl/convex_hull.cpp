// SPDX-License-Identifier: MIT
// Incremental hull (Preparata and Hong 1977; de Berg et al., "Computational Geometry", chapter 11):
// a point outside replaces the triangles that face it by a fan to their outer edge, the horizon.
// The points have integer coordinates of at most 20 bits, so that six times the volume of a
// tetrahedron fits into 64 bits.
#include "runtime/export/impl/convex_hull.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace lsys {

namespace {

using Point = std::array<std::int64_t, 3>;    // coordinates on the grid
using Corners = std::array<std::uint32_t, 3>; // a triangle, as numbers of points

constexpr double kGrid = 1'048'575.0; // nodes along the largest extent

Point minus(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point cross(const Point& a, const Point& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool is_zero(const Point& a) {
    return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

/// The points rounded to the grid, without duplicates, in the order of their coordinates.
std::vector<Point> on_grid(std::span<const glm::vec3> points, glm::dvec3& low, double& step) {
    low = glm::dvec3(points[0]);
    glm::dvec3 high = low;
    for (const glm::vec3& point : points) {
        low = glm::min(low, glm::dvec3(point));
        high = glm::max(high, glm::dvec3(point));
    }
    const glm::dvec3 size = high - low;
    step = std::max({size.x, size.y, size.z}) / kGrid;
    std::vector<Point> nodes;
    for (const glm::vec3& point : points) {
        const glm::dvec3 at = step > 0.0 ? (glm::dvec3(point) - low) / step : glm::dvec3(0.0);
        nodes.push_back({std::llround(at.x), std::llround(at.y), std::llround(at.z)});
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

class Builder {
public:
    explicit Builder(std::vector<Point> points) : points_(std::move(points)) {}

    /// Returns nothing if the points lie in a plane.
    std::optional<std::vector<Corners>> build() {
        if (!begin()) {
            return std::nullopt;
        }
        for (std::uint32_t i = 0; i < points_.size(); ++i) {
            add(i);
        }
        return triangles_;
    }

    [[nodiscard]] const Point& point(std::uint32_t number) const { return points_[number]; }

private:
    /// Positive if `apex` is on the outer side of the triangle, 0 in its plane: six times the
    /// volume of the tetrahedron.
    [[nodiscard]] std::int64_t orientation(const Corners& triangle, std::uint32_t apex) const {
        const Point& a = points_[triangle[0]];
        const Point normal = cross(minus(points_[triangle[1]], a), minus(points_[triangle[2]], a));
        const Point arm = minus(points_[apex], a);
        return normal[0] * arm[0] + normal[1] * arm[1] + normal[2] * arm[2];
    }

    [[nodiscard]] bool in_line(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return is_zero(cross(minus(points_[b], points_[a]), minus(points_[c], points_[a])));
    }

    /// The first tetrahedron with a volume.
    bool begin() {
        const auto count = static_cast<std::uint32_t>(points_.size());
        std::uint32_t third = 2;
        while (third < count && in_line(0, 1, third)) {
            ++third;
        }
        if (third >= count) {
            return false;
        }
        const Corners base{0, 1, third};
        std::uint32_t apex = third + 1;
        while (apex < count && orientation(base, apex) == 0) {
            ++apex;
        }
        if (apex >= count) {
            return false;
        }
        const bool outside = orientation(base, apex) > 0;
        const std::uint32_t b = outside ? third : 1;
        const std::uint32_t c = outside ? 1 : third;
        triangles_ = {{0, b, c}, {0, c, apex}, {c, b, apex}, {b, 0, apex}};
        return true;
    }

    /// Extends the hull to the point `apex`. A triangle whose plane contains the point counts as
    /// facing the point, so that no edge of the horizon is collinear with the point.
    void add(std::uint32_t apex) {
        orientations_.clear();
        for (const Corners& triangle : triangles_) {
            orientations_.push_back(orientation(triangle, apex));
        }
        const auto is_above = [](std::int64_t orientation) { return orientation > 0; };
        if (std::none_of(orientations_.begin(), orientations_.end(), is_above)) {
            return;
        }
        edges_.clear();
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            for (std::size_t i = 0; orientations_[t] >= 0 && i < 3; ++i) {
                edges_.insert({triangles_[t][i], triangles_[t][(i + 1) % 3]});
            }
        }
        std::size_t number = 0;
        std::erase_if(triangles_, [&](const Corners&) { return orientations_[number++] >= 0; });
        for (const auto& [from, to] : edges_) {
            if (!edges_.contains({to, from})) {
                triangles_.push_back({from, to, apex});
            }
        }
    }

    std::vector<Point> points_;
    std::vector<Corners> triangles_;
    std::vector<std::int64_t> orientations_;
    std::set<std::pair<std::uint32_t, std::uint32_t>>
        edges_; // of the triangles that face the point
};

} // namespace

ConvexHull convex_hull(std::span<const glm::vec3> points) {
    ConvexHull hull;
    if (points.empty()) {
        return hull;
    }
    glm::dvec3 low(0.0);
    double step = 0.0;
    Builder builder(on_grid(points, low, step));
    const std::optional<std::vector<Corners>> triangles = builder.build();
    if (!triangles) {
        return hull;
    }
    std::map<std::uint32_t, std::uint32_t> hull_vertex_of_point;
    for (const Corners& triangle : *triangles) {
        Corners& hull_triangle = hull.triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [found, is_new] = hull_vertex_of_point.try_emplace(
                triangle[i], static_cast<std::uint32_t>(hull.vertices.size()));
            if (is_new) {
                const Point& at = builder.point(triangle[i]);
                hull.vertices.emplace_back(low + step * glm::dvec3(at[0], at[1], at[2]));
            }
            hull_triangle[i] = found->second;
        }
    }
    return hull;
}

} // namespace lsys
