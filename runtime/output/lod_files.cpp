// SPDX-License-Identifier: MIT
#include "runtime/output/lod_files.h"

#include "grammar/base/paths.h"
#include "runtime/export/take_apart.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace lsys {

namespace {

constexpr double kAspect = 16.0 / 9.0;                 // width / height of the screen
constexpr double kFieldOfViewDegrees = 60.0;           // vertical
constexpr double kHalfCotangent = 0.86602540378443865; // 1 / (2 tan 30 degrees)

} // namespace

PlantExtent extent_of(const Mesh& mesh) {
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) {
        bounds.add(position);
    }
    const glm::dvec3 size = glm::dvec3(bounds.high) - glm::dvec3(bounds.low);
    return {.largest = std::max({size.x, size.y, size.z}),
            .width = std::max(size.x, size.z),
            .height = size.y};
}

double screen_coverage(const PlantExtent& extent, float pixels) {
    const double lines = static_cast<double>(pixels) / kScreenLines;
    const double largest = std::max(extent.largest, 1e-30);
    return std::min(lines * (extent.height / largest) * lines * (extent.width / largest) / kAspect,
                    1.0);
}

double lod_distance(const PlantExtent& extent, float pixels) {
    return extent.largest * kHalfCotangent * kScreenLines / static_cast<double>(pixels);
}

std::string lod_path(const std::string& path, std::size_t number) {
    std::filesystem::path name = path_of(path);
    const std::string extension = path_text(name.extension());
    return path_text(name.replace_extension(path_of(fmt::format(".LOD{}{}", number, extension))));
}

std::string lods_json_path(const std::string& path) {
    return path_text(path_of(path).replace_extension(".lods.json"));
}

std::string
lods_json(const ExportInfo& info, const PlantExtent& extent, const std::vector<LodFile>& files) {
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    const TakesApart taken(object);
    object["generator"] = info.generator;
    object["grammar"] = info.grammar;
    object["seed"] = info.seed;
    object["n"] = info.generations;
    object["extent"] = extent.largest;
    object["vertical_field_of_view"] = kFieldOfViewDegrees;
    object["levels"] = nlohmann::ordered_json::array();
    for (const LodFile& file : files) {
        const bool is_first = object["levels"].empty();
        nlohmann::ordered_json level = nlohmann::ordered_json::object();
        const TakesApart taken_level(level);
        level["file"] = file.name;
        level["triangles"] = file.triangles;
        level["distance"] = is_first ? 0.0 : lod_distance(extent, file.pixels);
        level["screen_height"] = is_first ? 1.0 : static_cast<double>(file.pixels) / kScreenLines;
        level["screen_coverage"] = is_first ? 1.0 : file.coverage;
        object["levels"].push_back(std::move(level));
    }
    return object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

} // namespace lsys
