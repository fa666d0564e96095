// SPDX-License-Identifier: MIT
#include "runtime/forest/forest.h"

#include "runtime/base/workers.h"
#include "runtime/forest/instance_list.h"
#include "runtime/library/impl/call.h"
#include "runtime/library/impl/file_call.h"
#include "runtime/library/impl/forest_data.h"
#include "runtime/output/file_option_parsers.h"
#include "runtime/output/forest_files.h"
#include "runtime/pipeline/instancing_choice.h"
#include "runtime/pipeline/step.h"

#include <fmt/format.h>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <lsys/forest.h>
#include <optional>
#include <utility>

namespace lsys::v0 {

namespace {

static_assert(sizeof(Tree) == sizeof(::lsys::Tree));
static_assert(offsetof(Tree, yaw) == offsetof(::lsys::Tree, yaw));
static_assert(offsetof(Tree, scale) == offsetof(::lsys::Tree, scale));
static_assert(offsetof(Tree, number) == offsetof(::lsys::Tree, number));
static_assert(offsetof(Tree, species) == offsetof(::lsys::Tree, species));
static_assert(offsetof(Tree, age) == offsetof(::lsys::Tree, age));
static_assert(sizeof(Instance) == sizeof(ForestInstance));
static_assert(offsetof(Instance, scale) == offsetof(ForestInstance, scale));
static_assert(offsetof(Instance, rotation) == offsetof(ForestInstance, rotation));
static_assert(offsetof(Instance, tree) == offsetof(ForestInstance, tree));
static_assert(offsetof(Instance, group) == offsetof(ForestInstance, group));

/// The message about an invalid place; empty if the place is valid.
std::string find_mistake(std::span<const Tree> places, std::size_t species) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Tree& place = places[i];
        const Vector3& at = place.position;
        if (place.species >= species) {
            return fmt::format("place {} is of species {}, and there are {} grammars", i,
                               place.species, species);
        }
        if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z) ||
            !std::isfinite(place.yaw)) {
            return fmt::format("place {} has a position or yaw that is not finite", i);
        }
        if (!std::isfinite(place.scale) || !(place.scale > 0.0F)) {
            return fmt::format("the scale of place {} is {}, which is not above 0", i, place.scale);
        }
    }
    return {};
}

/// The rectangle around the places, at least 1 m wide and deep.
Region region_of(std::span<const Tree> places) {
    if (places.empty()) {
        return {0.0, 0.0, 1.0, 1.0};
    }
    const auto [low_x, high_x] =
        std::minmax_element(places.begin(), places.end(), [](const Tree& a, const Tree& b) {
            return a.position.x < b.position.x;
        });
    const auto [low_z, high_z] =
        std::minmax_element(places.begin(), places.end(), [](const Tree& a, const Tree& b) {
            return a.position.z < b.position.z;
        });
    const double x = low_x->position.x;
    const double z = low_z->position.z;
    return {x, z, std::max(static_cast<double>(high_x->position.x) - x, 1.0),
            std::max(static_cast<double>(high_z->position.z) - z, 1.0)};
}

/// Places the trees of a grown forest: at the places of `source` if it has any, else by its scene.
::lsys::Outcome<void> plant_trees(const ForestSource& source,
                                  const Scene& scene,
                                  const ::lsys::Project& project,
                                  GrownForest& grown) {
    if (!source.placed_trees) {
        return place_forest(scene, project, grown);
    }
    grown.forest.trees.resize(source.placed_trees->size());
    if (!source.placed_trees->empty()) {
        std::memcpy(static_cast<void*>(grown.forest.trees.data()), source.placed_trees->data(),
                    source.placed_trees->size() * sizeof(Tree));
    }
    Step step(project);
    if (!step.take(size_forest(scene, project, grown)) ||
        !step.take(sense_forest(scene, project, grown))) {
        return step.end();
    }
    return step.done();
}

