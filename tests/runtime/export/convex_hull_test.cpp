// SPDX-License-Identifier: MIT
#include "runtime/export/impl/convex_hull.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

using namespace lsys;

namespace {

double volume_of(const ConvexHull& hull) {
    double volume = 0.0;
    for (const auto& [a, b, c] : hull.triangles) {
        volume += glm::dot(glm::dvec3(hull.vertices[a]),
                           glm::cross(glm::dvec3(hull.vertices[b]), glm::dvec3(hull.vertices[c])));
    }
    return volume / 6.0;
}

/// Checks that the hull is closed, faces outwards, is one piece and uses each vertex.
void check_closed(const ConvexHull& hull) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& triangle : hull.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            ++edges[{triangle[i], triangle[(i + 1) % 3]}];
        }
    }
    for (const auto& [edge, count] : edges) {
        REQUIRE(count == 1);
        REQUIRE(edges.contains({edge.second, edge.first}));
    }
    CHECK(hull.triangles.size() == 2 * hull.vertices.size() - 4); // Euler's formula
}

/// The greatest distance of a point from the plane of a triangle, on the outer side.
double farthest_outside(const ConvexHull& hull, const std::vector<glm::vec3>& points) {
    double max_distance = 0.0;
    for (const auto& [a, b, c] : hull.triangles) {
        const glm::dvec3 corner(hull.vertices[a]);
        const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(hull.vertices[b]) - corner,
                                                            glm::dvec3(hull.vertices[c]) - corner));
        for (const glm::vec3& point : points) {
            max_distance = std::max(max_distance, glm::dot(normal, glm::dvec3(point) - corner));
        }
    }
    return max_distance;
}

} // namespace

TEST_CASE("the hull of a grid of points is its cube") {
    std::vector<glm::vec3> points;
    for (int i = 0; i < 125; ++i) {
        points.emplace_back(i % 5, i / 5 % 5, i / 25);
    }
    const ConvexHull hull = convex_hull(points);
    check_closed(hull);
    CHECK(volume_of(hull) == Approx(64.0));
    CHECK(farthest_outside(hull, points) < 1e-4);
}

TEST_CASE("the hull of points in a ball contains all points") {
    test::RandomNumbers numbers(3);
    std::vector<glm::vec3> points;
    for (int i = 0; i < 400; ++i) {
        points.push_back(glm::vec3(7, -2, 1) +
                         3.0F * numbers.uniform(0.5F, 1.0F) * glm::normalize(numbers.direction()));
    }
    const ConvexHull hull = convex_hull(points);
    check_closed(hull);
    CHECK(farthest_outside(hull, points) < 2e-5);
    CHECK(volume_of(hull) > 0.75 * 113.1);
    CHECK(volume_of(hull) < 113.1);
}

TEST_CASE(
    "the hull of rings of points on a prism, many of them collinear or coplanar, is the prism") {
    std::vector<glm::vec3> points;
    for (int ring = 0; ring < 6; ++ring) {
        for (int side = 0; side < 8; ++side) {
            const double angle = side * 3.14159265358979 / 4.0;
            points.emplace_back(std::cos(angle), 2 * ring, std::sin(angle));
        }
    }
    const ConvexHull hull = convex_hull(points);
    check_closed(hull);
    CHECK(farthest_outside(hull, points) < 1e-4);
    CHECK(volume_of(hull) == Approx(2.0 * std::sqrt(2.0) * 10.0).epsilon(1e-4));
}

TEST_CASE("coplanar, collinear or equal points have no hull") {
    CHECK(convex_hull({}).triangles.empty());
    const std::vector<glm::vec3> same(4, glm::vec3(1, 2, 3));
    CHECK(convex_hull(same).triangles.empty());
    std::vector<glm::vec3> line;
    std::vector<glm::vec3> plane;
    for (int i = 0; i < 9; ++i) {
        line.emplace_back(i, 2 * i, 0);
        plane.emplace_back(i % 3, i / 3, 4);
    }
    CHECK(convex_hull(line).triangles.empty());
    CHECK(convex_hull(plane).triangles.empty());
}
