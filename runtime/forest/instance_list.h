// SPDX-License-Identifier: MIT
// InstanceList: all branch instances of a forest as one array, grouped by mesh for renderers. Made
// by make_instance_list(); used by the public library.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/base/large_vector.h"
#include "runtime/forest/forest.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// An instance: its mesh, in hero coordinates, is scaled, then rotated, then translated.
struct ForestInstance {
    glm::vec3 position{}; // m
    float scale = 1.0F;
    glm::quat rotation{1.0F, 0.0F, 0.0F, 0.0F};
    std::uint32_t tree = 0;  // index in Forest::trees
    std::uint32_t group = 0; // index in InstanceList::groups
};
static_assert(sizeof(ForestInstance) == 40);

/// All branches that are copies of one instance of a cache: a range of InstanceList::instances.
struct InstanceGroup {
    std::uint32_t species = 0;  // index in Forest::species
    std::uint32_t stage = 0;    // index in ForestSpecies::stages
    std::uint32_t instance = 0; // index in InstanceCache::instances
    std::uint64_t first = 0;    // index in InstanceList::instances
    std::uint64_t count = 0;    // above 0
};

struct InstanceList {
    std::vector<InstanceGroup> groups; // in ascending order of species, stage and instance
    /// Sorted by group, then in the order of trees and of TreeExpander::expand().
    LargeVector<ForestInstance> instances;
};

struct InstanceListOptions {
    std::uint32_t threads = 0;                    // 0: as many as the machine has
    std::uint64_t max_bytes = ~std::uint64_t{0};  // limit of the instances
    const std::atomic<bool>* cancelled = nullptr; // may be null
};

/// Expands every tree, twice: to count and to write. The list is the same for any number of
/// threads. Returns Limit for more than `max_bytes`, checked before memory is allocated;
/// OutOfMemory; Cancelled.
[[nodiscard]] std::optional<Stop>
make_instance_list(const Forest& forest, const InstanceListOptions& options, InstanceList& list);

} // namespace lsys
