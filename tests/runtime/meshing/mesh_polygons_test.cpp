// SPDX-License-Identifier: MIT
// Triangulation: areas of polygons of every shape, and degenerate polygons.
#include "runtime/meshing/impl/polygons.h"
#include "runtime/meshing/impl/triangulate.h"
#include "tests/support/mesh_checks.h"

#include <glm/gtc/quaternion.hpp>

#include <chrono>
#include <numbers>
#include <random>
#include <string>
#include <vector>

using namespace lsys;
using Corners = std::vector<glm::dvec2>;

namespace {

double shoelace(const Corners& corners) {
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2& a = corners[i];
        const glm::dvec2& b = corners[(i + 1) % corners.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return 0.5 * sum;
}

struct Cut {
    std::size_t triangles = 0;
    double area = 0.0;
};

Cut triangulated(const Corners& corners) {
    Triangulator triangulator;
    std::vector<std::uint32_t> triangles{7, 7, 7}; // append() keeps earlier triangles
    triangulator.append(corners, triangles);
    REQUIRE(triangles.size() % 3 == 0);
    Cut cut;
    std::size_t wrong = 0;
    for (std::size_t i = 3; i < triangles.size(); i += 3) {
        const std::uint32_t a = triangles[i];
        const std::uint32_t b = triangles[i + 1];
        const std::uint32_t c = triangles[i + 2];
        REQUIRE(std::max({a, b, c}) < corners.size());
        const double area = shoelace({corners[a], corners[b], corners[c]});
        wrong += area > 0.0 ? 0U : 1U;
        cut.area += area;
        ++cut.triangles;
    }
    CHECK(wrong == 0);
    return cut;
}

/// Corners at random distances from the middle and ascending angles: simple, mostly concave.
Corners random_star(std::mt19937& random, std::size_t count) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Corners corners;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi *
                             (static_cast<double>(i) + 0.9 * unit(random)) /
                             static_cast<double>(count);
        const double radius = 0.2 + unit(random);
        corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    return corners;
}

/// Positive if a, b and c are counterclockwise.
double orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Random points in an order without crossings, found by reversing the part between two crossing
/// edges.
Corners random_knot(std::mt19937& random, std::size_t count) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Corners corners;
    for (std::size_t i = 0; i < count; ++i) {
        corners.emplace_back(unit(random), unit(random));
    }
    bool changed = true;
    while (changed) {
        changed = false;
        for (std::size_t i = 0; i + 2 < count; ++i) {
            for (std::size_t j = i + 2; j < count; ++j) {
                const glm::dvec2 a = corners[i];
                const glm::dvec2 b = corners[i + 1];
                const glm::dvec2 c = corners[j];
                const glm::dvec2 d = corners[(j + 1) % count];
                if (a != d && (orientation(a, b, c) > 0) != (orientation(a, b, d) > 0) &&
                    (orientation(c, d, a) > 0) != (orientation(c, d, b) > 0)) {
                    std::reverse(corners.begin() + static_cast<std::ptrdiff_t>(i + 1),
                                 corners.begin() + static_cast<std::ptrdiff_t>(j + 1));
                    changed = true;
                }
            }
        }
    }
    return corners;
}

Skeleton skeleton_of(const std::vector<glm::vec3>& corners) {
    Skeleton skeleton;
    skeleton.corners.assign(corners.begin(), corners.end());
    Polygon polygon;
    polygon.corner_count = static_cast<std::uint32_t>(corners.size());
    skeleton.polygons.push_back(polygon);
    return skeleton;
}

Mesh meshed(const Skeleton& skeleton, const MeshOptions& options = {}) {
    Mesh mesh;
    MeshBuilder builder(options, mesh);
    append_polygons(skeleton, {}, options, builder);
    REQUIRE(builder.finish() == std::nullopt);
    test::check_mesh(mesh, options);
    return mesh;
}

} // namespace

TEST_CASE("triangles of random simple polygons have the area of the polygon") {
    std::mt19937 random(1);
    for (std::size_t count = 3; count < 120; ++count) {
        for (const Corners& corners : {random_star(random, count), random_knot(random, count)}) {
            const double expected = std::abs(shoelace(corners));
            const Cut cut = triangulated(corners);
            CHECK(cut.triangles == count - 2);
            CHECK(cut.area == Approx(expected).epsilon(1e-9));
            Corners reversed(corners.rbegin(), corners.rend());
            CHECK(triangulated(reversed).area == Approx(expected).epsilon(1e-9));
        }
    }
}

