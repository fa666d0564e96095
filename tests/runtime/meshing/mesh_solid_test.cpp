// SPDX-License-Identifier: MIT
// Solids: one closed surface around a whole plant.
#include "tests/support/mesh_checks.h"

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include <limits>
#include <map>
#include <numbers>
#include <vector>

using namespace lsys;

namespace {

constexpr double kPi = std::numbers::pi;

Mesh meshed(const Skeleton& skeleton, MeshOptions options = {}) {
    options.method = MeshMethod::Solid;
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, options, mesh) == std::nullopt);
    test::check_mesh(mesh, options);
    return mesh;
}

Segment
segment_to(const glm::vec3& base, const glm::vec3& end, float base_radius, float tip_radius) {
    Segment segment;
    segment.base = base;
    segment.length = glm::length(end - base);
    const glm::vec3 heading = (end - base) / segment.length;
    const glm::vec3 up(0, 1, 0);
    segment.frame =
        heading.y < -0.999F
            ? glm::quat(0, 1, 0, 0)
            : glm::normalize(glm::quat(1.0F + glm::dot(up, heading), glm::cross(up, heading)));
    segment.base_radius = base_radius;
    segment.tip_radius = tip_radius;
    return segment;
}

/// Whether the convex hull of the balls at the ends of a segment contains a point: whether some ball
/// between these balls contains it.
bool holds(const Segment& segment, double min_radius, const glm::dvec3& point) {
    const glm::dvec3 offset = glm::dvec3(segment.base) - point;
    const glm::dvec3 line = glm::dvec3(tip(segment)) - glm::dvec3(segment.base);
    const double r0 = std::max(double{segment.base_radius}, min_radius);
    const double r1 = std::max(double{segment.tip_radius}, min_radius);
    // |offset + u line|^2 - (r0 + u (r1 - r0))^2 = a u^2 + 2 b u + c
    const double a = glm::dot(line, line) - (r1 - r0) * (r1 - r0);
    const double b = glm::dot(offset, line) - r0 * (r1 - r0);
    const double c = glm::dot(offset, offset) - r0 * r0;
    const double u = a > 0.0 ? std::clamp(-b / a, 0.0, 1.0) : 0.0;
    return std::min({c, a * u * u + 2.0 * b * u + c, a + 2.0 * b + c}) <= 0.0;
}

/// Total volume of the grid cubes of side `side` above `ground` whose centres lie in some segment.
double volume_by_cubes(const Skeleton& skeleton, double min_radius, double side, double ground) {
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high = -low;
    for (const Segment& segment : skeleton.segments) {
        const double radius =
            std::max({double{segment.base_radius}, double{segment.tip_radius}, min_radius});
        low = glm::min(low, glm::min(glm::dvec3(segment.base), glm::dvec3(tip(segment))) - radius);
        high =
            glm::max(high, glm::max(glm::dvec3(segment.base), glm::dvec3(tip(segment))) + radius);
    }
    low.y = std::max(low.y, ground);
    std::uint64_t cubes = 0;
    for (double x = low.x + side / 2; x < high.x; x += side) {
        for (double y = low.y + side / 2; y < high.y; y += side) {
            for (double z = low.z + side / 2; z < high.z; z += side) {
                cubes += std::any_of(skeleton.segments.begin(), skeleton.segments.end(),
                                     [&](const Segment& segment) {
                                         return holds(segment, min_radius, {x, y, z});
                                     })
                             ? 1U
                             : 0U;
            }
        }
    }
    return static_cast<double>(cubes) * side * side * side;
}

/// The square of the distance of a point from a triangle: the minimum over a lattice of points of
/// the triangle.
double squared_distance(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& point) {
    constexpr int kSteps = 24;
    double min_square = std::numeric_limits<double>::max();
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; i + j <= kSteps; ++j) {
            const glm::dvec3 at = corners[0] + (corners[1] - corners[0]) * (double(i) / kSteps) +
                                  (corners[2] - corners[0]) * (double(j) / kSteps) - point;
            min_square = std::min(min_square, glm::dot(at, at));
        }
    }
    return min_square;
}

