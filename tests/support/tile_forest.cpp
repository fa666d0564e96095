// SPDX-License-Identifier: MIT
#include "tests/support/tile_forest.h"

#include "runtime/pipeline/forest.h"

#include <cstdlib>
#include <string>
#include <utility>

namespace lsys::tests {

namespace {

/// Makes a forest of trees of one small grammar, from a scene and overrides.
TileForest make_forest(const std::string& file, SceneOverrides overrides, TileOptions options) {
    Project project;
    project.threads = 1;
    const auto read = [](const std::string& path, const ReadLimit&) -> Result<std::string> {
        if (path.ends_with(".toml")) {
            return std::string(
                "[terrain]\nsize = [280, 70]\n[[species]]\ngrammar = \"tree.lsys\"\n");
        }
        return std::string("#n = 2; #set angle 25; #w : !(0.2) F(2) X;"
                           "#p : X : * : !(0.08) F({0.5, 0.8}) [ + X ] /(120) [ & X ];");
    };
    project.host.read_file = read;
    project.host.read_referenced_file = read;
    project.host.file_exists = [](const std::string&) { return true; };
    overrides.rho = 0.0F;
    overrides.heroes = 2;
    overrides.method = PlacementMethod::Jittered;
    overrides.spacing = 4.0;
    Outcome<LoadedScene> scene = load_scene({file}, overrides, project);
    options.max_error = 0.0F;
    options.generator = "tests";
    if (scene) {
        Outcome<TileForest> forest = make_tile_forest(std::move(scene.value()), options, project);
        if (forest) {
            return std::move(forest.value());
        }
    }
    std::abort();
}

} // namespace

TileForest make_small_tile_forest() {
    SceneOverrides overrides;
    overrides.size = 70.0F;
    TileOptions options;
    options.triangles = 10'000;
    return make_forest("tree.lsys", overrides, options);
}

TileForest make_tile_strip(TileOptions options) {
    options.triangles = 1'000;
    return make_forest("strip.toml", {}, options);
}

} // namespace lsys::tests
