#include "runtime/cli/forest_scene.h"

#include "runtime/cli/grow_forest.h"
#include "runtime/cli/tell.h"

#include <algorithm>
#include <filesystem>
#include <optional>

namespace lsys::lsc {

namespace {

constexpr double kUsualSize = 100.0; // m
constexpr std::uint64_t kUsualCount = 1000;

/// A scene of grammars alone.
Scene scene_of(const std::vector<std::string>& grammars) {
    Scene scene;
    scene.terrain.region = {0.0, 0.0, kUsualSize, kUsualSize};
    scene.placement.region = scene.terrain.region;
    scene.placement.count = kUsualCount;
    for (const std::string& path : grammars) {
        SceneSpecies& species = scene.species.emplace_back();
        species.name = std::filesystem::path(path).stem().string();
        species.grammar.path = path;
        scene.placement.species.emplace_back();
    }
    return scene;
}

template <typename Target, typename Value>
void take(const std::optional<Value>& option, Target& target) {
    if (option) {
        target = static_cast<Target>(*option);
    }
}

/// What the options say in place of the scene. Error: a tile of a placement that has none.
Result<Done> apply(const ForestCommand& command, Scene& scene) {
    for (SceneSpecies& species : scene.species) {
        take(command.heroes, species.cache.heroes);
        take(command.seed, species.cache.seed);
        take(command.cache_cap, species.cache.cap);
        take(command.tolerance, species.cache.tolerance);
        take(command.rho, species.rho);
        const GrammarOptions& grammar = command.grammar;
        species.dialect.text = grammar.dialect.empty() ? species.dialect.text : grammar.dialect;
        species.system.text = grammar.system.empty() ? species.system.text : grammar.system;
        species.bug_compatible = species.bug_compatible || grammar.bug_compatible;
        if (command.grammar.generations) {
            species.stages = {*command.grammar.generations};
            species.years_of_stage = 0.0F;
        }
        for (const Definition& definition : command.grammar.definitions) {
            const auto same = [&](const SceneDefinition& each) {
                return each.name == definition.name;
            };
            std::erase_if(species.definitions, same);
            species.definitions.push_back({definition.name, definition.value, {}});
        }
    }
    PlacementOptions& placement = scene.placement;
    take(command.key, placement.key);
    take(command.method, placement.method);
    take(command.count, placement.count);
    take(command.spacing, placement.spacing);
    take(command.density, placement.density);
    take(command.years, placement.years);
    if (!command.density_map.empty()) {
        scene.density_map.path = std::filesystem::absolute(command.density_map).string();
    }
    if (command.size) {
        const auto side = static_cast<double>(*command.size);
        scene.terrain.region = {0.0, 0.0, side, side};
        placement.region = scene.terrain.region;
    }
    if (command.tile) {
        if (!is_tileable(placement.method)) {
            return Error{"--tile: this placement is made as a whole; jittered, uniform-cells, "
                         "poisson-cells and density-cells have tiles that fit"};
        }
        const ForestTile& tile = *command.tile;
        placement.region = {static_cast<double>(tile.column) * tile.size,
                            static_cast<double>(tile.row) * tile.size, tile.size, tile.size};
        if (scene.terrain.kind != TerrainKind::HeightMap) {
            scene.terrain.region = placement.region;
        }
    }
    return Done{};
}

} // namespace

bool is_scene(const std::string& path) {
    return std::filesystem::path(path).extension() == ".toml";
}

Status
load_command_scene(const ForestCommand& command, const Console& console, CommandScene& loaded) {
    const auto scenes = std::count_if(command.files.begin(), command.files.end(), is_scene);
    if (scenes > 0 && command.files.size() > 1) {
        return fail(Error{"a scene names its grammars, so it stands alone"}, console);
    }
    if (scenes > 0) {
        const std::string& path = command.files.front();
        const Status status = load_scene(path, console, loaded.sources, loaded.scene);
        if (status != Status::Fine) {
            return status;
        }
        loaded.folder = std::filesystem::path(path).parent_path().string();
    } else {
        loaded.scene = scene_of(command.files);
    }
    if (const Result<Done> applied = apply(command, loaded.scene); !applied) {
        return fail(applied.error(), console);
    }
    return Status::Fine;
}

} // namespace lsys::lsc