/// The number of edges that cross the inside of a triangle with which they share no vertex.
std::size_t crossings(const Mesh& mesh) {
    const LargeVector<std::uint32_t> indices = mesh.indices.expanded();
    std::map<std::array<int, 3>, std::vector<std::size_t>> cells;
    const float side = 0.02F;
    const auto for_cells = [&](std::size_t triangle, const auto& visit) {
        Bounds bounds;
        for (std::size_t i = 0; i < 3; ++i) {
            bounds.add(mesh.positions[indices[triangle + i]]);
        }
        const glm::ivec3 low(glm::floor(bounds.low / side));
        const glm::ivec3 high(glm::floor(bounds.high / side));
        for (int x = low.x; x <= high.x; ++x) {
            for (int y = low.y; y <= high.y; ++y) {
                for (int z = low.z; z <= high.z; ++z) {
                    visit(cells[{x, y, z}]);
                }
            }
        }
    };
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        for_cells(i, [&](std::vector<std::size_t>& cell) { cell.push_back(i); });
    }
    const auto volume = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        const glm::dvec3 origin(mesh.positions[a]);
        return glm::dot(glm::dvec3(mesh.positions[b]) - origin,
                        glm::cross(glm::dvec3(mesh.positions[c]) - origin,
                                   glm::dvec3(mesh.positions[d]) - origin));
    };
    std::size_t count = 0;
    const auto check = [&](const std::uint32_t* one, const std::uint32_t* other) {
        const auto apart = [&](int axis) {
            const auto at = [&](std::uint32_t vertex) { return mesh.positions[vertex][axis]; };
            const auto [low, high] = std::minmax({at(one[0]), at(one[1]), at(one[2])});
            return (at(other[0]) < low && at(other[1]) < low && at(other[2]) < low) ||
                   (at(other[0]) > high && at(other[1]) > high && at(other[2]) > high);
        };
        if (apart(0) || apart(1) || apart(2) ||
            std::find_first_of(one, one + 3, other, other + 3) != one + 3) {
            return;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = one[i];
            const std::uint32_t b = one[(i + 1) % 3];
            const bool through = (volume(a, other[0], other[1], other[2]) > 0.0) !=
                                 (volume(b, other[0], other[1], other[2]) > 0.0);
            const bool first = volume(a, b, other[0], other[1]) > 0.0;
            count += through && first == (volume(a, b, other[1], other[2]) > 0.0) &&
                             first == (volume(a, b, other[2], other[0]) > 0.0)
                         ? 1U
                         : 0U;
        }
    };
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        for_cells(i, [&](const std::vector<std::size_t>& cell) {
            for (const std::size_t other : cell) {
                check(&indices[i], &indices[other]);
            }
        });
    }
    return count;
}

void check_closed(const Mesh& mesh, std::uint64_t shells) {
    CHECK(mesh.shells == shells);
    const test::Topology by_position = test::topology_of(mesh);
    CHECK(by_position.open_edges == 0);
    CHECK(by_position.vertices == mesh.positions.size());
    // Narrow triangles in the crease between two branches may face away from the normals there.
    CHECK(500 * test::triangles_turned_over(mesh) < by_position.triangles);
}

/// A stem with a fork, a bend that turns back, a thin twig, and a segment drawn twice.
Skeleton branched() {
    Skeleton skeleton;
    const auto add = [&](const glm::vec3& from, const glm::vec3& to, float base, float end,
                         std::uint32_t parent) {
        Segment segment = segment_to(from, to, base, end);
        segment.parent = parent;
        segment.linked = parent != kNoSegment;
        skeleton.segments.push_back(segment);
    };
    add({0, 0, 0}, {0, 1, 0.1F}, 0.1F, 0.08F, kNoSegment);
    add({0, 1, 0.1F}, {0.5F, 1.5F, 0.1F}, 0.08F, 0.03F, 0);
    add({0, 1, 0.1F}, {-0.4F, 1.6F, 0.3F}, 0.06F, 0.02F, 0);
    add({0.5F, 1.5F, 0.1F}, {0.3F, 0.9F, 0.1F}, 0.03F, 0.03F, 1);
    add({0.5F, 1.5F, 0.1F}, {0.3F, 0.9F, 0.1F}, 0.03F, 0.03F, 1);
    add({-0.4F, 1.6F, 0.3F}, {-0.4F, 1.9F, 0.5F}, 0.001F, 0.001F, 2);
    return skeleton;
}

} // namespace

