// SPDX-License-Identifier: MIT
#include "runtime/scene/impl/table_reader.h"
#include "runtime/scene/impl/tables.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace lsys {

namespace {

constexpr std::string_view kKinds[] = {"flat", "noise",
                                       "height-map"};            // in the order of TerrainKind
constexpr std::string_view kFilters[] = {"bilinear", "bicubic"}; // in the order of HeightFilter
constexpr NumberRange kAltitude{-kMaxCoordinate, kMaxCoordinate, false, "m"};
constexpr double kMinSide = 0.25; // m, the min side of a region in which trees are placed
/// Max pixels of one side of a map, whose other side has at least 2.
constexpr double kMaxMapSide = static_cast<double>(kMaxMapPixels) / 2.0;

void read_region(TableReader& reader, Region& region) {
    if (const auto origin =
            reader.pair("origin", {-kMaxCoordinate, kMaxCoordinate, false, "m"}, false)) {
        region.x = (*origin)[0];
        region.z = (*origin)[1];
    }
    const auto size = reader.pair("size", {kMinSide, 2.0 * kMaxCoordinate, false, "m"}, true);
    if (!size) {
        return;
    }
    region.width = (*size)[0];
    region.depth = (*size)[1];
    if (region.x + region.width > kMaxCoordinate || region.z + region.depth > kMaxCoordinate) {
        reader.report_bad_value(
            reader.span_of("size"),
            fmt::format("the ground reaches farther than {:.0f} km from the origin, where "
                        "places are no longer exact",
                        kMaxCoordinate / 1000.0));
    }
}

void read_noise(TableReader& reader, NoiseOptions& noise) {
    noise.octaves = static_cast<std::uint32_t>(
        reader.integer("octaves", {1, kMaxOctaves}).value_or(noise.octaves));
    noise.lacunarity =
        reader.number("lacunarity", {1.0, 8.0, false, {}}).value_or(noise.lacunarity);
    noise.gain = reader.number("gain", {0.0, 1.0, false, {}}).value_or(noise.gain);
    noise.feature =
        reader.number("feature", {1.0e-3, kMaxCoordinate, false, "m"}).value_or(noise.feature);
    noise.height =
        reader.number("height", {0.0, kMaxCoordinate, false, "m"}).value_or(noise.height);
    noise.seed =
        reader.integer("seed", {0, std::numeric_limits<std::int64_t>::max()}).value_or(noise.seed);
}

void read_map_size(TableReader& reader, SceneTerrain& terrain) {
    const bool raw = terrain.map.path.ends_with(".raw") || terrain.map.path.ends_with(".r16");
    const auto size = reader.pair("map_size", {2.0, kMaxMapSide, false, "pixels"}, true);
    if (!size) {
        if (raw && !reader.has("map_size")) {
            reader.report_missing("map_size", "the terrain has a map of raw samples and")
                .help.emplace_back(
                    "say how many columns and rows it has: `map_size = [1024, 1024]`");
        }
        return;
    }
    if (terrain.map.path.ends_with(".png")) {
        reader.report_conflicting_key("map_size", "a PNG file contains its size", terrain.map.span);
        return;
    }
    const SourceSpan span = reader.span_of("map_size");
    if (std::floor((*size)[0]) != (*size)[0] || std::floor((*size)[1]) != (*size)[1]) {
        reader.report_bad_value(span, "`map_size` must be two whole numbers");
    } else if ((*size)[0] * (*size)[1] > static_cast<double>(kMaxMapPixels)) {
        reader.report_bad_value(span, fmt::format("a map of {:.0f} pixels; it has at most {}",
                                                  (*size)[0] * (*size)[1], kMaxMapPixels));
    } else {
        terrain.map_columns = static_cast<std::uint32_t>((*size)[0]);
        terrain.map_rows = static_cast<std::uint32_t>((*size)[1]);
    }
}

void read_map(TableReader& reader, SceneTerrain& terrain) {
    HeightMapOptions& map = terrain.height_map;
    if (auto file = reader.file("map")) {
        terrain.map = std::move(*file);
    } else if (!reader.has("map")) {
        reader.report_missing("map", "the terrain is a height map and")
            .help.emplace_back("name a picture beside the scene: `map = \"heights.png\"`");
    }
    read_map_size(reader, terrain);
    map.lowest = reader.number("lowest", kAltitude).value_or(map.lowest);
    map.highest = reader.number("highest", kAltitude).value_or(map.highest);
    map.filter = static_cast<HeightFilter>(
        reader.choice("filter", kFilters).value_or(static_cast<std::size_t>(map.filter)));
}

void read_pictures(TableReader& reader, SceneTerrain& terrain) {
    if (auto file = reader.file("colour")) {
        terrain.colour = std::move(*file);
    }
    if (auto file = reader.file("normals")) {
        terrain.normals = std::move(*file);
    }
    constexpr double kMinTile = 0.01;
    const auto tile = reader.pair("tile", {kMinTile, 2.0 * kMaxCoordinate, false, "m"}, true);
    if (!reader.has("colour")) {
        for (const std::string_view key : {"normals", "tile"}) {
            reader.report_conflicting_key(key, "the ground has no `colour`", {});
        }
    }
    if (tile) {
        terrain.tile_width = (*tile)[0];
        terrain.tile_depth = (*tile)[1];
    }
    terrain.tile_x = terrain.region.x;
    terrain.tile_z = terrain.region.z;
}

} // namespace

void read_terrain_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics) {
    SceneTerrain& terrain = scene.terrain;
    TableReader reader(table, "[terrain]", diagnostics);
    terrain.span = reader.span();
    const auto kind = reader.choice("kind", kKinds);
    read_region(reader, terrain.region);
    // For an unknown kind no key is reported as conflicting.
    const bool is_unknown_kind = reader.has("kind") && !kind;
    terrain.kind = static_cast<TerrainKind>(kind.value_or(0));
    const std::string reason = fmt::format("the terrain is `{}`", kKinds[kind.value_or(0)]);
    const auto report_conflicting_key = [&](std::initializer_list<std::string_view> keys) {
        for (const std::string_view key : keys) {
            static_cast<void>(reader.entry(key));
            if (!is_unknown_kind) {
                reader.report_conflicting_key(
                    key, reason, reader.has("kind") ? reader.span_of("kind") : SourceSpan{});
            }
        }
    };
    if (terrain.kind == TerrainKind::Noise) {
        read_noise(reader, terrain.noise);
    } else {
        report_conflicting_key({"octaves", "lacunarity", "gain", "feature", "height", "seed"});
    }
    if (terrain.kind == TerrainKind::HeightMap) {
        read_map(reader, terrain);
        report_conflicting_key({"base"});
    } else {
        report_conflicting_key({"map", "map_size", "lowest", "highest", "filter"});
        terrain.base = reader.number("base", kAltitude).value_or(0.0);
        terrain.noise.base = terrain.base;
    }
    read_pictures(reader, terrain);
    reader.finish();
}

} // namespace lsys
