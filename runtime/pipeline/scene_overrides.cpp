#include "runtime/pipeline/scene_overrides.h"

#include <filesystem>
#include <vector>

namespace lsys {

namespace {

template <typename Target, typename Value>
void take(const std::optional<Value>& option, Target& target) {
    if (option) {
        target = static_cast<Target>(*option);
    }
}

} // namespace

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
        for (const Definition& definition : overrides.grammar.definitions) {
            const auto same = [&](const SceneDefinition& each) {
                return each.name == definition.name;
            };
            std::erase_if(species.definitions, same);
            species.definitions.push_back({definition.name, definition.value, {}});
        }
    }
    PlacementOptions& placement = scene.placement;
    take(overrides.key, placement.key);
    take(overrides.method, placement.method);
    take(overrides.count, placement.count);
    take(overrides.spacing, placement.spacing);
    take(overrides.density, placement.density);
    take(overrides.years, placement.years);
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
    return {};
}

} // namespace lsys
