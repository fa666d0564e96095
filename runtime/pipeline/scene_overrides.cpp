#include "runtime/pipeline/scene_overrides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace lsys {

namespace {

constexpr double kDiskTrees = 0.7; // poisson-disk trees per square of side `spacing`

template <typename Target, typename Value>
void take(const std::optional<Value>& option, Target& target) {
    if (option) {
        target = static_cast<Target>(*option);
    }
}

/// A message about options of stages that say nothing; empty if there are none.
std::string stage_conflict(const SceneOverrides& overrides, const Scene& scene) {
    const bool has_stages =
        std::any_of(scene.species.begin(), scene.species.end(),
                    [](const SceneSpecies& each) { return each.stages.size() > 1; });
    if (!overrides.stages.empty() && overrides.grammar.generations) {
        return "--stages and -n do not go together: both say how many generations trees have";
    }
    if (!has_stages && (overrides.start || overrides.years_of_stage)) {
        return fmt::format("{}: no species has several stages; name them by --stages 1,2,3",
                           overrides.start ? "--starting-stage" : "--years-of-stage");
    }
    if (overrides.years_of_stage && scene.placement.method != PlacementMethod::Domination) {
        return "--years-of-stage: plants have an age with --placement domination alone";
    }
    return {};
}

} // namespace

bool SceneOverrides::changes_placement() const {
    return key || method || count || size || spacing || density || !density_map.empty() || years ||
           tile || terrain || hill_height || hill_spacing || hill_seed ||
           std::any_of(species.begin(), species.end(),
                       [](const auto& each) { return each.second.share.has_value(); });
}

Result<void> apply(const SceneOverrides& overrides, Scene& scene) {
    for (SceneSpecies& species : scene.species) {
        take(overrides.heroes, species.cache.heroes);
        take(overrides.seed, species.cache.seed);
        take(overrides.cache_cap, species.cache.cap);
        take(overrides.tolerance, species.cache.tolerance);
        take(overrides.rho, species.rho);
        const GrammarOptions& grammar = overrides.grammar;
        species.dialect.text = grammar.dialect.empty() ? species.dialect.text : grammar.dialect;
        species.system.text = grammar.system.empty() ? species.system.text : grammar.system;
        species.bug_compatible = species.bug_compatible || grammar.bug_compatible;
        if (overrides.grammar.generations) {
            species.stages = {*overrides.grammar.generations};
            species.years_of_stage = 0.0F;
        }
        if (!overrides.stages.empty()) {
            species.stages = overrides.stages;
        }
        take(overrides.start, species.start);
        take(overrides.years_of_stage, species.years_of_stage);
        for (const Definition& definition : overrides.grammar.definitions) {
            const auto same = [&](const SceneDefinition& each) {
                return each.name == definition.name;
            };
            std::erase_if(species.definitions, same);
            species.definitions.push_back({definition.name, definition.value, {}});
        }
        for (const SettingText& setting : overrides.grammar.settings) {
            std::erase_if(species.settings,
                          [&](const auto& each) { return each.first == setting.key; });
            species.settings.emplace_back(setting.key, setting.values);
        }
    }
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        SceneSpecies& species = scene.species[i];
        const auto found = overrides.species.find(species.name);
        if (found == overrides.species.end()) {
            continue;
        }
        const SpeciesOverrides& own = found->second;
        take(own.heroes, species.cache.heroes);
        take(own.rho, species.rho);
        PlacementSpecies& placed = scene.placement.species[i];
        take(own.share, placed.share);
        take(own.min_scale, placed.min_scale);
        take(own.max_scale, placed.max_scale);
        placed.max_scale = std::max(placed.max_scale, placed.min_scale);
        if (placed.max_height > 0.0F) {
            take(own.min_height, placed.min_height);
            take(own.max_height, placed.max_height);
            placed.max_height = std::max(placed.max_height, placed.min_height);
        }
    }
    take(overrides.terrain, scene.terrain.kind);
    take(overrides.hill_height, scene.terrain.noise.height);
    take(overrides.hill_spacing, scene.terrain.noise.feature);
    take(overrides.hill_seed, scene.terrain.noise.seed);
    PlacementOptions& placement = scene.placement;
    take(overrides.key, placement.key);
    take(overrides.method, placement.method);
    take(overrides.count, placement.count);
    take(overrides.spacing, placement.spacing);
    take(overrides.density, placement.density);
    const bool dominates = placement.method == PlacementMethod::Domination;
    take(overrides.years, dominates ? placement.years : placement.later);
    if (!overrides.density_map.empty()) {
        scene.density_map.path = std::filesystem::absolute(overrides.density_map).string();
    }
    if (overrides.size) {
        const auto side = static_cast<double>(*overrides.size);
        scene.terrain.region = {0.0, 0.0, side, side};
        placement.region = scene.terrain.region;
    }
    if (overrides.tile) {
        if (!is_tileable(placement.method)) {
            return Error{"--tile: this placement is made as a whole; jittered, uniform-cells, "
                         "poisson-cells and density-cells have tiles that fit"};
        }
        const ForestTile& tile = *overrides.tile;
        placement.region = {static_cast<double>(tile.column) * tile.size,
                            static_cast<double>(tile.row) * tile.size, tile.size, tile.size};
        if (scene.terrain.kind != TerrainKind::HeightMap) {
            scene.terrain.region = placement.region;
        }
    }
    settle_stages(scene);
    if (const std::string conflict = stage_conflict(overrides, scene); !conflict.empty()) {
        return Error{conflict};
    }
    return {};
}

void choose_method(SceneOverrides& overrides, PlacementMethod method, const Scene& scene) {
    const PlacementOptions& now = scene.placement;
    overrides.method = method;
    const double area = std::max(now.region.area(), 1.0);
    double trees = 1000.0;
    if (reads_count(now.method) && now.count != 0) {
        trees = static_cast<double>(now.count);
    } else if (reads_spacing(now.method) && now.spacing > 0.0) {
        trees = kDiskTrees * area / (now.spacing * now.spacing);
    } else if (reads_density(now.method) && now.density > 0.0) {
        trees = area * now.density;
    }
    if (reads_count(method) && !reads_count(now.method)) {
        overrides.count = static_cast<std::uint64_t>(std::max(trees, 1.0));
    }
    if (reads_spacing(method) && !reads_spacing(now.method)) {
        overrides.spacing = std::sqrt(kDiskTrees * area / trees);
    }
    if (reads_density(method) && !reads_density(now.method)) {
        overrides.density = trees / area;
    }
    if (method == PlacementMethod::Domination && now.years == 0) {
        overrides.years = 50;
    }
}

bool reads_count(PlacementMethod method) {
    return method == PlacementMethod::Uniform || method == PlacementMethod::Domination;
}

bool reads_spacing(PlacementMethod method) {
    return method == PlacementMethod::PoissonDisk || method == PlacementMethod::Jittered ||
           method == PlacementMethod::PoissonCells;
}

bool reads_density(PlacementMethod method) {
    return method == PlacementMethod::DensityMap || method == PlacementMethod::UniformCells ||
           method == PlacementMethod::DensityCells;
}

} // namespace lsys
