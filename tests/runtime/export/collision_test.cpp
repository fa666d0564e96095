// SPDX-License-Identifier: MIT
#include "runtime/export/impl/collision.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>

using namespace lsys;

namespace {

double volume_of(const CollisionShape& shape) {
    double volume = 0.0;
    for (const auto& [a, b, c] : shape.triangles) {
        volume +=
            glm::dot(glm::dvec3(shape.vertices[a]),
                     glm::cross(glm::dvec3(shape.vertices[b]), glm::dvec3(shape.vertices[c])));
    }
    return volume / 6.0;
}

/// Whether each edge has two triangles, in opposite directions.
bool is_closed(const CollisionShape& shape) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& triangle : shape.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (!edges.insert({triangle[i], triangle[(i + 1) % 3]}).second) {
                return false;
            }
        }
    }
    return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        return edges.contains({edge.second, edge.first});
    });
}

ExportInfo info_with(CollisionKind kind, CollisionNames names) {
    ExportInfo info;
    info.name = "oak";
    info.collision = kind;
    info.collision_names = names;
    return info;
}

/// A pole of ten segments with a branch halfway up.
Skeleton pole() {
    test::Plant plant;
    std::uint32_t last = kNoSegment;
    for (int i = 0; i < 10; ++i) {
        last = plant.add(last, glm::vec3(0, 1, 0), 1.0F, {.base_radius = 0.5F, .tip_radius = 0.5F});
    }
    plant.add(4, glm::vec3(1, 0.5F, 0), 3.0F,
              {.base_radius = 0.2F, .tip_radius = 0.2F, .order = 1});
    return plant.skeleton();
}

} // namespace

TEST_CASE("the shapes of a straight pole with a bough are two capsules") {
    const std::vector<BoughPiece> pieces = find_boughs(pole());
    REQUIRE(pieces.size() == 2);
    CHECK(pieces[0].segments.size() == 10);
    CHECK(pieces[0].radius == 0.5F);
    CHECK(pieces[0].area == Approx(10.0));
    CHECK(glm::length(pieces[0].to - glm::vec3(0, 10, 0)) < 1e-4F);
    CHECK(pieces[1].segments.size() == 1);

    const auto shapes =
        make_collision(pole(), info_with(CollisionKind::Capsules, CollisionNames::Unreal));
    REQUIRE(shapes.size() == 2);
    CHECK(shapes[0].name == "UCP_oak_00");
    CHECK(shapes[1].name == "UCP_oak_01");
    for (const CollisionShape& shape : shapes) {
        CHECK(is_closed(shape));
        CHECK(volume_of(shape) > 0.0);
    }
    // Importers recognise a capsule if its poles are the two vertices farthest apart and the
    // greatest distance from the line between them is the radius.
    const auto& vertices = shapes[0].vertices;
    float longest = 0.0F;
    float widest = 0.0F;
    for (const glm::vec3& a : vertices) {
        for (const glm::vec3& b : vertices) {
            longest = std::max(longest, glm::length(a - b));
        }
        widest = std::max(widest, glm::length(glm::vec2(a.x, a.z)));
    }
    CHECK(glm::length(vertices.front() - vertices.back()) == longest);
    CHECK(longest == Approx(10.0));
    CHECK(widest == Approx(0.5));
    // The shape is a prism of eight sides between two domes.
    CHECK(volume_of(shapes[0]) > 0.85 * std::numbers::pi * 0.25 * 9.333);
    CHECK(volume_of(shapes[0]) < std::numbers::pi * 0.25 * 9.334);
}

TEST_CASE("of children that are equal the first continues a bough") {
    test::Plant plant;
    const std::uint32_t trunk = plant.add(kNoSegment, glm::vec3(0, 1, 0), 1.0F);
    const std::uint32_t first = plant.add(trunk, glm::vec3(0.1F, 1, 0), 1.0F);
    const std::uint32_t second = plant.add(trunk, glm::vec3(-0.1F, 1, 0), 1.0F);
    const std::vector<BoughPiece> pieces = find_boughs(plant.skeleton());
    REQUIRE(pieces.size() == 2);
    CHECK(pieces[0].segments == std::vector<std::uint32_t>{trunk, first});
    CHECK(pieces[1].segments == std::vector<std::uint32_t>{second});
}

