// Files of levels of detail: their names, when each is shown, and the list of them as JSON, which
// scripts/engines read.
#pragma once

#include "runtime/export/export.h"
#include "runtime/meshing/mesh.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace lsys::lsc {

/// Lines of the screen for which the list gives distances and parts of the screen.
inline constexpr double kScreenLines = 1080.0;

/// The size of a plant in metres.
struct PlantExtent {
    double largest = 0.0; // of width, depth and height
    double width = 0.0;   // the larger of width and depth
    double height = 0.0;
};
[[nodiscard]] PlantExtent extent_of(const Mesh& mesh);

/// The part of a screen of 16 : 9 that the box of the plant covers, seen from its wider side, where
/// its largest extent takes `pixels` lines of kScreenLines; at most 1.
[[nodiscard]] double screen_coverage(const PlantExtent& extent, float pixels);
/// The distance in metres where the largest extent takes `pixels` lines of kScreenLines in a view
/// of 60 degrees from top to bottom.
[[nodiscard]] double lod_distance(const PlantExtent& extent, float pixels);

struct LodFile {
    std::string name;
    std::uint64_t triangles = 0;
    float pixels = 0.0F; // DetailLevel::pixels
    double coverage = 0.0;
};
/// `tree.LOD2.glb` for `tree.glb` and 2.
[[nodiscard]] std::string lod_path(const std::string& path, std::size_t number);
/// `tree.lods.json` for `tree.glb`.
[[nodiscard]] std::string lods_json_path(const std::string& path);
/// The list as JSON with a new line at its end.
[[nodiscard]] std::string
lods_json(const ExportInfo& info, const PlantExtent& extent, const std::vector<LodFile>& files);

} // namespace lsys::lsc