TEST_CASE("corners on edges and on other corners do not change the area") {
    // A comb on a grid, each edge with corners in between.
    Corners comb;
    for (int i = 0; i < 40; ++i) {
        const double x = 2.0 * i;
        for (const glm::dvec2 at :
             {glm::dvec2(x, 0), glm::dvec2(x, 2), glm::dvec2(x, 4), glm::dvec2(x + 0.5, 4),
              glm::dvec2(x + 1, 4), glm::dvec2(x + 1, 1), glm::dvec2(x + 1, 0)}) {
            comb.push_back(at);
        }
    }
    for (int i = 79; i >= 0; --i) {
        comb.emplace_back(i, -1.0);
    }
    CHECK(triangulated(comb).area == Approx(std::abs(shoelace(comb))));
    // A square with a square hole, joined by a bridge that the outline passes twice.
    const Corners ring{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0},
                       {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}};
    CHECK(triangulated(ring).area == Approx(8.0));
    // Each corner occurs twice.
    const Corners twice{{0, 0}, {0, 0}, {2, 0}, {2, 0}, {1, 0.5}, {1, 0.5}, {0, 2}, {0, 2}};
    CHECK(triangulated(twice).area == Approx(1.5));
    // A spike without area.
    CHECK(triangulated({{0, 0}, {1, 0}, {1, 1}, {3, 3}, {1, 1}, {0, 1}}).area == Approx(1.0));
}

TEST_CASE("polygons of any size, position and aspect ratio") {
    const Corners arrow{{0, 0}, {2, 1}, {0, 2}, {1, 1}};
    for (const double scale : {1e-30, 1e-6, 1.0, 1e6, 1e30}) {
        Corners scaled;
        for (const glm::dvec2& corner : arrow) {
            scaled.push_back(scale * corner);
        }
        const Cut cut = triangulated(scaled);
        CHECK(cut.triangles == 2);
        CHECK(cut.area / scale / scale == Approx(1.0));
    }
    CHECK(triangulated({{0, 0}, {1e6, 0}, {1e6, 1}, {5e5, 0.5}, {0, 1}}).triangles == 3);
}

TEST_CASE("degenerate polygons have no triangles") {
    CHECK(triangulated({}).triangles == 0);
    CHECK(triangulated({{1, 1}}).triangles == 0);
    CHECK(triangulated({{1, 1}, {2, 2}}).triangles == 0);
    CHECK(triangulated({{1, 1}, {1, 1}, {1, 1}, {1, 1}}).triangles == 0);
    CHECK(triangulated({{0, 0}, {1, 1}, {2, 2}, {3, 3}, {1, 1}}).triangles == 0);
}

TEST_CASE("polygons that cross themselves have valid triangles") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    CHECK(triangulated({{0, 0}, {1, 1}, {1, 0}, {0, 1}}).triangles > 0);
    Corners star; // a pentagram: though all its corners are convex, its edges cross
    for (int i = 0; i < 5; ++i) {
        const double angle = 4.0 * std::numbers::pi * i / 5.0;
        star.emplace_back(std::cos(angle), std::sin(angle));
    }
    CHECK(triangulated(star).triangles >= 2);
    for (std::size_t count = 4; count < 300; count += 7) {
        Corners corners;
        Corners on_grid;
        for (std::size_t i = 0; i < count; ++i) {
            corners.emplace_back(unit(random), unit(random));
            on_grid.emplace_back(std::floor(4.0 * unit(random)), std::floor(4.0 * unit(random)));
        }
        CHECK(triangulated(corners).triangles > 0);
        CHECK(triangulated(on_grid).triangles <= count - 2);
    }
}

TEST_CASE("polygons of ten thousand corners are triangulated fast") {
    std::mt19937 random(3);
    const auto begin = std::chrono::steady_clock::now();
    constexpr std::size_t kCorners = 10'000;
    const Corners star = random_star(random, kCorners);
    CHECK(triangulated(star).area == Approx(std::abs(shoelace(star))));
    Corners spiral;
    Corners back;
    Corners noise;
    Corners zigzag;
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t i = 0; i < kCorners / 2; ++i) {
        const double turn = 0.05 * static_cast<double>(i);
        const double radius = 1.0 + turn;
        spiral.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
        back.emplace_back((radius + 2.0) * std::cos(turn), (radius + 2.0) * std::sin(turn));
        noise.emplace_back(unit(random), unit(random));
        noise.emplace_back(unit(random), unit(random));
        zigzag.emplace_back(i % 2 == 0 ? 0.0 : 1.0, static_cast<double>(i));
    }
    spiral.insert(spiral.end(), back.rbegin(), back.rend());
    zigzag.emplace_back(1000.0, -1.0);
    CHECK(triangulated(spiral).area == Approx(std::abs(shoelace(spiral))));
    CHECK(triangulated(zigzag).area == Approx(std::abs(shoelace(zigzag))));
    CHECK(triangulated(noise).triangles > 0);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    CHECK(passed.count() < 20.0); // s; it takes 1 s on a slow machine, more with sanitizers
}