TEST_CASE("a solid segment has the volume of its round cone") {
    for (const std::uint32_t sides : {9U, 12U, 16U}) {
        MeshOptions options;
        options.sides = sides;
        for (const float radius : {0.1F, 0.13F, 0.16F}) {
            Skeleton skeleton;
            skeleton.segments.push_back(segment_to({1, 2, 3}, {3, 2.5F, 2.2F}, radius, radius));
            const Mesh mesh = meshed(skeleton, options);
            check_closed(mesh, 1);
            CHECK(test::topology_of(mesh).euler() == 2);
            const double r = double{radius};
            const double exact =
                kPi * r * r * double{skeleton.segments[0].length} + 4.0 / 3.0 * kPi * r * r * r;
            CHECK(test::volume_of(mesh) == Approx(exact).epsilon(0.02));
        }
    }
}

TEST_CASE("a standing stem has a flat base") {
    Skeleton skeleton;
    skeleton.segments.push_back(segment_to({1, 0.3F, 2}, {1, 3, 2}, 0.2F, 0.2F));
    const Mesh mesh = meshed(skeleton);
    check_closed(mesh, 1);
    CHECK(test::bounds_of(mesh).low.y == 0.3F);
    Bounds base;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (mesh.positions[i].y == 0.3F) {
            base.add(mesh.positions[i]);
        }
    }
    CHECK(base.high.x - base.low.x > 0.35F);
    const double half_ball = 2.0 / 3.0 * kPi * 0.008;
    CHECK(test::volume_of(mesh) == Approx(kPi * 0.04 * 2.7 + half_ball).epsilon(0.02));
}

TEST_CASE("the solid of a branched plant is one shell with the volume counted in cubes") {
    const Skeleton skeleton = branched();
    const Mesh mesh = meshed(skeleton);
    check_closed(mesh, 1);
    CHECK(test::topology_of(mesh).euler() == 2);
    CHECK(crossings(mesh) == 0);
    const double min_radius = 0.5 * 1.9 / 150.0;
    CHECK(test::volume_of(mesh) ==
          Approx(volume_by_cubes(skeleton, min_radius, 0.012, 0.0)).epsilon(0.02));
}

TEST_CASE("no part of a solid is thinner than the minimum width") {
    MeshOptions options;
    options.min_width = 0.1F;
    const Skeleton skeleton = branched();
    const Mesh mesh = meshed(skeleton, options);
    check_closed(mesh, 1);
    CHECK(test::bounds_of(mesh).high.y == Approx(1.95F).epsilon(0.01));
    CHECK(test::volume_of(mesh) ==
          Approx(volume_by_cubes(skeleton, 0.05, 0.016, 0.0)).epsilon(0.02));
}

TEST_CASE("polygons and objects of a solid are thick and not hollow") {
    Skeleton skeleton;
    skeleton.corners = {{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1}};
    skeleton.polygons.push_back({.first_corner = 0, .corner_count = 4});
    MeshOptions options;
    options.min_width = 0.2F;
    const Mesh plate = meshed(skeleton, options);
    check_closed(plate, 1);
    // The volume is a plate, half a cylinder along each side, and in all one ball at the corners.
    const double r = 0.1;
    CHECK(test::volume_of(plate) ==
          Approx(0.4 + kPi * r * r * 3.0 + 4.0 / 3.0 * kPi * r * r * r).epsilon(0.02));
    Skeleton ball;
    ball.objects.push_back({.kind = TurtleOperation::Sphere, .size = 2.0F});
    const Mesh round = meshed(ball, options);
    check_closed(round, 1);
    CHECK(test::topology_of(round).euler() == 2);
    // The corners of the sphere's mesh lie on a ball, so the solid is smaller than a ball with the
    // added thickness.
    CHECK(test::volume_of(round) < 4.0 / 3.0 * kPi * 1.1 * 1.1 * 1.1);
    CHECK(test::volume_of(round) > 4.0 / 3.0 * kPi);
}

