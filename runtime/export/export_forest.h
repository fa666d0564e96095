// SPDX-License-Identifier: MIT
// Export of forests: trees as instances of shared surfaces, as nodes, or as one mesh. Bytes go to a
// sink in pieces; uncompressed transforms are in memory for one window of instances at a time
// (ForestExportInfo::window_bytes). Metres, +Y up. The same forest gives the same bytes, for any
// number of threads.
#pragma once

#include "runtime/export/export.h"
#include "runtime/forest/forest.h"
#include "runtime/forest/instance_meshes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

/// A forest to export. References outlive the calls below.
struct ForestScene {
    const Forest& forest;
    /// Indexed by species, then by stage as in ForestSpecies::stages.
    const std::vector<std::vector<InstanceMeshes>>& meshes;
    const Mesh* ground = nullptr; // null: the file has no ground
};

enum class ForestForm : std::uint8_t {
    Instanced, // EXT_mesh_gpu_instancing, which readers must support; at most 40 bytes per instance
    Expanded,  // a node for each branch instance; for FormatTraits::expands_forest
};
/// Max count of branch instances of ForestForm::Expanded. Each takes about 200 bytes of the file.
inline constexpr std::uint64_t kMaxForestNodes = 1'000'000;

struct ForestExportInfo {
    std::string name;      // name of the scene
    std::string generator; // the program and its version
    /// Side in m of the squares of ground whose trees are instanced together; 0: one square.
    float cell = 0.0F;
    bool textures = true;       // as ExportInfo::textures
    std::string picture_prefix; // as ExportInfo::picture_prefix
    /// Encoding of the arrays of vertices and indices, in formats with FormatTraits::compresses.
    /// Positions of the ground stay exact floats; transforms of instances do unless Meshopt is
    /// selected.
    ExportCompression compression = ExportCompression::None;
    std::uint32_t threads = 0;            // 0: as many as the machine has
    UpAxis up = UpAxis::Y;                // another axis only with FormatTraits::up_axes
    LengthUnit unit = LengthUnit::Metres; // another unit only with FormatTraits::units
    /// Collision shapes of each hero at rest, with names that begin with the name of its mesh; only
    /// in glTF files whose instances are whole trees.
    CollisionKind collision = CollisionKind::None;
    CollisionNames collision_names = CollisionNames::Unreal;
    glm::vec3 pivot{0.0F}; // m, the point of the scene that becomes the origin of the file
    /// Max bytes of memory for transforms; with fewer bytes, the trees are expanded more often.
    std::uint64_t window_bytes = std::uint64_t{512} << 20;
};

/// Writes the trees as instances, in a format with FormatTraits::write_forest. Memory beside the
/// scene: 8 bytes per tree; 24 bytes per cell and distinct instance in it; 16 bytes per piece (512
/// trees of a cell) and distinct instance in it; ForestExportInfo::window_bytes. Precondition: the
/// species of all trees have meshes. Stops like export_mesh(), and with Limit if Expanded
/// needs more than kMaxForestNodes nodes.
Outcome<void> export_forest(const ForestScene& scene,
                            ExportFormat format,
                            ForestForm form,
                            const ForestExportInfo& info,
                            const ByteSink& sink);
/// The picture files to write beside a file of export_forest(). Stops: OutOfMemory.
Outcome<std::vector<PictureFile>> make_forest_picture_files(const ForestScene& scene,
                                                            ExportFormat format,
                                                            const ForestExportInfo& info);

/// Makes one mesh of all triangles in world coordinates. Parts are in the order of materials: first
/// the materials of the species, then those of the ground. Texture coordinates, tangents and
/// colours are kept only if every surface has them. Stops: Limit for more than `max_bytes`, checked
/// before the memory is allocated; Failed for more vertices than 32 bits can number; OutOfMemory.
Outcome<Mesh> bake_forest(const ForestScene& scene, std::uint64_t max_bytes, std::uint32_t threads);

struct ForestStatsOptions {
    bool different_trees = false; // count distinct shapes, which takes about 100 bytes per tree
    std::uint32_t threads = 0;    // 0: as many as the machine has
};
/// One JSON object in a line: counts of the forest, its species, their stages and instance caches,
/// with hits, misses and recordings for each branch id and age.
[[nodiscard]] std::string forest_stats_json(const ForestScene& scene,
                                            const ForestStatsOptions& options);

} // namespace lsys
