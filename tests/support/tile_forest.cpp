// SPDX-License-Identifier: MIT
#include "tests/support/tile_forest.h"

#include "runtime/pipeline/forest.h"

#include <cstdlib>
#include <string>
#include <utility>

namespace lsys::tests {

TileForest make_small_tile_forest() {
    Project project;
    project.threads = 1;
    const auto read = [](const std::string&, const ReadLimit&) -> Result<std::string> {
        return std::string("#n = 2; #set angle 25; #w : !(0.2) F(2) X;"
                           "#p : X : * : !(0.08) F({0.5, 0.8}) [ + X ] /(120) [ & X ];");
    };
    project.host.read_file = read;
    project.host.read_referenced_file = read;
    project.host.file_exists = [](const std::string&) { return true; };
    SceneOverrides overrides;
    overrides.rho = 0.0F;
    overrides.heroes = 2;
    overrides.method = PlacementMethod::Jittered;
    overrides.spacing = 4.0;
    overrides.size = 70.0F;
    Outcome<LoadedScene> scene = load_scene({"tree.lsys"}, overrides, project);
    TileOptions options;
    options.triangles = 10'000;
    options.error = 0.0F;
    options.generator = "tests";
    if (scene) {
        Outcome<TileForest> forest = make_tile_forest(std::move(scene.value()), options, project);
        if (forest) {
            return std::move(forest.value());
        }
    }
    std::abort();
}

} // namespace lsys::tests