TEST_CASE("a trunk that tapers is cut where its radii differ by more than a factor of 1.6") {
    test::Plant plant;
    std::uint32_t last = kNoSegment;
    float radius = 1.0F; // m; 0.8^-2 = 1.5625, and 0.8^-3 = 1.95
    for (int i = 0; i < 10; ++i) {
        last = plant.add(last, glm::vec3(0, 1, 0), 1.0F,
                         {.base_radius = radius, .tip_radius = radius});
        radius *= 0.8F;
    }
    const std::vector<BoughPiece> pieces = find_boughs(plant.skeleton());
    REQUIRE(pieces.size() == 4);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(pieces[i].segments.size() == 3);
    }
    CHECK(pieces[3].segments.size() == 1);
}

TEST_CASE("hulls contain the joints of their segments") {
    const Skeleton plant = test::random_tree(4, 3);
    const std::vector<BoughPiece> pieces = find_boughs(plant);
    const auto shapes =
        make_collision(plant, info_with(CollisionKind::Hulls, CollisionNames::Godot));
    REQUIRE(shapes.size() == pieces.size());
    CHECK(shapes[0].name == "oak_00-convcolonly");
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        CHECK(is_closed(shapes[i]));
        CHECK(shapes[i].triangles.size() <= 255); // limit of PhysX
        const Segment& first = plant.segments[pieces[i].segments.front()];
        const glm::dvec3 middle(first.base + 0.5F * first.length * heading(first.frame));
        for (const auto& [a, b, c] : shapes[i].triangles) {
            const glm::dvec3 corner(shapes[i].vertices[a]);
            const glm::dvec3 normal = glm::cross(glm::dvec3(shapes[i].vertices[b]) - corner,
                                                 glm::dvec3(shapes[i].vertices[c]) - corner);
            CHECK(glm::dot(normal, middle - corner) < 0.0);
        }
    }
}

TEST_CASE("a tree has few shapes, for its thickest and longest parts") {
    const Skeleton plant = test::random_tree(7, 4);
    const std::vector<BoughPiece> pieces = find_boughs(plant);
    CHECK(pieces.size() >= 10);
    CHECK(pieces.size() <= kMaxCollisionShapes);
    double plant_area = 0.0;
    for (const Segment& segment : plant.segments) {
        plant_area +=
            static_cast<double>(segment.length * (segment.base_radius + segment.tip_radius));
    }
    double pieces_area = 0.0;
    std::set<std::uint32_t> segments;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        pieces_area += pieces[i].area;
        segments.insert(pieces[i].segments.begin(), pieces[i].segments.end());
        CHECK((i == 0 || pieces[i].area <= pieces[i - 1].area));
    }
    std::size_t count = 0;
    for (const BoughPiece& piece : pieces) {
        count += piece.segments.size();
    }
    CHECK(count == segments.size()); // each segment is in one shape
    CHECK((pieces_area >= 0.9 * plant_area || pieces.size() == kMaxCollisionShapes));
    CHECK(segments.contains(0));
}

TEST_CASE("a plant without stems has no collision shapes") {
    Skeleton plant;
    plant.objects.push_back({.kind = TurtleOperation::Sphere, .size = 2.0F});
    const ExportInfo info = info_with(CollisionKind::Capsules, CollisionNames::Unity);
    CHECK(make_collision(plant, info).empty());
    const auto shapes = make_collision(pole(), info);
    CHECK(shapes[1].name == "oak_collider_01");
    CHECK(make_collision(pole(), info_with(CollisionKind::None, CollisionNames::Unity)).empty());
}
