// SPDX-License-Identifier: MIT
#include "runtime/cli/load_tile_forest.h"

#include "runtime/pipeline/instancing_choice.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace lsys::lsc {

namespace {

/// Max instances per key of the cache, unless the scene or the command sets it. A tile has a mesh
/// and a draw call for each instance; more instances add little variety.
constexpr std::uint32_t kTileCacheCap = 3;

} // namespace

ExitStatus load_tile_scene(const SceneCommand& command,
                           const Project& project,
                           const Console& console,
                           LoadedScene& loaded) {
    SceneOverrides overrides = command.overrides;
    if (command.instance_kind == TileInstances::Trees) {
        if (overrides.rho) {
            return report_error(Error{"--rho is the part of branches that are instances, and with "
                                      "--instances trees, the default, each tree is a whole hero; "
                                      "use --instances branches"},
                                console);
        }
        overrides.rho = 0.0F;
    }
    const ExitStatus status = console.take(load_scene(command.files, overrides, project), loaded);
    for (SceneSpecies& species : loaded.scene.species) {
        if (command.instance_kind == TileInstances::Branches && !species.explicit_instancing.cap) {
            species.cache.cap = kTileCacheCap;
        }
    }
    return status == ExitStatus::Ok ? console.take(choose_instancing(loaded, project)) : status;
}

ExitStatus load_tile_forest(const TileScene& command,
                            TilePlacements placements,
                            const Console& console,
                            std::optional<TileForest>& forest) {
    const Project project = make_project(console, command.run);
    LoadedScene loaded;
    const ExitStatus status = load_tile_scene(command, project, console, loaded);
    if (status != ExitStatus::Ok) {
        return status;
    }
    TileOptions options = command.tiles;
    options.generator = "lsc " LSC_VERSION;
    options.keep_trees = placements == TilePlacements::All;
    std::string trees;
    if (!command.trees.empty()) {
        Result<std::string> bytes =
            read_file(command.trees, {~std::uint64_t{0}, command.run.limits.max_bytes}, console);
        if (!bytes) {
            return report_error(bytes.error(), console);
        }
        trees = std::move(bytes.value());
        options.tree_file = trees;
        options.tree_file_path = command.trees;
    } else if (placements == TilePlacements::OnGrids && !is_placed_by_tile(loaded.scene)) {
        return report_error(
            Error{"the trees of this scene cannot be placed tile by tile: its placement is not "
                  "jittered, uniform-cells, poisson-cells or density-cells, or it has painted "
                  "trees; `lsc place` places them once, and --trees serves them"},
            console);
    }
    Outcome<TileForest> planned = make_tile_forest(std::move(loaded), options, project);
    console.show(planned.messages());
    if (!planned) {
        return status_of(planned.stop());
    }
    forest.emplace(std::move(planned.value()));
    return ExitStatus::Ok;
}

} // namespace lsys::lsc
