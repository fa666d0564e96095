// SPDX-License-Identifier: MIT
#include "runtime/pipeline/scene_overrides.h"

#include "grammar/base/paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace lsys {

namespace {

/// Replaces `target` if the option is set.
template <typename Target, typename Value>
void replace_if_set(const std::optional<Value>& option, Target& target) {
    if (option) {
        target = static_cast<Target>(*option);
    }
}

Result<void> apply_ground(const SceneOverrides& overrides, SceneTerrain& terrain) {
    const auto absolute = [](const std::string& path) {
        return SceneFile{path_text(std::filesystem::absolute(path_of(path))), {}};
    };
    if (!overrides.ground_picture.empty()) {
        terrain.colour = absolute(overrides.ground_picture);
        terrain.normals = {}; // the normals belong to the replaced picture
    }
    const char* const picture = "the ground has no picture; --ground-picture names one";
    if (!overrides.ground_normals.empty()) {
        if (terrain.colour.path.empty()) {
            return Error{fmt::format("--ground-normals: {}", picture)};
        }
        terrain.normals = absolute(overrides.ground_normals);
    }
    if (overrides.ground_tile) {
        if (terrain.colour.path.empty()) {
            return Error{fmt::format("--ground-tile: {}", picture)};
        }
        terrain.tile_width = *overrides.ground_tile;
        terrain.tile_depth = *overrides.ground_tile;
    }
    return {};
}

/// The error for stage options that have no effect or contradict another option; empty: no error.
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

void mark_explicit(bool heroes, bool rho, SceneSpecies& species) {
    species.explicit_instancing.heroes = species.explicit_instancing.heroes || heroes;
    species.explicit_instancing.rho = species.explicit_instancing.rho || rho;
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
        replace_if_set(overrides.heroes, species.cache.heroes);
        replace_if_set(overrides.seed, species.cache.seed);
        replace_if_set(overrides.cache_cap, species.cache.cap);
        replace_if_set(overrides.tolerance, species.cache.tolerance);
        replace_if_set(overrides.rho, species.rho);
        mark_explicit(overrides.heroes.has_value(), overrides.rho.has_value(), species);
        species.explicit_instancing.cap =
            species.explicit_instancing.cap || overrides.cache_cap.has_value();
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
        replace_if_set(overrides.season, species.season);
        if (overrides.senses_surroundings) {
            species.senses_surroundings = *overrides.senses_surroundings;
            species.surroundings_span = {}; // the value does not come from the scene file
        }
        replace_if_set(overrides.start, species.start);
        replace_if_set(overrides.years_of_stage, species.years_of_stage);
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
        if (overrides.height) {
            scene.placement.species[i].min_height = overrides.height->min;
            scene.placement.species[i].max_height = overrides.height->max;
            species.height_span = {}; // the value does not come from the scene file
        }
        const auto found = overrides.species.find(species.name);
        if (found == overrides.species.end()) {
            continue;
        }
        const SpeciesOverrides& species_overrides = found->second;
        replace_if_set(species_overrides.heroes, species.cache.heroes);
        replace_if_set(species_overrides.rho, species.rho);
        replace_if_set(species_overrides.senses_surroundings, species.senses_surroundings);
        mark_explicit(species_overrides.heroes.has_value(), species_overrides.rho.has_value(),
                      species);
        for (const EnvironmentMove& move : species_overrides.moves) {
            std::erase_if(species.moves, [&](const auto& each) { return each.first == move.name; });
            species.moves.emplace_back(move.name, move.by);
        }
        PlacementSpecies& placed = scene.placement.species[i];
        replace_if_set(species_overrides.share, placed.share);
        replace_if_set(species_overrides.min_scale, placed.min_scale);
        replace_if_set(species_overrides.max_scale, placed.max_scale);
        placed.max_scale = std::max(placed.max_scale, placed.min_scale);
        if (placed.max_height > 0.0F) {
            replace_if_set(species_overrides.min_height, placed.min_height);
            replace_if_set(species_overrides.max_height, placed.max_height);
            placed.max_height = std::max(placed.max_height, placed.min_height);
        }
    }
    replace_if_set(overrides.variety, scene.goal.variety);
    replace_if_set(overrides.memory, scene.goal.max_bytes);
    replace_if_set(overrides.terrain, scene.terrain.kind);
    replace_if_set(overrides.hill_height, scene.terrain.noise.height);
    replace_if_set(overrides.hill_spacing, scene.terrain.noise.feature);
    replace_if_set(overrides.hill_seed, scene.terrain.noise.seed);
    if (Result<void> done = apply_ground(overrides, scene.terrain); !done) {
        return done;
    }
    PlacementOptions& placement = scene.placement;
    replace_if_set(overrides.key, placement.key);
    replace_if_set(overrides.method, placement.method);
    replace_if_set(overrides.count, placement.count);
    replace_if_set(overrides.spacing, placement.spacing);
    replace_if_set(overrides.density, placement.density);
    const bool dominates = placement.method == PlacementMethod::Domination;
    replace_if_set(overrides.years, dominates ? placement.years : placement.stages_passed);
    if (!overrides.density_map.empty()) {
        scene.density_map.path =
            path_text(std::filesystem::absolute(path_of(overrides.density_map)));
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
        scene.is_tile = true;
        placement.region = {static_cast<double>(tile.column) * tile.size,
                            static_cast<double>(tile.row) * tile.size, tile.size, tile.size};
        if (scene.terrain.kind != TerrainKind::HeightMap) {
            scene.terrain.region = placement.region;
        }
    }
    copy_stages_to_placement(scene);
    if (const std::string conflict = stage_conflict(overrides, scene); !conflict.empty()) {
        return Error{conflict};
    }
    return {};
}

void choose_method(SceneOverrides& overrides, PlacementMethod method, const Scene& scene) {
    const PlacementOptions& current = scene.placement;
    overrides.method = method;
    const double area = std::max(current.region.area(), 1.0);
    double trees = 1000.0;
    if (reads_count(current.method) && current.count != 0) {
        trees = static_cast<double>(current.count);
    } else if (reads_spacing(current.method) && current.spacing > 0.0) {
        trees = kDiskTrees * area / (current.spacing * current.spacing);
    } else if (reads_density(current.method) && current.density > 0.0) {
        trees = area * current.density;
    }
    if (reads_count(method) && !reads_count(current.method)) {
        overrides.count = static_cast<std::uint64_t>(std::max(trees, 1.0));
    }
    if (reads_spacing(method) && !reads_spacing(current.method)) {
        overrides.spacing = std::sqrt(kDiskTrees * area / trees);
    }
    if (reads_density(method) && !reads_density(current.method)) {
        overrides.density = trees / area;
    }
    // Values that the method does not read are errors (load_scene()).
    if (!reads_count(method)) {
        overrides.count.reset();
    }
    if (!reads_spacing(method)) {
        overrides.spacing.reset();
    }
    if (!reads_density(method)) {
        overrides.density.reset();
    }
    if (method == PlacementMethod::Domination && current.years == 0) {
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
