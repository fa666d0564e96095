#include "viewer/app/forest_document.h"

#include "runtime/cli/forest_scene.h"
#include "runtime/cli/stopwatch.h"
#include "runtime/cli/tell.h"
#include "runtime/turtle_diagnostic.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>

namespace lsys::view {

namespace {

struct Wish {
    const ForestEdits* edits = nullptr; // of a window
    const ForestDocument* known = nullptr;
};

lsc::Status make_model(const ViewOptions& options,
                       const ForestDocument* before,
                       const lsc::Console& console,
                       ForestDocument& document) {
    MeshOptions mesh = options.mesh;
    mesh.threads = options.threads;
    mesh.max_bytes = options.max_bytes;
    const lsc::GrownForest& grown = document.grown;
    KnownModel known;
    if (before != nullptr) {
        known = {&before->model, before->grown.forest.key, before->mesh_options, grown.known};
    }
    document.mesh_options = mesh;
    const InstanceMeshStatus made = make_forest_model(
        grown.forest, *grown.terrain, grown.user_meshes, mesh, document.model, known);
    switch (made) {
    case InstanceMeshStatus::Ok:
        break;
    case InstanceMeshStatus::Joined:
        return lsc::fail(Error{"--method boxes: a branch and its parent are one surface there, so "
                               "a forest cannot be put together from them"},
                         console);
    case InstanceMeshStatus::TooManyVertices:
        return lsc::fail(Error{"the heroes have more than 4,294,967,295 vertices; ask for fewer "
                               "--heroes, --sides or generations"},
                         console);
    case InstanceMeshStatus::Limit:
    case InstanceMeshStatus::OutOfMemory: {
        const std::string_view what = "the mesh of the heroes";
        Diagnostics diagnostics;
        diagnostics.add(made == InstanceMeshStatus::Limit
                            ? plant_limit_diagnostic(what, options.max_bytes)
                            : no_memory_diagnostic(what));
        static_cast<void>(console.show(diagnostics, {}));
        return lsc::Status::Limit;
    }
    }
    return lsc::Status::Fine;
}

lsc::Status make(const ViewOptions& options,
                 const Wish& wish,
                 const lsc::Console& console,
                 ForestDocument& document) {
    lsc::Clock::time_point start = lsc::Clock::now();
    lsc::ForestCommand command = options.forest;
    command.grammar = options.grammar;
    command.seed = options.seed;
    lsc::CommandScene loaded;
    lsc::Status status = lsc::load_command_scene(command, console, loaded);
    if (status != lsc::Status::Fine) {
        return status;
    }
    if (wish.edits != nullptr) {
        apply(*wish.edits, loaded.scene);
    }
    document.scene = loaded.scene;
    document.parse_seconds = lsc::seconds_since(start);
    const lsc::ForestLimits limits{options.threads, options.grammar.max_modules, options.max_bytes};
    lsc::KnownForest known;
    if (wish.known != nullptr) {
        known = {&wish.known->scene, &wish.known->grown};
    }
    status = lsc::grow_species(loaded.scene, loaded.sources, loaded.folder, limits, console,
                               document.grown, known);
    if (wish.edits != nullptr) {
        loaded.scene.painting = {};
    }
    if (status == lsc::Status::Fine) {
        status = lsc::place_forest(loaded.scene, limits, console, document.grown);
    }
    if (status != lsc::Status::Fine) {
        return status;
    }
    if (console.interrupted()) {
        return lsc::Status::Interrupted;
    }
    start = lsc::Clock::now();
    status = make_model(options, wish.known, console, document);
    document.mesh_seconds = lsc::seconds_since(start);
    return status;
}

} // namespace

lsc::Status make_forest_document(const ViewOptions& options,
                                 const lsc::Console& console,
                                 ForestDocument& document) {
    return make(options, {}, console, document);
}

lsc::Status make_live_forest(const ViewOptions& options,
                             const ForestEdits& edits,
                             const ForestDocument* known,
                             const lsc::Console& console,
                             ForestDocument& document) {
    return make(options, {&edits, known}, console, document);
}

std::vector<std::string> files_of(const ViewOptions& options, const ForestDocument& document) {
    std::vector<std::string> files = options.forest.files;
    if (!options.forest.density_map.empty()) {
        files.push_back(options.forest.density_map);
    }
    for (const std::string& file : document.grown.files) {
        if (std::find(files.begin(), files.end(), file) == files.end()) {
            files.push_back(file);
        }
    }
    return files;
}

Camera overview(const ForestDocument& document, float aspect) {
    Bounds bounds;
    for (const Tree& tree : document.grown.forest.trees) {
        const TreeForm& form = document.model.forms[document.model.form_of(tree)];
        const glm::vec3 wide(tree.scale * form.radius, 0.0F, tree.scale * form.radius);
        bounds.add(tree.position - wide);
        bounds.add(tree.position + wide + glm::vec3(0.0F, tree.scale * form.high, 0.0F));
    }
    Camera camera;
    camera.target = glm::vec3(0.0F);
    camera.eye = {0.55F, 0.42F, 0.8F};
    return framing(camera, bounds, aspect);
}

Camera above_ground(const Camera& camera, const Terrain& terrain) {
    constexpr float kEyeHeight = 1.7F;
    constexpr float kLowest = 0.3F;
    const float ground = terrain.height(camera.eye.x, camera.eye.z);
    if (camera.eye.y >= ground + kLowest) {
        return camera;
    }
    const float lift = ground + kEyeHeight - camera.eye.y;
    Camera lifted = camera;
    lifted.eye.y += lift;
    lifted.target.y += lift;
    return lifted;
}

Light forest_light(const ForestDocument& document) {
    const Region& region = document.grown.terrain->region();
    const auto across = static_cast<float>(std::hypot(region.width, region.depth));
    Light light;
    light.extinction = 0.6F / std::max(across, 1500.0F);
    light.exposure = 0.68F;
    return light;
}

} // namespace lsys::view
