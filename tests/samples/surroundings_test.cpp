// SPDX-License-Identifier: MIT
// Facts of the samples whose plants sense what is around them: topiary, competing-tips, climber,
// roots-in-soil and two-trees. Distances are computed here from the numbers of the samples' scripts.
#include "runtime/pipeline/plant.h"
#include "runtime/program/host.h"
#include "tests/support/lsc_run.h"
#include "tests/support/sample_plants.h"

#include <catch2/catch.hpp>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace lsys;

std::string file_of(const std::string& name, const std::string& extension = ".lsys") {
    return std::string(LSYS_SOURCE_DIR) + "/samples/" + name + "/" + name + extension;
}

// The frame of topiary: a profile turned about +Y.

/// Radius and height of the rings of frame.obj from the bottom to the top, m.
std::vector<glm::dvec2> profile_of_frame() {
    std::istringstream lines(
        tests::read_text(std::string(LSYS_SOURCE_DIR) + "/samples/topiary/frame.obj"));
    std::vector<glm::dvec2> profile;
    std::vector<glm::dvec2> ends; // on the axis
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string key;
        double x = 0.0;
        double y = 0.0;
        double z = 0.0;
        if (!(words >> key >> x >> y >> z) || key != "v") {
            continue;
        }
        const double radius = std::hypot(x, z);
        if (radius == 0.0) {
            ends.emplace_back(0.0, y);
        } else if (profile.empty() || profile.back().y != y) {
            profile.emplace_back(radius, y);
        }
    }
    REQUIRE(ends.size() == 2);
    profile.insert(profile.begin(), ends[0]);
    profile.push_back(ends[1]);
    return profile;
}

/// Distance of a place from the solid of revolution of a profile, m; 0 inside.
double distance_from_turned(const std::vector<glm::dvec2>& profile, const glm::vec3& place) {
    const glm::dvec2 p(std::hypot(place.x, place.z), place.y);
    bool inside = false;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        const glm::dvec2 a = profile[i];
        const glm::dvec2 b = profile[i + 1];
        // The solid is to the left of the profile, towards the axis.
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
            inside = !inside;
        }
        const double along = glm::dot(p - a, b - a) / glm::dot(b - a, b - a);
        nearest = std::min(nearest, glm::length(p - a - (b - a) * std::clamp(along, 0.0, 1.0)));
    }
    return inside ? 0.0 : nearest;
}

// The wall of climber, of four boxes around its window.

struct Box {
    glm::dvec3 low;
    glm::dvec3 high;
};
const std::vector<Box> kWall = {{{-2, 0, -0.3}, {2, 1.1, 0}},
                                {{-2, 2.3, -0.3}, {2, 3, 0}},
                                {{-2, 1.1, -0.3}, {-0.55, 2.3, 0}},
                                {{0.55, 1.1, -0.3}, {2, 2.3, 0}}};

/// Distance of a place from the wall, m; 0 inside.
double distance_from_wall(const glm::vec3& place) {
    const glm::dvec3 p(place);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Box& box : kWall) {
        nearest = std::min(nearest, glm::length(p - glm::clamp(p, box.low, box.high)));
    }
    return nearest;
}

// What modules asked and were answered, from `lsc dump --stage environment`.

struct Asked {
    glm::dvec3 place{};
    double first = 0.0; // the first number of the answer
};

std::vector<Asked> asked(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"dump", "-q", "--stage", "environment"});
    const tests::LscRun run = tests::run_lsc(arguments, "");
    INFO(run.err);
    REQUIRE(run.status == 0);
    std::vector<Asked> all;
    const std::string position = "\"position\": [";
    const std::string answer = "\"answer\": [";
    for (std::size_t at = 0; (at = run.out.find(position, at)) != std::string::npos;) {
        Asked one;
        char comma = 0;
        std::istringstream place(run.out.substr(at + position.size(), 100));
        place >> one.place.x >> comma >> one.place.y >> comma >> one.place.z;
        at = run.out.find(answer, at);
        REQUIRE(at != std::string::npos);
        std::istringstream(run.out.substr(at + answer.size(), 40)) >> one.first;
        all.push_back(one);
    }
    return all;
}

/// The mean first number of the answers.
double mean_answer(const std::vector<Asked>& all) {
    double sum = 0.0;
    for (const Asked& one : all) {
        sum += one.first;
    }
    return sum / static_cast<double>(all.size());
}

// The trees of two-trees.

struct Crown {
    glm::dvec2 offset{}; // m, of the mean of its nodes from the trunk, along x and z
    double width = 0.0;  // m
};

/// Crowns of the trees of a skeleton: all ends of segments above the trunks, which are 1.1 m high.
std::vector<Crown> crowns_of(const Skeleton& skeleton) {
    std::vector<Crown> crowns;
    for (std::size_t i = 0; i < skeleton.segments.size();) {
        const glm::vec3 base = skeleton.segments[i].base;
        REQUIRE(skeleton.segments[i].parent == kNoSegment);
        Bounds bounds;
        glm::dvec2 sum{};
        double count = 0.0;
        do {
            const glm::vec3 node = tip(skeleton.segments[i]);
            if (node.y > 1.2F) {
                bounds.add(node);
                sum += glm::dvec2(node.x - base.x, node.z - base.z);
                count += 1.0;
            }
            ++i;
        } while (i < skeleton.segments.size() && skeleton.segments[i].parent != kNoSegment);
        const glm::vec3 extent = bounds.high - bounds.low;
        crowns.push_back({sum / count, std::max(extent.x, extent.z)});
    }
    return crowns;
}

} // namespace

