// SPDX-License-Identifier: MIT
#include "runtime/export/placed_plant.h"
#include "runtime/physics/animation.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

using namespace lsys;

namespace {

/// Two segments that begin at (1, 2, 3).
Skeleton stem() {
    test::Plant plant;
    plant.add(plant.add(kNoSegment, glm::vec3(0, 1, 0), 2.0F), glm::vec3(1, 0, 0), 4.0F);
    Skeleton skeleton = plant.skeleton();
    for (Segment& segment : skeleton.segments) {
        segment.base += glm::vec3(1, 2, 3);
    }
    skeleton.objects.push_back({.position = {1, 4, 3}, .size = 0.5F});
    skeleton.corners = {{1, 2, 3}, {2, 2, 3}, {1, 3, 3}};
    skeleton.polygons.push_back({.first_corner = 0, .corner_count = 3});
    return skeleton;
}

} // namespace

TEST_CASE("the pivot is the start of the turtle, the base of the stem or the middle of the box") {
    const Skeleton plant = stem();
    CHECK(pivot_of(plant, PlantPivot::Origin) == glm::vec3(0.0F));
    CHECK(pivot_of(plant, PlantPivot::Base) == glm::vec3(1, 2, 3));
    CHECK(glm::length(pivot_of(plant, PlantPivot::Centre) - glm::vec3(3, 3, 3)) < 1e-5F);
    Skeleton leaves;
    leaves.corners = {{0, 1, 0}, {2, 1, 4}, {2, 5, 4}};
    leaves.polygons.push_back({.first_corner = 0, .corner_count = 3});
    CHECK(pivot_of(leaves, PlantPivot::Base) == glm::vec3(1, 1, 2));
    CHECK(pivot_of(Skeleton{}, PlantPivot::Base) == glm::vec3(0.0F));
}

TEST_CASE("placing moves and scales all parts of a plant") {
    const PlantPlacement placement{{1, 2, 3}, 100.0F};
    Skeleton plant = stem();
    place(placement, plant);
    CHECK(plant.segments[0].base == glm::vec3(0.0F));
    CHECK(plant.segments[1].length == 400.0F);
    CHECK(plant.segments[1].base_radius == Approx(10.0));
    CHECK(glm::length(tip(plant.segments[0]) - plant.segments[1].base) < 1e-4F);
    CHECK(plant.objects[0].position == glm::vec3(0, 200, 0));
    CHECK(plant.objects[0].size == 50.0F);
    CHECK(plant.corners[1] == glm::vec3(100, 0, 0));
    Mesh mesh;
    mesh.positions = {{1, 2, 3}, {1.5F, 2, 3}};
    place(placement, mesh);
    CHECK(mesh.positions[1] == glm::vec3(50, 0, 0));
    PlantAnimation animation;
    animation.places.resize(1);
    animation.places[0].base = {2, 2, 3};
    place(placement, animation);
    CHECK(animation.places[0].base == glm::vec3(100, 0, 0));
}
