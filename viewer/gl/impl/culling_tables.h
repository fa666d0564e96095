// SPDX-License-Identifier: MIT
// CullingTables: forms, slots, instances and exits of a forest as words for the compute shaders
// that expand trees; shaders/culling_tables.glsl reads them. The glossary of
// runtime/forest/README.md explains slots, instances and exits. No OpenGL.
#pragma once

#include "viewer/scene/forest_model.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

/// Max depth of nested instances for which shaders/culling_walk.glsl has room.
inline constexpr std::uint32_t kMaxWalkDepth = 64;

struct CullingTables {
    std::vector<std::uint32_t> words; // the tables as shaders/culling_tables.glsl reads them
    /// Branches are sorted by key; each combination of form, group (see kBranchGroups) and instance
    /// has a key.
    std::vector<std::uint32_t> first_keys; // first key of each form
    std::uint32_t key_count = 0;
    /// Max number of branches of a tree; at most 2^32 - 1.
    std::uint32_t max_branches = 0;
};

/// Groups of branches: one for each level of detail, and one for blended trees of each level.
inline constexpr std::uint32_t kBranchGroups = 2 * kTreeLevels;

/// Returns nullopt if instances are nested deeper than kMaxWalkDepth.
[[nodiscard]] std::optional<CullingTables> make_culling_tables(const ForestModel& model);

} // namespace lsys::view
