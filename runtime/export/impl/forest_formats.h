// SPDX-License-Identifier: MIT
// The writers of forests. Each writes one whole file and may stop early once the PieceWriter has
// stopped.
#pragma once

#include "runtime/export/impl/forest_plan.h"
#include "runtime/export/impl/piece_writer.h"

#include <cstddef>
#include <functional>
#include <span>

namespace lsys {

/// Input of a writer of forests.
struct ForestExportJob {
    const ForestScene& scene;
    const ForestPlan& plan;
    ForestForm form;
    const ForestExportInfo& info;
};

Outcome<void> write_forest_gltf(const ForestExportJob& job, PieceWriter& out);
Outcome<void> write_forest_glb(const ForestExportJob& job, PieceWriter& out);
Outcome<void> write_forest_usda(const ForestExportJob& job, PieceWriter& out);
Outcome<void> write_forest_usdz(const ForestExportJob& job, PieceWriter& out);

/// Bytes per instance in the transforms of a group: all translations, then all rotations, then all
/// scales.
inline constexpr std::uint64_t kTranslationBytes = 12;
inline constexpr std::uint64_t kRotationBytes = 16;
inline constexpr std::uint64_t kScaleBytes = 12;
inline constexpr std::uint64_t kInstanceBytes = kTranslationBytes + kRotationBytes + kScaleBytes;

/// Positions of a surface in a file are `low + step * item`.
struct ItemGrid {
    glm::vec3 low{0.0F};
    float step = 1.0F;
};
/// The pose that places the quantised items of a surface where `pose` places the positions of the
/// surface.
[[nodiscard]] InstancePose pose_of_items(const InstancePose& pose, const ItemGrid& grid);

/// Calls `write` with the transforms of all groups, in order, until `write` returns false. `grids`:
/// by stage.
void write_transforms(const ForestPlan& plan,
                      std::span<const ItemGrid> grids,
                      const ForestExportInfo& info,
                      const std::function<bool(std::span<const std::byte>)>& write);

/// Calls visit(groups, floats) for runs of consecutive groups of one or more cells, in order. A run
/// has as many groups as fit into ForestExportInfo::window_bytes, at least one. `floats`: the
/// transforms of these groups as write_transforms() writes them.
void for_each_transform_window(
    const ForestPlan& plan,
    std::span<const ItemGrid> grids,
    const ForestExportInfo& info,
    const std::function<void(std::span<const ForestGroup>, std::span<const float>)>& visit);

} // namespace lsys
