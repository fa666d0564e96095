// SPDX-License-Identifier: MIT
// Poses between two drawings of one segment. tests/runtime/pipeline grows whole plants.
#include "runtime/turtle/growth.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <numbers>
#include <vector>

using namespace lsys;

TEST_CASE("a segment that turns and lengthens is halfway at half the time") {
    Skeleton before;
    before.segments.emplace_back().length = 1.0F;
    before.segment_origins.push_back({0, 0});
    Skeleton after = before;
    after.segments[0].length = 3.0F;
    after.segments[0].frame =
        glm::angleAxis(-std::numbers::pi_v<float> / 2.0F, glm::vec3(0.0F, 0.0F, 1.0F));
    const SkeletonGrowth growth(before, after, 1, std::vector<Origin>{{0, 0}});
    CHECK(growth.counts().kept == 1);
    Skeleton pose;
    growth.pose(0.5, pose);
    REQUIRE(pose.segments.size() == 1);
    CHECK(pose.segments[0].length == 2.0F);
    const float half = std::sqrt(0.5F);
    CHECK(glm::distance(heading(pose.segments[0].frame), glm::vec3(half, half, 0.0F)) < 1e-6F);
}
