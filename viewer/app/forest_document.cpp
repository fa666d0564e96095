// SPDX-License-Identifier: MIT
#include "viewer/app/forest_document.h"

#include "grammar/base/paths.h"
#include "runtime/pipeline/instancing_choice.h"
#include "runtime/pipeline/step.h"
#include "runtime/pipeline/stopwatch.h"
#include "viewer/app/daylight.h"
#include "viewer/app/square_source.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

namespace lsys::view {

namespace {

Outcome<void> make_model(const ViewOptions& options,
                         const ForestDocument* before,
                         const Project& project,
                         ForestDocument& document) {
    Step step(project);
    project.begin(LongStep::Mesh);
    MeshOptions mesh = options.mesh;
    mesh.threads = project.threads;
    mesh.max_bytes = project.limits.max_bytes;
    const GrownForest& grown = document.grown;
    KnownModel known;
    if (before != nullptr) {
        known = {&before->model, before->grown.forest.key, before->mesh_options,
                 grown.reused_species};
    }
    document.mesh_options = mesh;
    if (const std::optional<Stop> stop = make_forest_model(
            grown.forest, *grown.terrain, grown.user_meshes, mesh, document.model, known)) {
        return end_mesh_of_heroes(*stop, step);
    }
    document.model.ground = grown.ground;
    if (document.squares != nullptr) {
        document.model.streamed = document.squares->describe(document.model);
    }
    return step.done();
}

/// If `scene` has a goal, and goal and species are those of `before`, copies those of heroes, rho
/// and cap of the caches that `scene` does not set, so that an edit in a window does not start a
/// new search for them. Otherwise returns false.
bool keep_choice(const Scene& before, Scene& scene) {
    if (!scene.goal.is_set() || before.goal != scene.goal ||
        before.species.size() != scene.species.size()) {
        return false;
    }
    for (std::size_t i = 0; i < scene.species.size(); ++i) {
        const SceneSpecies& from = before.species[i];
        SceneSpecies& to = scene.species[i];
        if (from.name != to.name || from.grammar.path != to.grammar.path) {
            return false;
        }
        to.cache.heroes = to.explicit_instancing.heroes ? to.cache.heroes : from.cache.heroes;
        to.rho = to.explicit_instancing.rho ? to.rho : from.rho;
        to.cache.cap = to.explicit_instancing.cap ? to.cache.cap : from.cache.cap;
    }
    return true;
}

/// The value of ForestDocument::season.
std::optional<float> season_of(const LoadedScene& loaded, const Project& project) {
    for (const SceneSpecies& species : loaded.scene.species) {
        const bool is_fixed =
            std::any_of(species.definitions.begin(), species.definitions.end(),
                        [](const SceneDefinition& each) { return each.name == "season"; });
        if (is_fixed) {
            continue;
        }
        GrammarOptions options;
        options.dialect = species.dialect.text;
        options.bug_compatible = species.bug_compatible;
        options.system = species.system.text;
        const std::string path = path_text(path_of(loaded.folder) / path_of(species.grammar.path));
        const Outcome<Grammar> grammar = load_grammar(path, options, project);
        if (!grammar || !grammar.value().program) {
            continue;
        }
        for (const Constant& each : grammar.value().program->constants) {
            if (grammar.value().names.text(each.name) == "season") {
                return species.season.value_or(each.value);
            }
        }
    }
    return std::nullopt;
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
    if (const Result<void> applied = apply(options.edits, loaded.scene); !applied) {
        return step.fail(applied.error());
    }
    if (edits != nullptr) {
        if (const Result<void> applied = apply(*edits, loaded.scene); !applied) {
            return step.fail(applied.error());
        }
    }
    for (SceneSpecies& species : loaded.scene.species) {
        species.keeps_senses = true;
    }
    if (known == nullptr || !keep_choice(known->scene, loaded.scene)) {
        if (!step.take(choose_instancing(loaded, project))) {
            return step.end();
        }
    }
    const auto document = std::make_shared<ForestDocument>();
    document->scene = loaded.scene;
    document->parse_seconds = parsing.seconds();
    PreviousForest before;
    if (known != nullptr) {
        before = {&known->scene, &known->grown};
    }
    if (!step.take(grow_species(loaded, project, before), document->grown)) {
        return step.end();
    }
    if (edits != nullptr) {
        loaded.scene.painting = {};
        document->season = season_of(loaded, project);
    }
    if (SquareSource::is_needed(loaded.scene, project, document->grown)) {
        Result<std::shared_ptr<const SquareSource>> squares =
            SquareSource::make(document->scene, project, document->grown);
        if (!squares) {
            return step.fail(fmt::format("placement: {}", squares.error().message));
        }
        document->squares = std::move(squares.value());
    } else if (!step.take(place_forest(loaded.scene, project, document->grown))) {
        return step.end();
    }
    if (project.is_cancelled()) {
        return step.end(Stop::Cancelled);
    }
    // Max number of trees to measure; measuring more would delay the first picture.
    constexpr std::size_t kMeasuredTrees = 20'000;
    if (document->squares == nullptr && document->grown.forest.trees.size() <= kMeasuredTrees) {
        document->tallest = tallest_height(document->grown, project);
    }
    const Stopwatch meshing;
    if (!step.take(make_model(options, known, project, *document))) {
        return step.end();
    }
    document->mesh_seconds = meshing.seconds();
    return step.done(document);
}

constexpr double kMetresPerKm = 1000.0;
// Direction from the middle of a forest to its first camera.
constexpr glm::vec3 kFirstDirection{0.55F, 0.42F, 0.8F};
constexpr float kFirstField = 40.0F; // degrees

/// Bounding box of all trees; without trees, of the corners of the ground.
Bounds bounds_of(const ForestDocument& document) {
    Bounds bounds;
    for (const Tree& tree : document.grown.forest.trees) {
        const TreeForm& form = document.model.forms[document.model.form_of(tree)];
        const glm::vec3 wide(tree.scale * form.radius, 0.0F, tree.scale * form.radius);
        bounds.add(tree.position - wide);
        bounds.add(tree.position + wide + glm::vec3(0.0F, tree.scale * form.high, 0.0F));
    }
    if (bounds.empty) {
        const Terrain& terrain = *document.grown.terrain;
        const Region& region = terrain.region();
        for (const double x : {region.x, region.x + region.width}) {
            for (const double z : {region.z, region.z + region.depth}) {
                const glm::vec2 at(x, z);
                bounds.add({at.x, terrain.height(at.x, at.y), at.y});
            }
        }
    }
    return bounds;
}

/// Mean height of trees in m, weighted by the area of the trees in a picture. So a few trees above
/// grass raise the mean, and a few seedlings below trees do not lower it.
float typical_height(const ForestDocument& document) {
    double square_sum = 0.0;
    double cube_sum = 0.0;
    for (const Tree& tree : document.grown.forest.trees) {
        const TreeForm& form = document.model.forms[document.model.form_of(tree)];
        const auto height = static_cast<double>(tree.scale * std::max(form.high, 0.0F));
        square_sum += height * height;
        cube_sum += height * height * height;
    }
    return square_sum > 0.0 ? static_cast<float>(cube_sum / square_sum) : 0.0F;
}

/// Foot of a tree at the edge of the forest: a tree far from `middle` in the direction `outward`,
/// and near the line from `middle` in this direction.
glm::vec3 edge_of(const Forest& forest, const glm::vec3& middle, const glm::vec2& outward) {
    glm::vec3 edge = middle;
    float farthest = -std::numeric_limits<float>::infinity();
    for (const Tree& tree : forest.trees) {
        const glm::vec2 from(tree.position.x - middle.x, tree.position.z - middle.z);
        const float aside = std::abs(from.x * outward.y - from.y * outward.x);
        if (const float far = glm::dot(from, outward) - aside; far > farthest) {
            farthest = far;
            edge = tree.position;
        }
    }
    return edge;
}

/// View into a forest from outside. `edge`: foot of a tree at the edge. `height`: height of the
/// trees in m. All distances are multiples of `height`, so that views of forests of grass and of
/// trees look alike.
Camera edge_view(const ForestDocument& document, const glm::vec3& edge, float height) {
    constexpr float kOutside = 3.5F;     // distance from the eye to the first tree
    constexpr float kAbove = 2.0F;       // height of the eye above the ground below it
    constexpr float kClearance = 1.5F;   // min height of the eye above the ground ahead
    constexpr float kAhead = 16.0F;      // distance from the eye to which the ground is checked
    constexpr std::uint32_t kSteps = 64; // number of places where it is checked
    // Angle from the middle of the picture down to the foot of the first tree, radians.
    constexpr float kFootBelow = 0.9F * 0.5F * kFirstField * std::numbers::pi_v<float> / 180.0F;
    constexpr float kMinPitch = 0.1F; // radians, downwards
    constexpr float kMaxPitch = 0.6F; // radians, downwards
    const Terrain& terrain = *document.grown.terrain;
    const glm::vec2 outward = glm::normalize(glm::vec2(kFirstDirection.x, kFirstDirection.z));
    const glm::vec2 from = glm::vec2(edge.x, edge.z) + kOutside * height * outward;
    float eye = terrain.height(from.x, from.y) + kAbove * height;
    for (std::uint32_t step = 1; step <= kSteps; ++step) {
        const float away = kAhead * height * static_cast<float>(step) / static_cast<float>(kSteps);
        const glm::vec2 at = from - away * outward;
        eye = std::max(eye, terrain.height(at.x, at.y) + kClearance * height);
    }
    const float drop = eye - edge.y;
    const float pitch =
        std::clamp(std::atan(drop / (kOutside * height)) - kFootBelow, kMinPitch, kMaxPitch);
    const glm::vec2 at = from - drop / std::tan(pitch) * outward;
    Camera camera;
    camera.eye = {from.x, eye, from.y};
    camera.target = {at.x, edge.y, at.y};
    camera.field_of_view = kFirstField;
    return camera;
}

/// View over the crowns in the middle of a streamed forest.
Camera middle_view(const ForestDocument& document) {
    const Terrain& terrain = *document.grown.terrain;
    const Region& region = terrain.region();
    const glm::vec2 middle(region.x + 0.5 * region.width, region.z + 0.5 * region.depth);
    const float height = std::max(document.model.streamed->tallest, 1.0F);
    const Camera camera =
        edge_view(document, {middle.x, terrain.height(middle.x, middle.y), middle.y}, height);
    return relative_to(camera, nearest_origin(eye_of(camera)));
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

glm::dvec3 figure_at(const ForestDocument& document, const Camera& camera) {
    const glm::dvec3 target = camera.origin + glm::dvec3(camera.target);
    const float height =
        document.grown.terrain->height(static_cast<float>(target.x), static_cast<float>(target.z));
    return {target.x, static_cast<double>(height), target.z};
}

Camera first_view(const ForestDocument& document, float aspect) {
    if (document.squares != nullptr) {
        return middle_view(document);
    }
    const Bounds bounds = bounds_of(document);
    const float height = typical_height(document);
    const Camera all =
        framing(Camera{kFirstDirection, glm::vec3(0.0F), kFirstField, {}}, bounds, aspect);
    const float picture_height = 2.0F * std::tan(0.5F * glm::radians(all.field_of_view)) *
                                 glm::distance(all.eye, all.target);
    constexpr float kMinPart = 0.25F; // min height of a tree, as a fraction of the picture's
    return bounds.empty || height >= kMinPart * picture_height
               ? all
               : edge_view(document,
                           edge_of(document.grown.forest, 0.5F * (bounds.low + bounds.high),
                                   glm::normalize(glm::vec2(kFirstDirection.x, kFirstDirection.z))),
                           height);
}

std::uint64_t tree_count(const ForestDocument& document) {
    return document.squares == nullptr ? document.grown.forest.trees.size()
                                       : static_cast<std::uint64_t>(document.squares->all_places());
}

Camera above_ground(const Camera& camera, const Terrain& terrain) {
    constexpr float kEyeHeight = 1.7F;    // m
    constexpr float kMinEyeHeight = 0.3F; // m
    const glm::dvec3 eye = eye_of(camera);
    const float ground = terrain.height(static_cast<float>(eye.x), static_cast<float>(eye.z));
    if (camera.eye.y >= ground + kMinEyeHeight) {
        return camera;
    }
    const float lift = ground + kEyeHeight - camera.eye.y;
    Camera lifted = camera;
    lifted.eye.y += lift;
    lifted.target.y += lift;
    return lifted;
}

double default_visibility(const ForestDocument& document) {
    if (document.squares != nullptr) {
        return kStreamedVisibility;
    }
    const Region& region = document.grown.terrain->region();
    constexpr double kMin = 10.0;       // km
    constexpr double kDiagonals = 12.0; // number of diagonals of the ground
    return std::max(kMin, kDiagonals * std::hypot(region.width, region.depth) / kMetresPerKm);
}

Light forest_light(const ForestDocument& document,
                   std::optional<double> visibility,
                   const SceneLight& changes) {
    // At the limit of visibility, 2 % of the contrast remain (Koschmieder 1924).
    constexpr double kContrastLoss = 3.912; // -ln 0.02
    Light light;
    light.extinction = static_cast<float>(
        kContrastLoss / (kMetresPerKm * visibility.value_or(default_visibility(document))));
    light.exposure = 0.68F;
    return daylight_of(replaced(document.scene.light, changes), light);
}

} // namespace lsys::view
