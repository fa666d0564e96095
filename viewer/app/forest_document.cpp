#include "viewer/app/forest_document.h"

#include "runtime/pipeline/step.h"
#include "runtime/pipeline/stopwatch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string_view>

namespace lsys::view {

namespace {

Outcome<void> make_model(const ViewOptions& options,
                         const ForestDocument* before,
                         const Project& project,
                         ForestDocument& document) {
    Step step(project);
    MeshOptions mesh = options.mesh;
    mesh.threads = project.threads;
    mesh.max_bytes = project.limits.max_bytes;
    const GrownForest& grown = document.grown;
    KnownModel known;
    if (before != nullptr) {
        known = {&before->model, before->grown.forest.key, before->mesh_options, grown.known};
    }
    document.mesh_options = mesh;
    if (mesh.method == MeshMethod::Boxes) {
        return step.fail("--method boxes: a branch and its parent are one surface there, so a "
                         "forest cannot be put together from them");
    }
    if (const std::optional<Stop> stop = make_forest_model(
            grown.forest, *grown.terrain, grown.user_meshes, mesh, document.model, known)) {
        return end_mesh_of_heroes(*stop, step);
    }
    return step.done();
}

/// `edits` and `known` may be null.
Outcome<std::shared_ptr<ForestDocument>> make(const ViewOptions& options,
                                              const SceneOverrides* edits,
                                              const ForestDocument* known,
                                              const Project& project) {
    Step step(project);
    const Stopwatch parsing;
    SceneOverrides overrides = options.overrides;
    overrides.grammar = options.grammar;
    overrides.seed = options.seed;
    LoadedScene loaded;
    if (!step.take(load_scene(options.files, overrides, project), loaded)) {
        return step.end();
    }
    if (edits != nullptr) {
        if (const Result<void> applied = apply(*edits, loaded.scene); !applied) {
            return step.fail(applied.error());
        }
    }
    const auto document = std::make_shared<ForestDocument>();
    document->scene = loaded.scene;
    document->parse_seconds = parsing.seconds();
    KnownForest before;
    if (known != nullptr) {
        before = {&known->scene, &known->grown};
    }
    if (!step.take(grow_species(loaded, project, before), document->grown)) {
        return step.end();
    }
    if (edits != nullptr) {
        loaded.scene.painting = {};
    }
    if (!step.take(place_forest(loaded.scene, project, document->grown))) {
        return step.end();
    }
    if (project.is_cancelled()) {
        return step.end(Stop::Cancelled);
    }
    constexpr std::size_t kMeasuredTrees = 20'000; // within a moment
    if (document->grown.forest.trees.size() <= kMeasuredTrees) {
        document->tallest = find_tallest(document->grown, project);
    }
    const Stopwatch meshing;
    if (!step.take(make_model(options, known, project, *document))) {
        return step.end();
    }
    document->mesh_seconds = meshing.seconds();
    return step.done(document);
}

} // namespace

Outcome<std::shared_ptr<ForestDocument>> make_forest_document(const ViewOptions& options,
                                                              const Project& project) {
    return make(options, nullptr, nullptr, project);
}

Outcome<std::shared_ptr<ForestDocument>> make_unpainted_forest(const ViewOptions& options,
                                                               const SceneOverrides& edits,
                                                               const ForestDocument* known,
                                                               const Project& project) {
    return make(options, &edits, known, project);
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
    constexpr float kMinEyeHeight = 0.3F;
    const float ground = terrain.height(camera.eye.x, camera.eye.z);
    if (camera.eye.y >= ground + kMinEyeHeight) {
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