TEST_CASE("no segment of the topiary is outside its frame by more than one segment") {
    const std::vector<glm::dvec2> profile = profile_of_frame();
    const Skeleton skeleton = test::sample_plant("topiary").skeleton;
    CHECK(skeleton.segments.size() > 10'000);
    std::size_t near_surface = 0;
    float top = 0.0F;
    for (const Segment& segment : skeleton.segments) {
        const double outside = std::max(distance_from_turned(profile, segment.base),
                                        distance_from_turned(profile, tip(segment)));
        if (outside > static_cast<double>(segment.length) + 1e-5) {
            FAIL_CHECK("a segment is " << outside << " m outside");
        }
        near_surface += outside > 0.0 ? 1 : 0;
        top = std::max(top, tip(segment).y);
    }
    CHECK(near_surface > 500); // the bush fills the frame
    CHECK(top > 1.7F);         // up to its top at 1.76 m
    // Buds that no cut wakes stay dormant.
    CHECK(test::sample_plant("topiary", {{"wakes", 1.0F}}).skeleton.segments.size() <
          skeleton.segments.size() / 2);
}

TEST_CASE("a tip of competing-tips forks exactly if no other is within its radius") {
    const std::string file = file_of("competing-tips");
    // The radius of the environment, rounded to binary32.
    const auto radius = static_cast<double>(0.22F);
    std::size_t expected = 0;
    for (const char* const n : {"6", "7", "8", "9", "10"}) {
        const std::vector<Asked> tips = asked({file, "-n", n});
        CAPTURE(n);
        CHECK((expected == 0 || tips.size() == expected));
        expected = tips.size();
        for (const Asked& one : tips) {
            std::size_t near = 0;
            for (const Asked& other : tips) {
                near += glm::length(one.place - other.place) < radius ? 1U : 0U;
            }
            CHECK(one.first == static_cast<double>(near - 1)); // without itself
            expected += near == 1 ? 1 : 0;
        }
    }
    CHECK(expected > 300);
    // Without competition every tip of the 15 boughs forks: far more tips.
    CHECK(asked({file, "-D", "radius=0.01", "-n", "10"}).size() > 3 * expected);
}

TEST_CASE("the climber keeps within its reach of the wall, outside it, and passes the window") {
    const Skeleton skeleton = test::sample_plant("climber").skeleton;
    std::size_t nodes = 0;
    std::size_t above = 0;
    for (const Segment& segment : skeleton.segments) {
        if (segment.length < 0.05F) {
            continue; // the stalk of a leaf
        }
        ++nodes;
        const glm::vec3 node = tip(segment);
        const double distance = distance_from_wall(node);
        if (!(distance > 0.0 && distance <= 0.12)) {
            FAIL_CHECK("a node is at " << distance << " m");
        }
        above += node.y > 2.4F ? 1 : 0;
    }
    CHECK(nodes > 3000);
    CHECK(above > 200);
}

TEST_CASE("roots find the wet patches of the soil") {
    const std::string file = file_of("roots-in-soil");
    const double wet = mean_answer(asked({file}));
    const double blind = mean_answer(asked({file, "-D", "turning=0"}));
    CAPTURE(wet, blind);
    CHECK(wet > 1.5 * blind);
    // The two large patches are 22 % of the soil (soil.py).
    double length = 0.0;
    double within = 0.0;
    for (const Segment& segment : test::sample_plant("roots-in-soil").skeleton.segments) {
        const glm::dvec3 base(segment.base);
        const glm::dvec2 place(base.x / 1.2 + 0.5, base.z / 1.2 + 0.5); // in widths of the map
        const double part = segment.length;
        const bool in_patch = glm::length(place - glm::dvec2(0.76, 0.3)) < 0.17 ||
                              glm::length(place - glm::dvec2(0.3, 0.78)) < 0.2;
        length += part;
        within += in_patch ? part : 0.0;
    }
    CAPTURE(within / length);
    CHECK(within > 0.6 * length);
}

TEST_CASE("crowns of two trees lean apart, and one alone stands over its trunk") {
    const std::vector<Crown> two = crowns_of(test::sample_plant("two-trees").skeleton);
    REQUIRE(two.size() == 2);
    CAPTURE(two[0].offset.x, two[0].width, two[1].offset.x, two[1].width);
    CHECK(two[0].offset.x < -0.05 * two[0].width);
    CHECK(two[1].offset.x > 0.05 * two[1].width);
    const std::vector<Crown> alone =
        crowns_of(test::sample_plant("two-trees", {{"trees", 1.0F}}).skeleton);
    REQUIRE(alone.size() == 1);
    CAPTURE(alone[0].offset.x, alone[0].offset.y, alone[0].width);
    CHECK(glm::length(alone[0].offset) < 0.05 * alone[0].width);
}
