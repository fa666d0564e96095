// SPDX-License-Identifier: MIT
// Compares the list of all branches of a forest with trees that are expanded one by one.
#include "runtime/forest/instance_list.h"
#include "runtime/forest/instance_meshes.h"
#include "tests/support/forest.h"

#include <catch2/catch.hpp>

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace lsys;

namespace {

constexpr std::uint64_t kKey = 7;

/// `count` trees of two species, in turn.
Forest two_species(std::uint32_t count) {
    Forest forest;
    forest.key = kKey;
    for (const std::string second : {"[-A]", "//A"}) {
        const std::string grammar = "#set names letters; #w : A; #p : A : ~ 0.5 : F[+A]" + second +
                                    "; #q : A : ~ 0.5 : FF[&A]F;";
        ForestSpecies& species = forest.species.emplace_back();
        species.stages.emplace_back().cache = test::plant(grammar, 5, 0.6F, test::heroes(4)).cache;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        Tree tree = test::tree_of(i);
        tree.position = {static_cast<float>(i % 70), 0.0F, static_cast<float>(i / 70)};
        tree.species = static_cast<std::uint16_t>(i % 2);
        forest.trees.push_back(tree);
    }
    return forest;
}

} // namespace

TEST_CASE("the list of all branches is grouped by mesh and has each branch of each tree once") {
    const Forest forest = two_species(5000); // more than one piece of 4,096 trees
    InstanceList list;
    REQUIRE(make_instance_list(forest, {.threads = 2}, list) == std::nullopt);
    // Groups follow each other, in the order of species and instance.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> group_of;
    std::vector<std::uint64_t> next; // by group: index of the next instance
    std::uint64_t end = 0;
    for (const InstanceGroup& group : list.groups) {
        const std::pair key(group.species, group.instance);
        CHECK((group_of.empty() || group_of.rbegin()->first < key));
        group_of.emplace(key, next.size());
        CHECK(group.first == end);
        CHECK(group.count > 0);
        end += group.count;
        next.push_back(group.first);
    }
    REQUIRE(list.instances.size() == end);
    std::uint64_t wrong = 0;
    for (std::uint32_t i = 0; i < forest.trees.size(); ++i) {
        const Tree& tree = forest.trees[i];
        const InstanceCache& cache = forest.cache_of(tree);
        TreeExpander(cache, kKey).expand(tree, [&](const BranchInstance& branch) {
            const std::size_t group = group_of.at({tree.species, branch.instance});
            const ForestInstance& found = list.instances[next[group]++];
            const InstancePose pose = pose_of(branch, cache.instances[branch.instance]);
            const bool equal = found.tree == i && found.group == group &&
                               found.position == pose.translation &&
                               found.rotation == pose.rotation && found.scale == pose.scale;
            wrong += equal ? 0U : 1U;
        });
    }
    CHECK(wrong == 0);
    for (std::size_t group = 0; group < next.size(); ++group) {
        CHECK(next[group] == list.groups[group].first + list.groups[group].count);
    }
}

TEST_CASE("the list of all branches keeps to its limit and can be cancelled") {
    const Forest forest = two_species(50);
    InstanceList list;
    REQUIRE(make_instance_list(forest, {}, list) == std::nullopt);
    const std::uint64_t bytes = list.instances.size() * sizeof(ForestInstance);
    CHECK(make_instance_list(forest, {.max_bytes = bytes}, list) == std::nullopt);
    CHECK(make_instance_list(forest, {.max_bytes = bytes - 1}, list) == Stop::Limit);
    const std::atomic<bool> cancelled = true;
    CHECK(make_instance_list(forest, {.cancelled = &cancelled}, list) == Stop::Cancelled);
}
