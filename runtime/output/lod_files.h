// SPDX-License-Identifier: MIT
// Files of levels of detail: their names, the distance and screen coverage at which a level is
// shown, and the list of the files as JSON, which the importers in scripts/engines read.
#pragma once

#include "runtime/export/export.h"
#include "runtime/meshing/mesh.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

/// Height in pixels of the screen for which the list gives distances and coverages.
inline constexpr double kScreenLines = 1080.0;

/// The size of a plant in metres.
struct PlantExtent {
    double largest = 0.0; // largest of width, depth and height
    double width = 0.0;   // the larger of width and depth
    double height = 0.0;
};
[[nodiscard]] PlantExtent extent_of(const Mesh& mesh);

/// The fraction of a 16:9 screen that the bounding box of the plant covers, seen from its wider
/// side, if its largest extent takes `pixels` of kScreenLines lines. At most 1.
[[nodiscard]] double screen_coverage(const PlantExtent& extent, float pixels);
/// The distance in metres at which the largest extent takes `pixels` of kScreenLines lines, with a
/// vertical field of view of 60 degrees.
[[nodiscard]] double lod_distance(const PlantExtent& extent, float pixels);

struct LodFile {
    std::string name;
    std::uint64_t triangles = 0;
    float pixels = 0.0F;   // DetailLevel::pixels
    double coverage = 0.0; // CoarserMesh::coverage
};
/// The path of level `number`: `tree.LOD2.glb` for `tree.glb` and 2.
[[nodiscard]] std::string lod_path(const std::string& path, std::size_t number);
/// The path of the list: `tree.lods.json` for `tree.glb`.
[[nodiscard]] std::string lods_json_path(const std::string& path);
/// The list as a JSON object and a line end.
[[nodiscard]] std::string
lods_json(const ExportInfo& info, const PlantExtent& extent, const std::vector<LodFile>& files);

} // namespace lsys
