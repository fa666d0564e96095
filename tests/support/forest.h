// SPDX-License-Identifier: MIT
// Makes instance caches and trees from grammar texts, for tests of instancing.
#pragma once

#include "compiler/instancing/instance.h"
#include "runtime/forest/instance_cache.h"
#include "tests/compiler/compile_text.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lsys::test {

struct Planted {
    InstancedSystem system;
    InstanceCache cache;
};

/// Options with `count` heroes.
[[nodiscard]] CacheOptions heroes(std::uint32_t count, std::uint64_t seed = 0);
/// A tree at the origin with this number.
[[nodiscard]] Tree tree_of(std::uint32_t number);

/// Compiles a grammar for instancing, and makes an instance cache. Fails the test if this fails.
[[nodiscard]] Planted
plant(const std::string& grammar, std::uint32_t generations, float rho, CacheOptions options);

/// The skeleton of the plant, derived without instancing.
[[nodiscard]] Skeleton
plain_plant(const std::string& grammar, std::uint32_t generations, std::uint64_t seed);

/// A segment in a tree.
struct TreeSegment {
    glm::dvec3 base{};
    glm::dvec3 tip{};
    float base_radius = 0.0F;
    float tip_radius = 0.0F;
    std::uint32_t order = 0; // branching order: number of enclosing branches
};
[[nodiscard]] std::vector<TreeSegment>
segments_of(const InstanceCache& cache, const Tree& tree, std::uint64_t key);
[[nodiscard]] std::vector<TreeSegment> segments_of(const Skeleton& skeleton);

/// The number of segments of `a` for which `b` has no equal segment within `distance` (m).
[[nodiscard]] std::size_t count_unmatched(const std::vector<TreeSegment>& a,
                                          const std::vector<TreeSegment>& b,
                                          double distance);

} // namespace lsys::test
