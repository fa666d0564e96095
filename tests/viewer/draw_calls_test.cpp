// SPDX-License-Identifier: MIT
// Number of draw calls for the branches of the park, whose seven species have pictures of their own.
#include "runtime/program/host.h"
#include "viewer/app/forest_document.h"
#include "viewer/gl/headless_context.h"
#include "viewer/gl/renderer.h"

#include <catch2/catch.hpp>

#include <memory>
#include <set>
#include <utility>

using namespace lsys;
using namespace lsys::view;

TEST_CASE("branches with many pictures need few draw calls") {
    ViewOptions options;
    options.file = LSYS_SOURCE_DIR "/samples/scenes/park/park.toml";
    options.files = {options.file};
    options.is_forest = true;
    const Project project{make_file_host(nullptr), options.run.limits, 1, {}};
    auto made = make_forest_document(options, project);
    REQUIRE(made);
    const ForestDocument& park = *made.value();
    std::set<std::pair<const Texture*, const Texture*>> pictures; // with their normal maps
    for (const TreeForm& form : park.model.forms) {
        for (const InstanceMeshes& level : *form.meshes) {
            for (const Material& material : level.mesh.materials) {
                if (material.picture != nullptr) {
                    pictures.insert({material.picture.get(), material.normal_map.get()});
                }
            }
        }
    }
    const std::unique_ptr<HeadlessContext> context = std::move(HeadlessContext::make().value());
    const std::unique_ptr<Renderer> renderer = std::move(Renderer::make(built_in_shader).value());
    REQUIRE(renderer->show_forest(park.model));
    Frame frame;
    frame.camera = parse_camera("eye 80,3.7,45 target 80,3.2,75 fov 60", Camera()).value();
    frame.width = 640;
    frame.height = 360;
    frame.samples = 1;
    static_cast<void>(renderer->draw(frame, {0, 0, frame.width, frame.height}));
    CHECK(renderer->errors().empty());
    const ForestFrameStats& stats = renderer->forest_stats();
    CHECK(stats.drawn_branches > 1000);
    CAPTURE(pictures.size());
    // Whole and blended branches; a call for each picture would take up to twice their number.
    CHECK(pictures.size() >= 12);
    CHECK(stats.branches.draws <= 10);
}
