// SPDX-License-Identifier: MIT
#include "viewer/scene/lines.h"

#include <catch2/catch.hpp>

using namespace lsys;
using namespace lsys::view;

namespace {

/// A stem of two segments, and a branch at the end of the first.
Skeleton forked() {
    Skeleton skeleton;
    Segment segment;
    segment.length = 1.0F;
    skeleton.segments.push_back(segment);
    segment.base = {0.0F, 1.0F, 0.0F};
    segment.parent = 0;
    skeleton.segments.push_back(segment);
    segment.order = 1;
    skeleton.segments.push_back(segment);
    return skeleton;
}

} // namespace

TEST_CASE("lines of a skeleton are its segments and outlines") {
    Skeleton skeleton = forked();
    CHECK(make_lines(skeleton, LineKind::None).empty());
    const std::vector<LineVertex> lines = make_lines(skeleton, LineKind::Skeleton);
    REQUIRE(lines.size() == 6);
    CHECK(lines[3].position == glm::vec3(0.0F, 2.0F, 0.0F));
    CHECK(lines[0].colour == lines[2].colour);
    CHECK(lines[0].colour != lines[4].colour);
    for (const float x : {0.0F, 1.0F, 2.0F}) {
        skeleton.corners.push_back({x, x * x, 0.0F});
    }
    Polygon polygon;
    polygon.corner_count = 3;
    skeleton.polygons.push_back(polygon);
    const std::vector<LineVertex> outlined = make_lines(skeleton, LineKind::Skeleton);
    REQUIRE(outlined.size() == 12);
    CHECK(outlined[11].position == skeleton.corners[0]);
}

TEST_CASE("the path of the turtle shows where it jumped") {
    const std::vector<LineVertex> path = make_lines(forked(), LineKind::TurtlePath);
    // The first line is the jump back to the fork; the lines of the two stem segments and of the
    // branch are drawn over it.
    REQUIRE(path.size() == 8);
    CHECK(path[0].position == glm::vec3(0.0F, 2.0F, 0.0F));
    CHECK(path[1].position == glm::vec3(0.0F, 1.0F, 0.0F));
    CHECK(path[0].colour == path[1].colour);
    CHECK(path[2].position == glm::vec3(0.0F));
    CHECK(path[7].position == glm::vec3(0.0F, 2.0F, 0.0F));
    for (std::size_t i = 2; i < path.size(); ++i) {
        CHECK(path[i].colour != path[0].colour);
    }
    CHECK(path[2].colour != path[6].colour);
}
