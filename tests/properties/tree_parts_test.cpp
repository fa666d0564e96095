// SPDX-License-Identifier: MIT
// Compares parts of trees, and bounds over all trees of a cache, with trees that are expanded.
#include "runtime/forest/instance_meshes.h"
#include "runtime/forest/instance_skeleton.h"
#include "runtime/forest/tree_bounds.h"
#include "runtime/forest/tree_heights.h"
#include "runtime/meshing/mesh.h"
#include "tests/support/forest.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace lsys;
using test::count_unmatched;
using test::heroes;
using test::plain_plant;
using test::plant;
using test::Planted;
using test::segments_of;
using test::tree_of;
using test::TreeSegment;

namespace {

constexpr std::uint64_t kKey = 5;

const std::string kBush = "#set names letters; #w : A;"
                          "#p : A : ~ 0.5 : F[+A][-A]/A; #q : A : ~ 0.3 : F[+A]//A;"
                          "#r : A : ~ 0.2 : FF[&A]F;";

std::vector<BranchInstance> branches_of(const InstanceCache& cache, std::uint32_t number) {
    std::vector<BranchInstance> branches;
    TreeExpander(cache, kKey).expand(tree_of(number), [&](const BranchInstance& branch) {
        branches.push_back(branch);
    });
    return branches;
}

/// The segments of a part that is placed at a branch.
std::vector<TreeSegment>
placed(const Skeleton& part, const BranchInstance& branch, const InstanceCache& cache) {
    const InstancePose pose = pose_of(branch, cache.instances[branch.instance]);
    std::vector<TreeSegment> segments = segments_of(part);
    for (TreeSegment& segment : segments) {
        const glm::dquat rotation(pose.rotation);
        segment.base = glm::dvec3(pose.translation) + rotation * segment.base;
        segment.tip = glm::dvec3(pose.translation) + rotation * segment.tip;
        segment.order += branch.order - cache.instances[branch.instance].order;
    }
    return segments;
}

double distance_to(const TreeSegment& segment, const glm::dvec3& point) {
    const glm::dvec3 along = segment.tip - segment.base;
    const double square = glm::dot(along, along);
    const double at =
        square > 0.0 ? std::clamp(glm::dot(point - segment.base, along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(point, segment.base + at * along);
}

/// The largest distance from an end of a segment of `from` to the nearest segment of `to`.
double farthest(const std::vector<TreeSegment>& from, const std::vector<TreeSegment>& to) {
    double largest = 0.0;
    for (const TreeSegment& segment : from) {
        for (const glm::dvec3& point : {segment.base, segment.tip}) {
            double nearest = std::numeric_limits<double>::infinity();
            for (const TreeSegment& other : to) {
                nearest = std::min(nearest, distance_to(other, point));
            }
            largest = std::max(largest, nearest);
        }
    }
    return largest;
}

/// For each instance, the distance from its entry to its farthest point.
std::vector<double> surface_reaches(const InstanceCache& cache) {
    const PartSkeletons skeletons(cache);
    std::vector<double> reach;
    for (std::uint32_t i = 0; i < cache.instances.size(); ++i) {
        double& largest = reach.emplace_back(0.0);
        for (const TreeSegment& segment : segments_of(skeletons.alone(i))) {
            const glm::dvec3& entry = cache.instances[i].position;
            largest = std::max(
                {largest, glm::distance(segment.base, entry), glm::distance(segment.tip, entry)});
        }
    }
    return reach;
}

} // namespace

TEST_CASE("a tree expanded to some instances has the choices of the whole tree") {
    const Planted planted = plant(kBush, 6, 0.6F, heroes(4));
    for (std::uint32_t number = 0; number < 40; ++number) {
        const std::vector<BranchInstance> all = branches_of(planted.cache, number);
        const auto expanded = [&](const auto& continues) {
            std::vector<BranchInstance> list;
            TreeExpander(planted.cache, kKey)
                .expand_until(tree_of(number), [&](const BranchInstance& branch) {
                    list.push_back(branch);
                    return continues(branch);
                });
            return list;
        };
        const auto same = [](const BranchInstance& a, const BranchInstance& b) {
            return a.instance == b.instance && a.position == b.position &&
                   a.rotation == b.rotation && a.order == b.order;
        };
        const auto whole = expanded([](const BranchInstance&) { return true; });
        CHECK(std::equal(whole.begin(), whole.end(), all.begin(), all.end(), same));
        CHECK(expanded([](const BranchInstance&) { return false; }).size() == 1);
        // The listed branches have the order, places and instances of the whole tree.
        const auto some = expanded([](const BranchInstance& branch) { return branch.order < 2; });
        auto next = all.begin();
        for (const BranchInstance& branch : some) {
            next = std::find_if(next, all.end(),
                                [&](const BranchInstance& each) { return same(branch, each); });
            REQUIRE(next != all.end());
        }
    }
}

TEST_CASE("the parts of a tree alone are the tree") {
    const Planted planted = plant(kBush, 6, 0.6F, heroes(4));
    const PartSkeletons skeletons(planted.cache);
    for (std::uint32_t number = 0; number < 20; ++number) {
        std::vector<TreeSegment> parts;
        for (const BranchInstance& branch : branches_of(planted.cache, number)) {
            const auto part = placed(skeletons.alone(branch.instance), branch, planted.cache);
            parts.insert(parts.end(), part.begin(), part.end());
        }
        const auto tree = segments_of(planted.cache, tree_of(number), kKey);
        CHECK(parts.size() == tree.size());
        CHECK(count_unmatched(parts, tree, 1e-4) == 0);
        CHECK(count_unmatched(tree, parts, 1e-4) == 0);
    }
}

TEST_CASE("stand-ins at the exits of a plant without chance give the plant") {
    const std::string grammar =
        "#w : A(1, 0.3); #p : A(l, w) : * : !(w) F(l) [&(30) A(l*0.8, w*0.7)] /(137)"
        "[&(50) A(l*0.6, w*0.5)] A(l*0.9, w*0.8);";
    const Planted planted = plant(grammar, 5, 0.6F, heroes(2));
    const InstanceCache& cache = planted.cache;
    REQUIRE(!cache.exits.empty());
    const std::uint32_t root = cache.variants[cache.slots[0].first_variant];
    const auto tree = segments_of(PartSkeletons(cache).whole(root));
    const auto plain = segments_of(plain_plant(grammar, 5, 0));
    CHECK(tree.size() == plain.size());
    CHECK(count_unmatched(tree, plain, 1e-4) == 0);
    CHECK(count_unmatched(plain, tree, 1e-4) == 0);
}

TEST_CASE("only the instances with the base of a tree flare") {
    const Planted planted = plant(
        "#set flare 2 0.5 5; #w : A(1); #p : A(l) : * : F(l) [&(80) A(l*0.8)] [&(40) A(l*0.6)]"
        "A(l*0.9);",
        5, 0.6F, heroes(2));
    const PartSkeletons skeletons(planted.cache);
    std::size_t flaring = 0;
    for (std::uint32_t i = 0; i < planted.cache.instances.size(); ++i) {
        Skeleton part = skeletons.alone(i);
        const auto widest_base = [&] {
            Mesh mesh;
            REQUIRE(make_mesh(part, {}, {.threads = 1}, mesh) == std::nullopt);
            float most = 0.0F;
            for (const glm::vec3& p : mesh.positions) {
                most = std::max(most, std::abs(p.y) < 1e-4F ? std::hypot(p.x, p.z) : 0.0F);
            }
            return std::pair(most, mesh.positions.size());
        };
        const auto with = widest_base();
        part.tube_shape = {};
        const auto without = widest_base();
        CHECK((with != without) == (planted.cache.instances[i].slot == 0));
        flaring += with != without ? 1U : 0U;
    }
    CHECK(flaring > 0);
    CHECK(flaring < planted.cache.instances.size());
}

TEST_CASE("no tree goes beyond the bounds of its cache") {
    const float rho = GENERATE(0.3F, 0.7F);
    const Planted planted = plant(kBush, 6, rho, heroes(4));
    const InstanceCache& cache = planted.cache;
    const TreeBounds bounds = tree_bounds(cache, surface_reaches(cache));
    const PartSkeletons skeletons(cache);
    // Largest ratio of the actual deviation to bounds.deviation. The deviation is the distance
    // between a tree and PartSkeletons::whole() of its root instance, which puts the first instance
    // of a slot in place of every instance with the same key.
    double largest = 0.0;
    for (std::uint32_t number = 0; number < 60; ++number) {
        const std::uint32_t root = branches_of(cache, number).front().instance;
        const auto tree = segments_of(cache, tree_of(number), kKey);
        for (const TreeSegment& segment : tree) {
            REQUIRE(glm::length(segment.tip) <= bounds.reach[root] + 1e-4);
        }
        BranchInstance at;
        at.instance = root;
        const auto whole = placed(skeletons.whole(root), at, cache);
        const double apart = std::max(farthest(tree, whole), farthest(whole, tree));
        REQUIRE(apart <= bounds.deviation[root] + 1e-4);
        if (bounds.deviation[root] > 0.0) {
            largest = std::max(largest, apart / bounds.deviation[root]);
        }
    }
    CHECK(largest > 0.1); // the bound is at most ten times too large
}

TEST_CASE("no tree is lower than the bound on which its largest scale rests") {
    Planted planted = plant(kBush, 6, 0.7F, heroes(4));
    Forest forest;
    forest.key = kKey;
    ForestSpecies& species = forest.species.emplace_back();
    species.stages.push_back({6, std::move(planted.cache)});
    const std::vector<double> heights{10.0};
    const TreeSizer sizer(heights, forest);
    std::vector<Tree> trees;
    for (std::uint32_t number = 0; number < 400; ++number) {
        trees.push_back(tree_of(number));
    }
    REQUIRE(sizer.size(trees) == std::nullopt);
    float largest = 0.0F;
    for (const Tree& tree : trees) {
        largest = std::max(largest, tree.scale);
    }
    const double bound = sizer.max_factor(0);
    CHECK(static_cast<double>(largest) <= bound * (1.0 + 1e-6));
    CHECK(bound < 3.0 * static_cast<double>(largest));
}
