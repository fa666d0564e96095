// SPDX-License-Identifier: MIT
#include "runtime/cli/load_tile_forest.h"

#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/instancing_choice.h"
#include "runtime/program/host.h"

#include <utility>

namespace lsys::lsc {

ExitStatus load_tile_forest(const std::vector<std::string>& files,
                            const SceneOverrides& overrides,
                            const TileOptions& options,
                            const RunOptions& run,
                            TilePlacements placements,
                            const Console& console,
                            std::optional<TileForest>& forest) {
    if (overrides.rho) {
        return report_error(Error{"--rho is the part of branches that are instances; tiles hold "
                                  "whole trees, of which --heroes sets the variety"},
                            console);
    }
    const Project project = make_project(console, run);
    SceneOverrides whole_trees = overrides;
    whole_trees.rho = 0.0F;
    LoadedScene loaded;
    ExitStatus status = console.take(load_scene(files, whole_trees, project), loaded);
    if (status != ExitStatus::Ok) {
        return status;
    }
    if (placements == TilePlacements::OnGrids && !is_placed_by_tile(loaded.scene)) {
        return report_error(
            Error{"the trees of this scene cannot be placed tile by tile: its placement must be "
                  "jittered, uniform-cells, poisson-cells or density-cells, without painted "
                  "trees; `lsc tiles` writes tiles of every scene, which any web server can "
                  "serve"},
            console);
    }
    status = console.take(choose_instancing(loaded, project));
    if (status != ExitStatus::Ok) {
        return status;
    }
    TileOptions named = options;
    named.generator = "lsc " LSC_VERSION;
    named.keep_trees = placements == TilePlacements::All;
    Outcome<TileForest> planned = make_tile_forest(std::move(loaded), named, project);
    console.show(planned.messages());
    if (!planned) {
        return status_of(planned.stop());
    }
    forest.emplace(std::move(planned.value()));
    return ExitStatus::Ok;
}

} // namespace lsys::lsc