TEST_CASE("the polygon of a turtle lies in its plane and faces its up direction") {
    // A concave polygon in a rotated plane.
    const Corners flat{{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}};
    std::mt19937 random(4);
    std::normal_distribution<float> normal;
    for (int round = 0; round < 50; ++round) {
        const glm::quat frame = glm::normalize(
            glm::quat(normal(random), normal(random), normal(random), normal(random)));
        std::vector<glm::vec3> corners;
        for (const glm::dvec2& corner : flat) {
            corners.push_back(frame * glm::vec3(glm::vec2(corner), 0.0F) + glm::vec3(5, 6, 7));
        }
        if (round % 2 == 1) {
            std::reverse(corners.begin(), corners.end());
        }
        Skeleton skeleton = skeleton_of(corners);
        skeleton.polygons[0].frame = frame;
        const Mesh mesh = meshed(skeleton);
        CHECK(test::area_of(mesh) == Approx(std::abs(shoelace(flat))).epsilon(1e-5));
        CHECK(test::corners_turned_over(mesh) == 0);
        for (const glm::vec3& n : mesh.normals) {
            CHECK(glm::distance(n, frame * glm::vec3(0, 0, 1)) < 1e-4F);
        }
        // u increases to the turtle's right and v against its heading, from 0 to 1 over the
        // bounding box.
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 at = round % 2 == 1 ? flat[flat.size() - 1 - i] : flat[i];
            CHECK(glm::distance(mesh.texture_coordinates[i],
                                glm::vec2(at.x / 2.0, 1.0 - at.y / 2.0)) < 1e-4F);
        }
    }
}

TEST_CASE("polygons that are not flat or nearly degenerate") {
    const Mesh saddle = meshed(skeleton_of({{0, 0, 0}, {1, 0, 0.5}, {1, 1, 0}, {0, 1, 0.5}}));
    CHECK(saddle.indices.size() == 6);
    const Mesh bow = meshed(skeleton_of({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}));
    CHECK(bow.indices.size() >= 3);
    CHECK(bow.normals[0].z == 1.0F);
    CHECK(meshed(skeleton_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}})).positions.empty());
    CHECK(meshed(skeleton_of({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}})).positions.empty());
    const float large = 1e38F;
    CHECK(meshed(skeleton_of({{-large, 0, 0}, {large, 0, 0}, {0, large, 0}})).indices.size() == 3);
    // A polygon in the plane perpendicular to the heading.
    CHECK(meshed(skeleton_of({{0, 0, 0}, {1, 0, 0}, {0, 0, 1}})).indices.size() == 3);
}

TEST_CASE("polygons have a part for each colour and do not depend on threads") {
    Skeleton skeleton;
    std::mt19937 random(5);
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        const Corners corners = random_star(random, 3 + i % 9);
        Polygon polygon;
        polygon.first_corner = static_cast<std::uint32_t>(skeleton.corners.size());
        polygon.corner_count = static_cast<std::uint32_t>(corners.size());
        polygon.colour = static_cast<std::uint16_t>(i % 4);
        skeleton.polygons.push_back(polygon);
        for (const glm::dvec2& corner : corners) {
            skeleton.corners.emplace_back(corner.x, corner.y, 0.1 * i);
        }
    }
    const Mesh one = meshed(skeleton, {.threads = 1});
    const Mesh three = meshed(skeleton, {.threads = 3});
    CHECK(one.positions == three.positions);
    CHECK(one.indices == three.indices);
    CHECK(one.texture_coordinates == three.texture_coordinates);
    REQUIRE(one.materials.size() == 3); // colours 0 and 1 are leaf green
    CHECK(one.materials[0].name == "polygon");
    CHECK(one.materials[0].kind == MaterialKind::Leaf);
    for (const Material& material : one.materials) {
        CHECK(material.two_sided);
        CHECK_FALSE(material.cut_out);
    }
    std::size_t corners = 0;
    for (const ItemColour colour : one.colours) {
        corners += colour == 1 ? 1U : 0U;
    }
    CHECK(corners > one.colours.size() / 3);
}

TEST_CASE("polygons over the limit leave the mesh empty") {
    MeshOptions options;
    options.max_bytes = 100;
    Mesh mesh;
    MeshBuilder builder(options, mesh);
    append_polygons(skeleton_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), {}, options, builder);
    CHECK(builder.finish() == Stop::Limit);
    CHECK(mesh.positions.empty());
}
