// SPDX-License-Identifier: MIT
// State and functions that plant_files.cpp and plant_motion.cpp share.
#pragma once

#include "runtime/meshing/detail_levels.h"
#include "runtime/output/plant_files.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace lsys {

struct MeshFilm;
struct PlantAnimation;

/// The state shared by all files of an export.
struct PlantRun {
    const PlantFileOptions& options;
    ExportFormat format;
    const std::string& file; // path of the grammar
    const Grammar& grammar;
    const OutputContext& context;
    const Plant& plant;
    ExportTiming timing = {}; // sums over the files written so far
    Mesh mesh = {};           // mesh of the last frame, or of the finest level
    /// Levels of the plant; empty if only the finest is needed.
    DetailLevels levels = {};
    std::set<std::string> pictures = {};     // names of the written pictures, shared by all frames
    std::optional<glm::vec3> pivot = {};     // for frames of a growth: pivot of the last plant
    bool is_placed = false;                  // pivot and unit have been applied to the mesh
    std::vector<Mesh>* collected = nullptr;  // if not null, receives the meshes in place of files
    const PlantVariants* variants = nullptr; // ExportInfo::variants; null: none
};

/// The motion of the mesh of a file. Both null: no motion.
struct Movement {
    const PlantAnimation* animation = nullptr;
    const MeshFilm* film = nullptr;
};

/// Pivot and unit of the plant in its files; identity if they have been applied. The pivot is
/// PlantRun::pivot if set, else the pivot of the plant at rest.
[[nodiscard]] PlantPlacement placement_of(const PlantRun& run, const Skeleton& skeleton);
/// Makes `run.mesh` from `skeleton`. `segments`: with the segment of each vertex.
[[nodiscard]] ExitStatus mesh_frame(PlantRun& run, const Skeleton& skeleton, bool segments);
/// Writes the mesh `run.mesh` and its side files to `path`.
[[nodiscard]] ExitStatus write_mesh(PlantRun& run,
                                    const Skeleton& skeleton,
                                    const std::string& path,
                                    const Movement& movement);
/// Meshes `skeleton` and writes the mesh to `path`. With `animation` the mesh has a skin, whose
/// first pose is `skeleton`.
[[nodiscard]] ExitStatus write_plant(PlantRun& run,
                                     const Skeleton& skeleton,
                                     const std::string& path,
                                     const PlantAnimation* animation);
/// Writes a plant that does not move, or adds its mesh to PlantRun::collected.
[[nodiscard]] ExitStatus write_still(PlantRun& run, const Skeleton& skeleton);
/// Reports an error if the `bytes` of an animation exceed the memory limit.
[[nodiscard]] ExitStatus check_animation(const PlantRun& run, std::uint64_t bytes);
/// Writes the plant bent by weight and wind: at rest, or in frames of its motion.
[[nodiscard]] ExitStatus write_bent(PlantRun& run);

} // namespace lsys