/// Reads the scene and derives its heroes. `whole_trees`: sets rho to 0, so that trees are whole
/// heroes.
::lsys::Outcome<LoadedForest>
load_forest(const ForestSource& source, bool whole_trees, const ::lsys::Project& project) {
    Step step(project);
    LoadedForest forest;
    SceneOverrides overrides = source.overrides;
    if (whole_trees) {
        overrides.rho = 0.0F;
    }
    if (!step.take(load_scene(source.files, overrides, project), forest.loaded)) {
        return step.end();
    }
    if (source.placed_trees) {
        forest.loaded.scene.placement.region = region_of(*source.placed_trees);
        forest.loaded.scene.terrain.region = forest.loaded.scene.placement.region;
    }
    if (!step.take(choose_instancing(forest.loaded, project)) ||
        !step.take(grow_species(forest.loaded, project, {}), forest.grown)) {
        return step.end();
    }
    return step.done(std::move(forest));
}

std::vector<Species> species_of(const LoadedForest& forest) {
    std::vector<Species> all;
    for (const ForestSpecies& species : forest.grown.forest.species) {
        Species& result = all.emplace_back();
        result.name = species.name;
        result.height = species.height;
        result.heroes = species.last_stage().cache.heroes;
        for (const ForestStage& stage : species.stages) {
            result.generations.push_back(stage.generations);
        }
    }
    return all;
}

Outcome<Forest> grow(ForestSource source, const ForestOptions& options, const Project& project) {
    Call call(project, source.files, {});
    source.policy = call.policy();
    const auto work = [&]() -> ::lsys::Outcome<LoadedForest> {
        Step step(call.project());
        if (source.files.empty()) {
            return step.fail("a forest needs a scene or grammars");
        }
        Result<SceneOverrides> overrides = parse_scene_overrides(options.scene);
        if (!overrides) {
            return step.fail(overrides.error());
        }
        source.overrides = std::move(overrides.value());
        source.overrides.grammar = inner_grammar_options(options.grammar);
        if (source.placed_trees) {
            if (std::any_of(source.files.begin(), source.files.end(), is_scene)) {
                return step.fail("places have grammars of their own, not a scene");
            }
            if (source.overrides.height) {
                return step.fail("places have scales of their own, so `height` has no effect");
            }
            if (std::string mistake = find_mistake(*source.placed_trees, source.files.size());
                !mistake.empty()) {
                return step.fail(std::move(mistake));
            }
        }
        LoadedForest forest;
        if (!step.take(load_forest(source, false, call.project()), forest) ||
            !step.take(plant_trees(source, forest.loaded.scene, call.project(), forest.grown))) {
            return step.end();
        }
        return step.done(std::move(forest));
    };
    return call.run<Forest>(work, [&](LoadedForest forest) {
        std::vector<Species> species = species_of(forest);
        source.inputs = call.files();
        return Forest(std::make_shared<const Forest::Data>(
            Forest::Data{std::move(source), std::move(forest), std::move(species)}));
    });
}

