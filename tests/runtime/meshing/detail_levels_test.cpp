// SPDX-License-Identifier: MIT
// Levels of detail of small plants. tests/levels compares levels of samples in pictures.
#include "runtime/meshing/detail_levels.h"
#include "runtime/meshing/impl/thinning.h"
#include "tests/support/plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <cmath>

namespace lsys {

namespace {

DetailLevels planned(const Skeleton& skeleton, const DetailChain& chain) {
    DetailLevels levels;
    REQUIRE(plan_detail_levels(skeleton, {}, {.threads = 1}, chain, levels) == std::nullopt);
    return levels;
}

Mesh level_mesh(const Skeleton& skeleton, const DetailLevels& levels, std::size_t number) {
    Mesh mesh;
    REQUIRE(make_detail_mesh(skeleton, {}, levels, number, {.threads = 1}, mesh) == std::nullopt);
    return mesh;
}

/// Adds `count` triangular leaves of about `size`, at most `reach` from the stem between the ground
/// and `height`.
void add_leaves(Skeleton& skeleton, std::uint32_t count, float size, float reach, float height) {
    test::RandomNumbers numbers(3);
    for (std::uint32_t i = 0; i < count; ++i) {
        skeleton.polygons.push_back(
            {.first_corner = static_cast<std::uint32_t>(skeleton.corners.size()),
             .corner_count = 3});
        const glm::vec3 middle =
            reach * numbers.direction() + glm::vec3(0.0F, numbers.uniform(0.0F, height), 0.0F);
        for (int corner = 0; corner < 3; ++corner) {
            skeleton.corners.push_back(middle + size * numbers.direction());
        }
    }
}

/// A stem of 4 m that winds as a screw.
Skeleton winding_stem() {
    constexpr std::uint32_t kPieces = 240;
    constexpr float kTurn = 0.66F; // radians from a segment to the next
    test::Plant plant;
    std::uint32_t last = kNoSegment;
    for (std::uint32_t i = 0; i < kPieces; ++i) {
        const float angle = kTurn * static_cast<float>(i);
        last = plant.add(last, {0.04F * std::sin(angle), 1.0F, 0.04F * std::cos(angle)},
                         4.0F / static_cast<float>(kPieces),
                         {.base_radius = 0.04F, .tip_radius = 0.04F});
    }
    return plant.skeleton();
}

} // namespace

TEST_CASE("each level of a tree has a third to a half of the triangles of the one before",
          "[mesh]") {
    const bool has_leaves = GENERATE(true, false);
    CAPTURE(has_leaves);
    Skeleton skeleton = test::random_tree(1, has_leaves ? 1 : 3);
    if (has_leaves) {
        add_leaves(skeleton, 2000, 0.1F, 2.0F, 4.0F);
    }
    const DetailLevels levels = planned(skeleton, {});
    REQUIRE(levels.levels.size() >= 5);
    for (std::size_t k = 0; k < levels.levels.size(); ++k) {
        CAPTURE(k);
        const std::uint64_t triangles = levels.levels[k].triangles;
        CHECK(level_mesh(skeleton, levels, k).indices.size() == 3 * triangles);
        if (k > 0) {
            CHECK(levels.levels[k - 1].triangles >= 2 * triangles);
            CHECK(levels.levels[k - 1].triangles <= 3 * triangles);
        }
    }
    CHECK(levels.levels.back().triangles <= kMinDetailTriangles);
}

TEST_CASE("a fitted level with too few triangles keeps the leaves of the finer level", "[mesh]") {
    // Fitting makes the wood thinner, and a thinner stem needs fewer rings.
    Skeleton skeleton = winding_stem();
    add_leaves(skeleton, 1300, 0.06F, 0.24F, 4.0F);
    const DetailLevels plan = planned(skeleton, {.first_fitted = kNoDetailLevel});
    const DetailLevels fitted = planned(skeleton, {});
    REQUIRE(fitted.levels.size() == plan.levels.size());
    std::size_t short_levels = 0;
    for (std::size_t k = 1; k < plan.levels.size(); ++k) {
        const auto wanted = static_cast<double>(plan.levels[k].triangles);
        if (static_cast<double>(fitted.levels[k].triangles) < 0.9 * wanted) {
            ++short_levels;
            CAPTURE(k);
            CHECK(plan.levels[k].foliage < plan.levels[k - 1].foliage);
            CHECK(fitted.levels[k].foliage == plan.levels[k - 1].foliage);
        }
    }
    CHECK(short_levels > 0);
}

TEST_CASE("a polygon that stays has the area of all, around its own middle", "[mesh]") {
    Skeleton skeleton;
    constexpr std::uint32_t kCount = 4;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        skeleton.polygons.push_back({.first_corner = 3 * i, .corner_count = 3});
        const glm::vec3 middle(5.0F * static_cast<float>(i), 1.0F, 2.0F);
        for (const glm::vec3& out :
             {glm::vec3(2, 0, -1), glm::vec3(-1, 0, 2), glm::vec3(-1, 0, -1)}) {
            skeleton.corners.push_back(middle + out);
        }
    }
    const ThinningOrder order = thinning_order(skeleton);
    const std::vector<FoliageShape> shapes = foliage_shapes(order, {}, 0);
    Skeleton thin;
    LargeVector<std::uint32_t> segments;
    thin_skeleton(skeleton, order, {.foliage = 1}, shapes, shapes, thin, segments);
    REQUIRE(thin.polygons.size() == 1);
    REQUIRE(thin.corners.size() == 3);
    const glm::vec3 middle(5.0F * static_cast<float>(order.foliage[0]), 1.0F, 2.0F);
    // A quarter of the polygons stays, so each is twice as long.
    CHECK(glm::distance(thin.corners[0], middle + glm::vec3(4, 0, -2)) < 1e-5F);
    CHECK(glm::distance(thin.corners[1], middle + glm::vec3(-2, 0, 4)) < 1e-5F);
    CHECK(glm::distance(thin.corners[2], middle + glm::vec3(-2, 0, -2)) < 1e-5F);
}

TEST_CASE("the tint of a level colours materials unless a part has several colours", "[mesh]") {
    test::Plant plant;
    const std::uint32_t first = plant.add(kNoSegment, {0, 1, 0}, 1.0F, {.colour = 3});
    plant.add(first, {0, 1, 0}, 1.0F, {.colour = 20});
    DetailLevels levels;
    levels.levels.emplace_back().tint = {0.5F, 0.25F, 1.0F};
    const Mesh tubes = level_mesh(plant.skeleton(), levels, 0); // each colour is a part
    REQUIRE(tubes.materials.size() == 2);
    CHECK(tubes.colours.empty());
    CHECK(glm::vec3(tubes.materials[0].colour) == levels.levels[0].tint * palette_colour(3));
    CHECK(glm::vec3(tubes.materials[1].colour) == levels.levels[0].tint * palette_colour(20));
    // Smoothed boxes share vertices between faces of both colours.
    levels.levels[0].options = {.method = MeshMethod::Boxes, .subdivisions = 2};
    const Mesh boxes = level_mesh(plant.skeleton(), levels, 0);
    REQUIRE(boxes.materials.size() == 2);
    CHECK(boxes.colours.size() == boxes.positions.size());
    CHECK(glm::vec3(boxes.materials[0].colour) == palette_colour(3));
    CHECK(glm::vec3(boxes.materials[1].colour) == palette_colour(20));
}

} // namespace lsys
