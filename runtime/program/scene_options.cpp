// SPDX-License-Identifier: MIT
#include "runtime/program/option_parsers.h"
#include "runtime/scene/scene.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>

namespace lsys {

namespace {

/// Parses `column,row,size`.
Result<ForestTile> parse_tile(const std::string& text) {
    constexpr std::int64_t kMaxTileIndex = 1'000'000;
    constexpr float kMaxTileSize = 1e6F; // m
    const Error wrong{fmt::format("`{}` is not column,row,size: two whole numbers from -{} to {} "
                                  "and metres up to {:g}",
                                  text, kMaxTileIndex, kMaxTileIndex, kMaxTileSize)};
    ForestTile tile;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::int64_t* part : {&tile.column, &tile.row}) {
        const auto [next, failure] = std::from_chars(at, end, *part);
        if (failure != std::errc() || next == end || *next != ',') {
            return wrong;
        }
        at = next + 1;
    }
    const Result<float> size =
        parse_number(std::string_view(at, static_cast<std::size_t>(end - at)), 0.0F, kMaxTileSize);
    if (!size || size.value() == 0.0F || tile.column < -kMaxTileIndex ||
        tile.column > kMaxTileIndex || tile.row < -kMaxTileIndex || tile.row > kMaxTileIndex) {
        return wrong;
    }
    tile.size = static_cast<double>(size.value());
    return tile;
}

/// Parses `1,2,3`: numbers of generations in ascending order.
Result<std::vector<std::uint32_t>> parse_stages(const std::string& text) {
    constexpr std::size_t kMaxStages = 256;
    std::vector<std::uint32_t> stages;
    std::string_view rest = text;
    while (true) {
        const std::size_t end = std::min(rest.find(','), rest.size());
        const Result<std::uint64_t> stage =
            parse_integer(std::string(rest.substr(0, end)), 0, kMaxGenerations);
        if (!stage) {
            return stage.error();
        }
        if (!stages.empty() && stage.value() <= stages.back()) {
            return Error{fmt::format("stages must ascend: {} is not above {}", stage.value(),
                                     stages.back())};
        }
        stages.push_back(static_cast<std::uint32_t>(stage.value()));
        if (stages.size() > kMaxStages) {
            return Error{fmt::format("more than {} stages", kMaxStages)};
        }
        if (end == rest.size()) {
            return stages;
        }
        rest.remove_prefix(end + 1);
    }
}

auto metres(float min) {
    return [min](const std::string& text) { return parse_number(text, min, 1e6F); };
}

void add_placement(CLI::App& app, SceneOverrides& overrides, const char* size) {
    const char* const group = "Placement";
    add_choice<std::optional<PlacementMethod>>(
        app, "--placement", overrides.method,
        {{"uniform", PlacementMethod::Uniform},
         {"poisson-disk", PlacementMethod::PoissonDisk},
         {"density-map", PlacementMethod::DensityMap},
         {"domination", PlacementMethod::Domination},
         {"jittered", PlacementMethod::Jittered},
         {"uniform-cells", PlacementMethod::UniformCells},
         {"poisson-cells", PlacementMethod::PoissonCells},
         {"density-cells", PlacementMethod::DensityCells}},
        "Placement method (default uniform); the last four make seamless tiles")
        ->group(group);
    add_parsed(
        app, "--count", overrides.count, integer(0, kMaxTrees),
        "Trees of uniform placement, or plants in the first year of domination (default 1000)")
        ->type_name("N")
        ->group(group);
    add_parsed(app, size, overrides.size, metres(1e-3F),
               "Side of the square ground, which begins at the origin (default 100)")
        ->type_name("METRES")
        ->group(group);
    add_parsed(
        app, "--spacing", overrides.spacing, metres(1e-3F),
        "Distance between trees: grid step of jittered, minimum of poisson-disk and poisson-cells")
        ->type_name("METRES")
        ->group(group);
    add_parsed(
        app, "--density", overrides.density,
        [](const std::string& text) { return parse_number(text, 0.0F, 1e6F); },
        "Trees per square metre where the density map is white")
        ->type_name("D")
        ->group(group);
    app.add_option("--density-map", overrides.density_map,
                   "Grey PNG of the density over the ground")
        ->type_name("FILE")
        ->group(group);
    add_parsed(app, "--years", overrides.years, integer(0, kMaxYears),
               "Years of growth of a domination forest; for other methods, stages since the start")
        ->type_name("N")
        ->group(group);
    add_parsed(app, "--stages", overrides.stages, parse_stages,
               "Generations of the trees, rising: each tree has one of them, see --starting-stage")
        ->type_name("N,N,...")
        ->group(group);
    add_choice<std::optional<StageStart>>(
        app, "--starting-stage", overrides.start,
        {{"first", StageStart::First}, {"random", StageStart::Random}},
        "Stage of a tree at the start: the first, or one drawn by the key (default random; first "
        "with domination)")
        ->group(group);
    add_parsed(
        app, "--years-of-stage", overrides.years_of_stage,
        [](const std::string& text) -> Result<float> {
            const Result<float> years = parse_number(text, 0.0F, static_cast<float>(kMaxYears));
            return !years || years.value() > 0.0F
                       ? years
                       : Result<float>(Error{"a stage must last longer than 0 years"});
        },
        "Years per stage of a plant in a domination forest")
        ->type_name("Y")
        ->group(group);
    add_parsed(app, "--tile", overrides.tile, parse_tile,
               "One tile of an unbounded forest, SIZE metres wide; adjacent tiles match")
        ->type_name("COLUMN,ROW,SIZE")
        ->group(group);
}

void add_cache(CLI::App& app, SceneOverrides& overrides) {
    const char* const group = "Instances";
    add_parsed(app, "--heroes", overrides.heroes, integer(1, kMaxHeroes),
               "Plants of each species derived in full (default 10)")
        ->type_name("H")
        ->group(group);
    add_parsed(app, "--rho", overrides.rho, fraction,
               "Probability that a branch is an instance (default 0.6)")
        ->type_name("P")
        ->group(group);
    add_parsed(app, "--cache-cap", overrides.cache_cap,
               integer(0, std::numeric_limits<std::uint32_t>::max()),
               "Maximum number of branches per key; 0: no limit (default 0)")
        ->type_name("N")
        ->group(group);
    add_parsed(app, "--instance-tolerance", overrides.tolerance, fraction,
               "Relative difference of values that share a key (default 0)")
        ->type_name("T")
        ->group(group);
    const auto share = [](const std::string& text) -> Result<double> {
        const Result<float> parsed = parse_number(text, 0.0F, 1.0F);
        if (!parsed) {
            return parsed.error();
        }
        return std::stod(fmt::format("{}", parsed.value())); // 0.99 as written, not 0.99F
    };
    add_parsed(
        app, "--variety", overrides.variety, share,
        "Choose --heroes, --rho and --cache-cap so that this share of trees is different, in "
        "the least memory")
        ->type_name("V")
        ->group(group);
    add_parsed(app, "--memory", overrides.memory, parse_size,
               "Memory of the heroes and their branches, without meshes: the limit of --variety; "
               "without --variety, as many different trees as fit")
        ->type_name("SIZE")
        ->group(group);
}

void add_ground(CLI::App& app, SceneOverrides& overrides) {
    const char* const group = "Ground";
    app.add_option("--ground-picture", overrides.ground_picture,
                   "PNG of the surface of the ground, laid side by side")
        ->type_name("FILE")
        ->group(group);
    app.add_option("--ground-normals", overrides.ground_normals,
                   "PNG of the normal map of the ground, as in glTF")
        ->type_name("FILE")
        ->group(group);
    add_parsed(
        app, "--ground-tile", overrides.ground_tile,
        [](const std::string& text) { return parse_number(text, 0.01F, 2e6F); },
        "Side of the ground that a picture covers (default 4)")
        ->type_name("METRES")
        ->group(group);
}

} // namespace

void add_scene_overrides(CLI::App& app, SceneOverrides& overrides, const char* size) {
    add_parsed(app, "--key", overrides.key,
               integer(0, static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())),
               "Key of the forest: equal keys give equal forests (default 0)")
        ->type_name("K")
        ->group("Placement");
    add_parsed(app, "--season", overrides.season, fraction,
               "Time of the year for species with a constant `season`: 0 and 1 are the first of "
               "March, in the north")
        ->type_name("S")
        ->group("Placement");
    add_choice<std::optional<bool>>(
        app, "--surroundings", overrides.senses_surroundings,
        {{"ignored", false}, {"sensed", true}},
        "Whether plants grow by the trees around them: in the light, or as if alone (default "
        "ignored)")
        ->group("Placement");
    add_placement(app, overrides, size);
    add_ground(app, overrides);
    add_cache(app, overrides);
}

} // namespace lsys