/// Writes a forest whose options have been parsed and do not conflict. `changing`: the forest that
/// frames change, or null for a file without frames.
ExitStatus write_loaded(const ForestFileOptions& options,
                        const ForestTarget& target,
                        const ForestSource& source,
                        const Scene& scene,
                        const GrownForest& grown,
                        GrownForest* changing,
                        const OutputContext& context) {
    std::vector<std::vector<InstanceMeshes>> meshes;
    if (options.instance_kind != ForestInstances::Lods) {
        const ExitStatus status =
            context.console.take(mesh_forest(grown, options.mesh, context.project), meshes);
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    std::optional<::lsys::Mesh> ground;
    const bool has_ground = scene.terrain.kind != TerrainKind::Flat ||
                            grown.ground.colour != nullptr ||
                            (source.files.size() == 1 && !source.placed_trees);
    if (has_ground) {
        const ExitStatus status = ::lsys::make_ground(target, grown, context, ground);
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    const ForestOutput output{options, target, context, scene, meshes, ground ? &*ground : nullptr};
    return changing != nullptr ? write_forest_frames(output, *changing)
                               : ::lsys::write_forest(output, grown);
}

/// Writes the files of a forest. Grows the forest again if the file needs other heroes, or trees of
/// other years.
ExitStatus write_grown_forest(const ForestFileOptions& options,
                              const ForestTarget& target,
                              const Forest::Data& forest,
                              const OutputContext& context) {
    const ForestSource& source = forest.source;
    const std::vector<SceneSpecies>& species = forest.forest.loaded.scene.species;
    const bool whole_trees = options.instance_kind != ForestInstances::Branches;
    const bool has_heroes = std::all_of(species.begin(), species.end(),
                                        [](const SceneSpecies& each) { return each.rho == 0.0F; });
    if (options.frames == 0 && (!whole_trees || has_heroes)) {
        return write_loaded(options, target, source, forest.forest.loaded.scene,
                            forest.forest.grown, nullptr, context);
    }
    LoadedForest again;
    ExitStatus status =
        context.console.take(load_forest(source, whole_trees, context.project), again);
    if (status != ExitStatus::Ok) {
        return status;
    }
    const Scene& scene = again.loaded.scene;
    const bool by_years = scene.placement.method == PlacementMethod::Domination;
    if (options.frames != 0 && (source.placed_trees || (last_year(scene) == 0 && !by_years))) {
        return report_error(Error{"frames show a forest that grows, which is placed by domination "
                                  "or has several stages"},
                            context.console);
    }
    if (options.frames == 0 || !by_years) {
        status = context.console.take(plant_trees(source, scene, context.project, again.grown));
    }
    return status == ExitStatus::Ok
               ? write_loaded(options, target, source, scene, again.grown,
                              options.frames != 0 ? &again.grown : nullptr, context)
               : status;
}

Outcome<std::vector<std::string>> write_forest_to(const Forest& forest,
                                                  const std::string& path,
                                                  const FileReceiver* receive,
                                                  const Options& options,
                                                  const Project& project) {
    const ForestSource& read = forest.data().source;
    Call call(project, read.files, read.policy);
    const auto write = [&](const OutputContext& context) {
        const Result<ForestFileOptions> parsed = parse_forest_files(path, options);
        if (!parsed) {
            return report_error(parsed.error(), context.console);
        }
        const Result<ForestTarget> target = target_of(parsed.value());
        if (!target) {
            return report_error(target.error(), context.console);
        }
        const std::string conflict = find_conflict(parsed.value(), target.value(), std::nullopt);
        return conflict.empty()
                   ? write_grown_forest(parsed.value(), target.value(), forest.data(), context)
                   : report_error(Error{conflict}, context.console);
    };
    return call.run<std::vector<std::string>>(
        [&] { return write_files(call, receive, read.inputs, write); },
        [](std::vector<std::string> paths) { return paths; });
}

/// The transform of an instance as a matrix of 16 floats, column by column.
void write_matrix(const ForestInstance& instance, std::byte* to) {
    const glm::mat3 turned = glm::mat3_cast(instance.rotation) * instance.scale;
    const float matrix[16] = {turned[0].x,         turned[0].y,         turned[0].z,         0.0F,
                              turned[1].x,         turned[1].y,         turned[1].z,         0.0F,
                              turned[2].x,         turned[2].y,         turned[2].z,         0.0F,
                              instance.position.x, instance.position.y, instance.position.z, 1.0F};
    std::memcpy(to, matrix, sizeof(matrix));
}

} // namespace

Forest::Forest(std::shared_ptr<const Data> data) noexcept : data_(std::move(data)) {}

std::uint64_t Forest::key() const {
    return data_->forest.grown.forest.key;
}

const std::vector<Species>& Forest::species() const {
    return data_->species;
}

std::span<const Tree> Forest::trees() const {
    const auto& trees = data_->forest.grown.forest.trees;
    return {reinterpret_cast<const Tree*>(trees.data()), trees.size()};
}

ForestCounts Forest::count() const {
    const ::lsys::ForestCounts counts = count_forest(data_->forest.grown.forest, 0);
    return {counts.trees,   counts.branches, counts.segments,
            counts.objects, counts.polygons, counts.max_branches};
}

Outcome<Forest> grow_forest(const std::vector<std::string>& files,
                            const ForestOptions& options,
                            const Project& project) {
    return grow({files, {}, std::nullopt}, options, project);
}

Outcome<Forest> forest_of_places(const std::vector<std::string>& grammars,
                                 std::span<const Tree> places,
                                 const ForestOptions& options,
                                 const Project& project) {
    return grow({grammars, {}, std::vector<Tree>(places.begin(), places.end())}, options, project);
}

Instances::Instances(std::shared_ptr<const Data> data) noexcept : data_(std::move(data)) {}

const std::vector<Mesh>& Instances::meshes() const {
    return data_->meshes;
}

const std::vector<InstanceGroup>& Instances::groups() const {
    return data_->groups;
}

std::span<const Instance> Instances::all() const {
    const auto& instances = data_->list.instances;
    return {reinterpret_cast<const Instance*>(instances.data()), instances.size()};
}

void Instances::read_matrices(std::uint64_t first,
                              std::uint64_t count,
                              void* to,
                              std::size_t stride) const {
    constexpr std::uint64_t kPiece = 16'384;
    const std::size_t step = stride != 0 ? stride : 16 * sizeof(float);
    Workers workers(data_->threads);
    workers.for_each((count + kPiece - 1) / kPiece, [&](std::uint64_t piece) {
        const std::uint64_t end = std::min((piece + 1) * kPiece, count);
        for (std::uint64_t i = piece * kPiece; i < end; ++i) {
            write_matrix(data_->list.instances[first + i], static_cast<std::byte*>(to) + i * step);
        }
    });
}

Outcome<Instances>
make_instances(const Forest& forest, const MeshOptions& mesh, const Project& project) {
    const ForestSource& read = forest.data().source;
    Call call(project, read.files, read.policy);
    const GrownForest& grown = forest.data().forest.grown;
    const auto work = [&]() -> ::lsys::Outcome<std::shared_ptr<Instances::Data>> {
        Step step(call.project());
        if (std::string mistake = mistake_of(mesh); !mistake.empty()) {
            return step.fail(std::move(mistake));
        }
        if (mesh.method == MeshMethod::Solid) {
            return step.fail("a solid is for a single plant: the branches of a forest are "
                             "instances");
        }
        auto data = std::make_shared<Instances::Data>();
        data->threads = project.threads;
        const InstanceListOptions options{project.threads, call.project().limits.max_bytes,
                                          call.cancel_flag()};
        if (const std::optional<Stop> stop =
                make_instance_list(grown.forest, options, data->list)) {
            return *stop == Stop::Cancelled ? step.end(*stop)
                                            : step.end_too_large(*stop, "the list of instances");
        }
        auto instance_meshes = std::make_shared<std::vector<std::vector<InstanceMeshes>>>();
        if (!step.take(mesh_forest(grown, inner_mesh_options(mesh), call.project()),
                       *instance_meshes)) {
            return step.end();
        }
        std::vector<std::uint32_t> first_mesh; // by species
        for (const std::vector<InstanceMeshes>& stages : *instance_meshes) {
            first_mesh.push_back(static_cast<std::uint32_t>(data->meshes.size()));
            for (const InstanceMeshes& stage : stages) {
                data->meshes.push_back(
                    public_mesh({instance_meshes, &stage.mesh}, project.threads));
            }
        }
        for (const ::lsys::InstanceGroup& group : data->list.groups) {
            const InstanceMeshes& meshes = (*instance_meshes)[group.species][group.stage];
            const std::uint32_t first = meshes.first_part[group.instance];
            data->groups.push_back({first_mesh[group.species] + group.stage, first,
                                    meshes.first_part[group.instance + 1] - first, group.first,
                                    group.count});
        }
        return step.done(std::move(data));
    };
    return call.run<Instances>(
        work, [](std::shared_ptr<Instances::Data> data) { return Instances(std::move(data)); });
}

Outcome<Mesh> make_ground(const Forest& forest, const Project& project) {
    const ForestSource& read = forest.data().source;
    Call call(project, read.files, read.policy);
    std::optional<::lsys::Mesh> ground;
    const auto write = [&](const OutputContext& context) {
        return ::lsys::make_ground({}, forest.data().forest.grown, context, ground);
    };
    return call.run<Mesh>([&] { return write_files(call, nullptr, {}, write); },
                          [&](const std::vector<std::string>& /*none*/) {
                              return public_mesh(
                                  std::make_shared<const ::lsys::Mesh>(std::move(*ground)),
                                  project.threads);
                          });
}

Outcome<std::vector<std::string>> save_forest(const Forest& forest,
                                              const std::string& path,
                                              const Options& options,
                                              const Project& project) {
    return write_forest_to(forest, path, nullptr, options, project);
}

Outcome<std::vector<std::string>> write_forest(const Forest& forest,
                                               const std::string& name,
                                               const FileReceiver& receive,
                                               const Options& options,
                                               const Project& project) {
    return write_forest_to(forest, name, &receive, options, project);
}

} // namespace lsys::v0
