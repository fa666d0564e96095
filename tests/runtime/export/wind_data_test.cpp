// SPDX-License-Identifier: MIT
// Compares wind data of vertices with sums over the segments from the pivot.
#include "runtime/export/impl/wind_data.h"
#include "tests/runtime/plants.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

using namespace lsys;
using namespace lsys::test;

namespace {

/// A trunk of three segments; a thin branch of two segments begins at the first.
Skeleton forked() {
    Skeleton plant;
    const std::uint32_t base = add_segment(plant, kNoSegment, leaning(0), rod(2, 0.2F, 1, 1));
    const std::uint32_t bough = add_segment(plant, base, leaning(1), rod(1, 0.05F, 1, 1));
    add_segment(plant, bough, leaning(1), rod(3, 0.02F, 1, 1));
    const std::uint32_t top = add_segment(plant, base, leaning(0), rod(2, 0.1F, 1, 1));
    add_segment(plant, top, leaning(0), rod(1, 0.1F, 1, 1));
    return plant;
}

/// Displacement of the end of `path` for a branch of even stress, by definition: each segment turns
/// by length / radius about its base, and this angle times the length from the base of the segment
/// to the end of `path` is added to the displacement.
double bending(const Skeleton& plant, const std::vector<std::uint32_t>& path) {
    double sum = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const Segment& joint = plant.segments[path[i]];
        double lever = 0.0;
        for (std::size_t k = i; k < path.size(); ++k) {
            lever += static_cast<double>(plant.segments[path[k]].length);
        }
        sum += lever * static_cast<double>(joint.length) / static_cast<double>(joint.base_radius);
    }
    return sum;
}

} // namespace

TEST_CASE("wind data have pivot, distance, phase and stiffness") {
    const Skeleton plant = forked();
    const WindData wind(plant);
    const auto at_end = [&](std::uint32_t segment) {
        return wind.at({segment, segment}, tip(plant.segments[segment]));
    };
    const WindVertex top = at_end(4);
    CHECK(top.pivot.x == 0.0F);
    CHECK(top.pivot.y == Approx(5.0F));
    CHECK(top.motion.x == 0.0F);
    CHECK(top.motion.y == 1.0F);
    const WindVertex bough = at_end(2);
    CHECK(bough.pivot.x == Approx(2.0F));
    CHECK(bough.pivot.y == Approx(4.0F));
    CHECK(bough.motion.x == Approx(0.618034F));
    CHECK(bough.motion.y == 0.0F);
    const WindVertex half = at_end(1);
    CHECK(half.pivot.y == Approx(1.0F));
    CHECK(half.motion.y == Approx(1.0 - bending(plant, {1}) / bending(plant, {1, 2})));
    const WindVertex start = wind.at({1, 1}, plant.segments[1].base);
    CHECK(start.pivot.y == 0.0F);
    CHECK(start.motion.y == 1.0F);
    // For a vertex beside a branch, the nearest point of the axis counts.
    const Segment& last = plant.segments[2];
    const glm::vec3 side = last.frame * glm::vec3(0.3F, 1.5F, 0.0F);
    CHECK(wind.at({2, 2}, last.base + side).pivot.y == Approx(2.5F));
    CHECK(wind.at({kNoSegment, kNoSegment}, {}).motion.y == 1.0F);
}

TEST_CASE("wind data of random trees are within their ranges and continuous along a branch") {
    const Skeleton plant = tree(2, 4);
    const WindData wind(plant);
    std::set<float> phases;
    float min_stiffness = 1.0F;
    for (std::uint32_t i = 0; i < plant.segments.size(); ++i) {
        const Segment& segment = plant.segments[i];
        const WindVertex end = wind.at({i, i}, tip(segment));
        const WindVertex start = wind.at({i, i}, segment.base);
        CHECK(end.motion.x >= 0.0F);
        CHECK(end.motion.x < 1.0F);
        CHECK(end.motion.y >= 0.0F);
        CHECK(end.motion.y <= start.motion.y);
        CHECK(end.pivot.y == Approx(start.pivot.y + segment.length).epsilon(1e-4));
        phases.insert(end.motion.x);
        min_stiffness = std::min(min_stiffness, end.motion.y);
        if (segment.parent < i) {
            const WindVertex before =
                wind.at({segment.parent, segment.parent}, tip(plant.segments[segment.parent]));
            CHECK(start.motion.y == Approx(before.motion.y).margin(1e-5));
        }
    }
    CHECK(phases.size() > 2);
    CHECK(min_stiffness == 0.0F);
}
