// SPDX-License-Identifier: MIT
// Writes a forest as files: instances, one mesh of all trees, or statistics; with pictures beside
// the file, at one moment or in frames of its growth. Used by `lsc forest` and the public library.
#pragma once

#include "grammar/base/result.h"
#include "runtime/forest/instance_meshes.h"
#include "runtime/output/file_options.h"
#include "runtime/output/output_set.h"
#include "runtime/pipeline/forest.h"
#include "runtime/scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

enum class ForestOutputKind : std::uint8_t { None, Instances, Mesh, Statistics };

/// The kind and format of the output, determined by its extension and `bake`.
struct ForestTarget {
    ForestOutputKind kind = ForestOutputKind::None;
    ExportFormat format = ExportFormat::Glb;
};
/// Error: the extension is not of a format in which the forest can be written.
[[nodiscard]] Result<ForestTarget> target_of(const ForestFileOptions& options);

/// A message about options that conflict; empty if none do. `rho`: value of SceneOverrides::rho.
[[nodiscard]] std::string find_conflict(const ForestFileOptions& options,
                                        const ForestTarget& target,
                                        std::optional<float> rho);

/// A forest to write. References must outlive the calls below.
struct ForestOutput {
    const ForestFileOptions& options;
    const ForestTarget& target;
    const OutputContext& context;
    const Scene& scene;
    /// Indexed by species and stage; may be empty with ForestInstances::Lods.
    const std::vector<std::vector<InstanceMeshes>>& meshes;
    const Mesh* ground = nullptr; // null: none
};

/// Makes the mesh of the ground for a file of the target.
[[nodiscard]] ExitStatus make_ground(const ForestTarget& target,
                                     const GrownForest& grown,
                                     const OutputContext& context,
                                     std::optional<Mesh>& ground);
/// Writes the forest with the current trees of `grown`. Precondition: no conflict.
[[nodiscard]] ExitStatus write_forest(const ForestOutput& output, const GrownForest& grown);
/// Writes `options.frames` moments of a growing forest, each as a numbered file. Changes the trees
/// of `grown`. Precondition: no conflict; the scene grows by domination, or its trees have stages
/// and are placed.
[[nodiscard]] ExitStatus write_forest_frames(const ForestOutput& output, GrownForest& grown);

} // namespace lsys
