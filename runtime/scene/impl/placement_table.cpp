// SPDX-License-Identifier: MIT
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/scene/impl/table_reader.h"
#include "runtime/scene/impl/tables.h"

#include <fmt/format.h>

#include <array>

namespace lsys {

namespace {

/// A method and the keys it reads.
struct MethodRow {
    std::string_view name;
    bool count = false;
    bool spacing = false;
    bool density = false;
    bool map = false;
    bool years = false;
};

// In the order of the enumerators of PlacementMethod.
constexpr std::array<MethodRow, 8> kMethods{{
    {.name = "uniform", .count = true},
    {.name = "poisson-disk", .spacing = true},
    {.name = "density-map", .density = true, .map = true},
    {.name = "domination", .count = true, .years = true},
    {.name = "jittered", .spacing = true},
    {.name = "uniform-cells", .density = true},
    {.name = "poisson-cells", .spacing = true},
    {.name = "density-cells", .density = true, .map = true},
}};

constexpr std::uint64_t kDefaultCount = 1000;
constexpr double kDefaultSpacing = 5.0;  // m
constexpr double kDefaultDensity = 0.04; // trees per m2: 400 per hectare
constexpr std::uint32_t kDefaultYears = 100;
constexpr double kMinSpacing = 0.001; // m

/// The keys that the method reads, for messages.
std::string keys_of(const MethodRow& method) {
    std::string keys;
    const auto add = [&](bool reads, std::string_view key) {
        if (reads) {
            keys += fmt::format("{}`{}`", keys.empty() ? "" : " and ", key);
        }
    };
    add(method.count, "count");
    add(method.spacing, "spacing");
    add(method.density, "density");
    add(method.map, "map");
    add(method.years, "years");
    return keys;
}

/// Reports a `spacing` with which PoissonDisk would place more than kMaxTrees trees.
void check_disk(TableReader& reader, const PlacementOptions& placement) {
    const double trees =
        kDiskTrees * placement.region.area() / (placement.spacing * placement.spacing);
    if (placement.method == PlacementMethod::PoissonDisk &&
        trees > static_cast<double>(kMaxTrees)) {
        reader.report_bad_value(reader.span_of("spacing"),
                                fmt::format("about {} trees; one placement has at most {}",
                                            grouped_digits(static_cast<std::uint64_t>(trees)),
                                            grouped_digits(kMaxTrees)));
    }
}

} // namespace

void read_placement_table(const SceneValue* table, Scene& scene, Diagnostics& diagnostics) {
    PlacementOptions& placement = scene.placement;
    TableReader reader(table, "[placement]", diagnostics);
    scene.span = reader.span();
    std::array<std::string_view, kMethods.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i) {
        names[i] = kMethods[i].name;
    }
    const auto found = reader.choice("method", names);
    const bool accepts_all = reader.has("method") && !found; // unknown method: allow all keys
    placement.method = static_cast<PlacementMethod>(found.value_or(0));
    placement.region = scene.terrain.region;
    const MethodRow& method = kMethods[found.value_or(0)];
    const std::string reason =
        fmt::format("the method `{}` reads {}", method.name, keys_of(method));
    /// `wanted`: whether the method reads `key`. Returns `wanted`; if it is false, reports the key
    /// if present.
    const auto reads = [&](bool wanted, std::string_view key) {
        if (!wanted) {
            static_cast<void>(reader.entry(key));
            if (!accepts_all) {
                reader.report_conflicting_key(
                    key, reason, reader.has("method") ? reader.span_of("method") : SourceSpan{});
            }
        }
        return wanted;
    };
    placement.count = kDefaultCount;
    placement.spacing = kDefaultSpacing;
    placement.density = kDefaultDensity;
    placement.years = kDefaultYears;
    if (reads(method.count, "count")) {
        placement.count = reader.integer("count", {1, kMaxTrees}).value_or(kDefaultCount);
    }
    if (reads(method.spacing, "spacing")) {
        if (const auto spacing =
                reader.number("spacing", {kMinSpacing, kMaxCoordinate, false, "m"})) {
            placement.spacing = *spacing;
            check_disk(reader, placement);
        }
    }
    if (reads(method.density, "density")) {
        placement.density = reader
                                .number("density", {1.0 / (kMaxCoordinate * kMaxCoordinate),
                                                    1.0 / (kMinSpacing * kMinSpacing), false,
                                                    "trees a square metre"})
                                .value_or(kDefaultDensity);
    }
    if (reads(method.map, "map")) {
        if (auto map = reader.file("map")) {
            scene.density_map = std::move(*map);
        } else if (!reader.has("map")) {
            reader.report_missing("map", fmt::format("the method is `{}` and", method.name))
                .help.emplace_back("name a picture beside the scene: `map = \"density.png\"`");
        }
        placement.map_region = placement.region;
    }
    if (reads(method.years, "years")) {
        placement.years = static_cast<std::uint32_t>(
            reader.integer("years", {0, kMaxYears}).value_or(kDefaultYears));
    }
    reader.finish();
}

} // namespace lsys