TEST_CASE("solids of triangles of any shape and size have the volume counted in cubes") {
    // Large, small and narrow triangles and one without area; some share corners, some cross.
    Skeleton skeleton;
    const std::vector<std::array<glm::vec3, 3>> triangles{
        {{{0, 0, 0}, {1, 0.1F, 0}, {0.2F, 0.9F, 0.3F}}},
        {{{1, 0.1F, 0}, {0.2F, 0.9F, 0.3F}, {1, 1, 1}}},
        {{{0.3F, 0.2F, -0.4F}, {0.4F, 0.5F, 0.6F}, {0.45F, 0.5F, 0.6F}}},
        {{{0, 0, 0}, {-0.02F, 0.05F, 0.01F}, {0.05F, 0.05F, 0.02F}}},
        {{{1, 1, 1}, {1.2F, 1.1F, 1}, {1.4F, 1.2F, 1}}},
    };
    for (const auto& corners : triangles) {
        const auto first = static_cast<std::uint32_t>(skeleton.corners.size());
        for (const glm::vec3& corner : corners) {
            skeleton.corners.push_back(corner);
        }
        skeleton.polygons.push_back({.first_corner = first, .corner_count = 3});
    }
    MeshOptions options;
    options.min_width = 0.2F;
    const Mesh mesh = meshed(skeleton, options);
    check_closed(mesh, 1);
    CHECK(crossings(mesh) == 0);
    // squared_distance() uses lattice points at most 0.03 from any point of the triangle, which
    // changes distances near 0.1 by at most 0.005.
    const double side = 0.025;
    std::uint64_t cubes = 0;
    for (double x = -0.2; x < 1.6; x += side) {
        for (double y = -0.2; y < 1.4; y += side) {
            for (double z = -0.6; z < 1.2; z += side) {
                cubes +=
                    std::any_of(triangles.begin(), triangles.end(),
                                [&](const std::array<glm::vec3, 3>& t) {
                                    return squared_distance({glm::dvec3(t[0]), glm::dvec3(t[1]),
                                                             glm::dvec3(t[2])},
                                                            {x, y, z}) <= 0.01;
                                })
                        ? 1U
                        : 0U;
            }
        }
    }
    const double volume = static_cast<double>(cubes) * side * side * side;
    CHECK(test::volume_of(mesh) == Approx(volume).epsilon(0.02));
}

TEST_CASE("a solid of a plant three times as large is three times as large") {
    Skeleton skeleton = branched();
    MeshOptions options;
    options.min_width = 0.0625F;
    const Mesh before = meshed(skeleton, options);
    constexpr float kScale = 3.0F; // not 2 or 4, which a fixed grid of halved cells would pass too
    for (Segment& segment : skeleton.segments) {
        segment.base *= kScale;
        segment.length *= kScale;
        segment.base_radius *= kScale;
        segment.tip_radius *= kScale;
    }
    options.min_width *= kScale;
    const Mesh after = meshed(skeleton, options);
    REQUIRE(after.positions.size() == before.positions.size());
    CHECK(after.indices.size() == before.indices.size());
    for (std::size_t i = 0; i < after.positions.size(); ++i) {
        CHECK(glm::distance(after.positions[i], kScale * before.positions[i]) < 1e-4F);
    }
}

TEST_CASE("parts of a solid that do not touch are separate shells") {
    Skeleton skeleton = branched();
    skeleton.segments.push_back(segment_to({3, 1, 0}, {4, 1.2F, 0}, 0.1F, 0.1F));
    check_closed(meshed(skeleton), 2);
    CHECK(meshed(Skeleton{}).indices.empty());
    MeshOptions tubes;
    Mesh mesh;
    REQUIRE(make_mesh(skeleton, {}, tubes, mesh) == std::nullopt);
    CHECK(mesh.shells == 0);
}

TEST_CASE("a solid is the same for any number of threads") {
    MeshOptions options;
    options.threads = 1;
    options.segments = true;
    const Mesh one = meshed(branched(), options);
    options.threads = 3;
    const Mesh three = meshed(branched(), options);
    CHECK(one.positions == three.positions);
    CHECK(one.normals == three.normals);
    CHECK(one.segments == three.segments);
    CHECK(one.indices == three.indices);
}

TEST_CASE("fewer sides make coarser solids") {
    MeshOptions options;
    std::size_t before = std::numeric_limits<std::size_t>::max();
    for (const std::uint32_t sides : {20U, 14U, 9U}) {
        options.sides = sides;
        const std::size_t triangles = meshed(branched(), options).indices.size() / 3;
        CHECK(triangles < before);
        before = triangles;
    }
}

TEST_CASE("a solid over the limit of memory is not made") {
    MeshOptions options;
    options.method = MeshMethod::Solid;
    options.max_bytes = 100'000;
    Mesh mesh;
    CHECK(make_mesh(branched(), {}, options, mesh) == Stop::Limit);
    CHECK(mesh.positions.empty());
}
