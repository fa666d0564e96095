// SPDX-License-Identifier: MIT
#include "viewer/app/picking.h"

#include "grammar/base/counted_text.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/forest/surroundings.h"
#include "runtime/meshing/mesh_items.h"
#include "runtime/pipeline/item_origin.h"
#include "runtime/pipeline/step.h"
#include "runtime/program/host.h"
#include "runtime/program/trace_report.h"
#include "viewer/app/widgets.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

namespace lsys::view {

namespace {

std::string place_text(const glm::vec3& place) {
    return fmt::format("at {:.4g}, {:.4g}, {:.4g} m", place.x, place.y, place.z);
}

std::string item_text(const SkeletonItem& item, const Skeleton& pose) {
    switch (item.kind) {
    case SkeletonItem::Kind::Object:
        return fmt::format("object {} of {}", item.index, grouped(pose.objects.size()));
    case SkeletonItem::Kind::Polygon:
        return fmt::format("polygon {} of {}", item.index, grouped(pose.polygons.size()));
    case SkeletonItem::Kind::Segment:
        break;
    }
    const Segment& segment = pose.segments[item.index];
    return fmt::format("segment {} of {}, {:.4g} m long, {:.4g} m wide, order {}", item.index,
                       grouped(pose.segments.size()), segment.length, 2.0F * segment.base_radius,
                       segment.order);
}

/// The number of generations that the whole derivation has.
std::uint32_t generations_of(const ViewOptions& options, const PlantDocument& document) {
    return options.grammar.generations.value_or(document.plant.generations);
}

/// Number of copies of a branch in a forest, and of trees with it.
struct BranchCount {
    std::uint64_t branches = 0;
    std::uint64_t trees = 0; // trees with at least one such branch
};

std::optional<BranchCount> count_branch(const InstanceCache& cache,
                                        std::uint64_t key,
                                        std::uint32_t instance,
                                        const std::vector<std::uint32_t>& trees,
                                        const Project& project) {
    BranchCount count;
    TreeExpander expander(cache, key);
    for (const std::uint32_t number : trees) {
        if (project.is_cancelled()) {
            return std::nullopt;
        }
        Tree tree;
        tree.number = number;
        std::uint64_t copies = 0;
        expander.expand_instances(tree,
                                  [&](std::uint32_t each) { copies += each == instance ? 1 : 0; });
        count.branches += copies;
        count.trees += copies != 0 ? 1 : 0;
    }
    return count;
}

std::string tree_text(const Picked& picked, const ForestDocument& document) {
    const Forest& forest = document.grown.forest;
    const Tree& tree = picked.tree;
    const ForestSpecies& species = forest.species[tree.species];
    const TreeForm& form = document.model.forms[picked.form];
    const std::string name =
        species.senses_surroundings
            ? fmt::format("{}` ({})", species.name, kSurroundingsNames[surroundings_of(tree)])
            : species.name + '`';
    return fmt::format("tree {} of `{}: {}, {:.3g} m high, {}", tree.number, name,
                       counted(species.stages[forest.stage_of(tree)].generations, "generation"),
                       tree.scale * form.height(), place_text(tree.position));
}

} // namespace

Outcome<Description> describe(const PickedTriangle& picked,
                              const PlantDocument& document,
                              const ViewOptions& options,
                              const Project& project) {
    Step step(project);
    MeshOptions mesh = picked.mesh;
    mesh.threads = project.threads;
    const std::optional<SkeletonItem> item =
        item_of_triangle(*picked.pose, document.plant.user_meshes, mesh, picked.triangle);
    if (!item) {
        return step.fail("not enough memory to describe the picked part");
    }
    // Only the parts of the grammar that a derivation needs are copied, because a program cannot be
    // copied.
    Grammar grammar;
    grammar.sources = document.grammar.sources;
    grammar.bytecode = document.grammar.bytecode;
    grammar.is_module_file = document.grammar.is_module_file;
    PlantOptions plant;
    plant.file = options.file;
    plant.generations = generations_of(options, document);
    plant.seed = document.plant.seed;
    const std::uint32_t generation =
        picked.moment ? picked.moment->generation + (picked.moment->fraction > 0.0 ? 1 : 0)
                      : document.plant.generations;
    ItemOrigin origin;
    if (!step.take(origin_of_item(plant, generation, *item, grammar, project), origin)) {
        return step.end();
    }
    Description description;
    std::vector<std::string>& lines = description.lines;
    if (origin.module.empty()) {
        lines.push_back(
            fmt::format("a part that generation {} no longer draws", origin.generation));
    } else {
        lines.push_back(fmt::format("{}, module {} of {}", origin.module, origin.module_index,
                                    grouped(origin.module_count)));
        lines.push_back(origin.origin);
        description.module = {origin.module_index, origin.generation};
        description.place = origin.place;
    }
    lines.push_back(item_text(*item, *picked.pose));
    lines.push_back(place_text(picked.place));
    return step.done(std::move(description));
}

Outcome<std::string> trace_picked(const PickedModule& module,
                                  TraceScope scope,
                                  bool colour,
                                  const PlantDocument& document,
                                  const ViewOptions& options,
                                  const Project& project) {
    Step step(project);
    TraceOptions wanted;
    wanted.file = options.file;
    wanted.generation = module.generation;
    wanted.generations = generations_of(options, document);
    wanted.seed = document.plant.seed;
    wanted.position = module.position;
    wanted.scope = scope;
    wanted.is_drawn = true;
    Trace trace;
    if (!step.take(trace_modules(wanted, document.grammar, project), trace)) {
        return step.end();
    }
    return step.done(trace_text(trace, document.grammar, colour));
}

Outcome<Description> describe(const Picked& picked,
                              const std::vector<std::uint32_t>& trees_of_form,
                              const ForestDocument& document,
                              const std::string& file,
                              const Project& project) {
    Step step(project);
    switch (picked.kind) {
    case PickedKind::Cluster:
        return step.done(Description{
            {fmt::format("a picture of {}; move closer", counted(picked.trees, "tree"))}, {}, {}});
    case PickedKind::Impostor:
        return step.done(Description{
            {tree_text(picked, document), "drawn as a picture; move closer to pick its branches"},
            {},
            {}});
    case PickedKind::Ground:
        return step.done(Description{{"the ground, " + place_text(picked.place)}, {}, {}});
    case PickedKind::Branch:
        break;
    case PickedKind::Nothing:
    case PickedKind::Plant:
        return step.done(Description{{"nothing"}, {}, {}});
    }
    const Forest& forest = document.grown.forest;
    const InstanceCache& cache = *document.model.forms[picked.form].cache;
    const Instance& instance = cache.instances[picked.instance];
    const InstanceSlot& slot = cache.slots[instance.slot];
    const std::size_t stage = picked.form - document.model.first_form[picked.tree.species];
    const std::string folder =
        is_scene(file) ? std::filesystem::path(file).parent_path().string() : std::string();
    std::vector<BranchOrigin> origins;
    if (!step.take(origins_of_branches(document.scene.species[picked.tree.species], folder, stage,
                                       project),
                   origins)) {
        return step.end();
    }
    if (origins.size() != cache.instances.size()) {
        return step.fail("the grammar has changed since the forest was made");
    }
    const std::optional<BranchCount> count =
        count_branch(cache, forest.key, picked.instance, trees_of_form, project);
    if (!count) {
        return step.end(Stop::Cancelled);
    }
    Description description;
    description.hint =
        "a branch is shared by many places, so there is no trace: open its grammar alone";
    std::vector<std::string>& lines = description.lines;
    lines.push_back(fmt::format("branch {} of {}: id {}, age {}, hero {}", picked.instance,
                                grouped(cache.instances.size()), slot.id, slot.age, instance.hero));
    lines.push_back(origins[picked.instance].text);
    description.place = origins[picked.instance].place;
    lines.push_back(fmt::format("it occurs {} in the forest, in {}",
                                counted(count->branches, grouped(count->branches), "time"),
                                counted(count->trees, grouped(count->trees), "tree")));
    lines.push_back(tree_text(picked, document));
    return step.done(std::move(description));
}

namespace {

Project worker_project(const RunOptions& run, const std::atomic<bool>& cancelled) {
    return {make_file_host(&cancelled, run.files),
            run.limits,
            run.threads,
            {},
            run.environments,
            run.files};
}

std::string text_of(const Messages& messages) {
    return messages_text(messages, MessageOptions{}, "lsview");
}

} // namespace

Description run_pick(const PickRequest& request, const std::atomic<bool>& cancelled) {
    return catch_out_of_memory(
        [&] {
            Outcome<Description> outcome = request.describe(worker_project(request.run, cancelled));
            return outcome ? std::move(outcome.value())
                           : Description{{text_of(outcome.messages())}, {}, {}};
        },
        [] {
            return Description{{"out of memory"}, {}, {}};
        });
}

std::string run_trace(const TraceRequest& request, const std::atomic<bool>& cancelled) {
    return catch_out_of_memory(
        [&] {
            const Outcome<std::string> outcome = request.trace(
                request.module, request.scope, worker_project(request.run, cancelled));
            return (outcome ? outcome.value() : std::string()) + text_of(outcome.messages());
        },
        [] { return std::string("out of memory"); });
}

} // namespace lsys::view
