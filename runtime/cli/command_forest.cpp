// SPDX-License-Identifier: MIT
#include "grammar/base/paths.h"
#include "runtime/cli/commands.h"
#include "runtime/export/export_forest.h"
#include "runtime/forest/different_trees.h"
#include "runtime/forest/surroundings.h"
#include "runtime/output/forest_files.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/instancing_choice.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/program/host.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

/// Number of trees of a species in each case of surroundings, as a line; empty if it senses none.
std::string surroundings_text(const Forest& forest, std::size_t species) {
    if (!forest.species[species].senses_surroundings) {
        return {};
    }
    std::array<std::uint64_t, kSurroundings> counts{};
    for (const Tree& tree : forest.trees) {
        counts[surroundings_of(tree)] += tree.species == species ? 1 : 0;
    }
    std::string text = "  surroundings:";
    for (std::size_t i = 0; i < counts.size(); ++i) {
        text += fmt::format("{} {} {}", i == 0 ? "" : ",", counts[i], kSurroundingsNames[i]);
    }
    return text + '\n';
}

/// Statistics as a table.
std::string stats_text(const GrownForest& grown,
                       const ForestCounts& counts,
                       double seconds,
                       const Project& project) {
    const Forest& forest = grown.forest;
    const std::uint64_t different = count_different_trees(forest, project.threads);
    std::string text =
        fmt::format("trees      {}, {} of them different\n"
                    "branches   {} ({:.1f} a tree, at most {})\n"
                    "segments   {}, objects {}, polygons {}\n"
                    "tallest    {:.4g} m\n"
                    "digest     {:016x}\n"
                    "heroes     {:.1f} ms, placement {:.1f} ms, expansion {:.1f} ms\n",
                    counts.trees, different, counts.branches,
                    counts.trees == 0
                        ? 0.0
                        : static_cast<double>(counts.branches) / static_cast<double>(counts.trees),
                    counts.max_branches, counts.segments, counts.objects, counts.polygons,
                    tallest_height(grown, project), counts.digest, grown.cache_seconds * 1e3,
                    grown.place_seconds * 1e3, seconds * 1e3);
    std::vector<std::uint64_t> trees(forest.species.size(), 0);
    for (const Tree& tree : forest.trees) {
        ++trees[tree.species];
    }
    for (std::size_t s = 0; s < forest.species.size(); ++s) {
        text += fmt::format("{}: {} trees\n", forest.species[s].name, trees[s]);
        text += surroundings_text(forest, s);
        for (std::size_t i = 0; i < forest.species[s].stages.size(); ++i) {
            const ForestStage& stage = forest.species[s].stages[i];
            const InstanceCache& cache = stage.cache;
            std::uint64_t hits = 0;
            std::uint64_t misses = 0;
            for (const InstanceSlot& slot : cache.slots) {
                hits += slot.hits;
                misses += slot.misses;
            }
            text += fmt::format(
                "  {} generations{}: {} instances of {} keys, {} segments; {} hits, {} misses\n",
                stage.generations,
                forest.species[s].senses_surroundings
                    ? fmt::format(" ({})", kSurroundingsNames[i % kSurroundings])
                    : std::string(),
                cache.instances.size(), cache.slots.size(), cache.skeleton.segments.size(), hits,
                misses);
            // Sum over the slots with the same id and age.
            std::map<std::pair<std::uint32_t, std::uint32_t>, InstanceSlot> rows;
            for (const InstanceSlot& slot : cache.slots) {
                InstanceSlot& row = rows[{slot.id, slot.age}];
                row.variant_count += slot.variant_count;
                row.hits += slot.hits;
                row.misses += slot.misses;
                row.recorded += slot.recorded;
                row.dropped += slot.dropped;
            }
            text += "      id    age  instances       hits     misses   recorded    dropped\n";
            for (const auto& [key, row] : rows) {
                text += fmt::format("  {:>6} {:>6} {:>10} {:>10} {:>10} {:>10} {:>10}\n", key.first,
                                    key.second, row.variant_count, row.hits, row.misses,
                                    row.recorded, row.dropped);
            }
        }
    }
    return text;
}

ExitStatus print_stats(const ForestCommand& command,
                       const GrownForest& grown,
                       const std::vector<std::vector<InstanceMeshes>>& meshes,
                       const OutputContext& context) {
    const Project& project = context.project;
    std::string text;
    if (command.messages.format == MessageFormat::Json) {
        const ForestScene scene{grown.forest, meshes, nullptr};
        text = forest_stats_json(scene, {true, project.threads}) + "\n";
    } else {
        const Stopwatch counting;
        const ForestCounts counts = count_forest(grown.forest, project.threads);
        text = stats_text(grown, counts, counting.seconds(), project);
    }
    return report_result(context.console.write(text), context.console);
}

} // namespace

ExitStatus run_command(const ForestCommand& command, const Console& console) {
    const Result<ForestTarget> target = target_of(command);
    if (!target) {
        return report_error(target.error(), console);
    }
    if (command.output.empty() && !command.stats && !command.check) {
        return report_error(Error{"nothing to do: give -o FILE, --stats or --check"}, console);
    }
    if (const std::string conflict = find_conflict(command, target.value(), command.overrides.rho);
        !conflict.empty()) {
        return report_error(Error{conflict}, console);
    }
    const Project project = make_project(console, command.run);
    const OutputContext context{console, project, "lsc " LSC_VERSION};
    SceneOverrides overrides = command.overrides;
    if (command.instance_kind != ForestInstances::Branches) {
        overrides.rho =
            0.0F; // no branch is replaced by a recorded one, so each hero is a single instance
    }
    LoadedScene loaded;
    if (const ExitStatus status =
            console.take(load_scene(command.files, overrides, project), loaded);
        status != ExitStatus::Ok) {
        return status;
    }
    if (!command.check) {
        if (const ExitStatus status = console.take(choose_instancing(loaded, project));
            status != ExitStatus::Ok) {
            return status;
        }
    }
    const Scene& scene = loaded.scene;
    const bool grows = scene.placement.method == PlacementMethod::Domination;
    if (command.frames != 0 && last_year(scene) == 0 && !grows) {
        return report_error(Error{"--frames shows a forest that grows, which is --placement "
                                  "domination, or one of several --stages"},
                            console);
    }
    GrownForest grown;
    ExitStatus status = console.take(grow_species(loaded, project, {}), grown);
    if (status != ExitStatus::Ok || command.check) {
        return status;
    }
    std::vector<std::vector<InstanceMeshes>> meshes; // by species and stage
    std::optional<Mesh> ground;
    const bool json = command.messages.format == MessageFormat::Json;
    if (target.value().kind != ForestOutputKind::None || json) {
        // The writer of trees with levels of detail makes their meshes itself.
        if (command.instance_kind != ForestInstances::Lods || json) {
            status = console.take(mesh_forest(grown, command.mesh, project), meshes);
        }
        const bool has_ground = scene.terrain.kind != TerrainKind::Flat ||
                                command.files.size() == 1 || grown.ground.colour != nullptr;
        if (status == ExitStatus::Ok && has_ground) {
            status = make_ground(target.value(), grown, context, ground);
        }
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    const ForestOutput output{command, target.value(), context,
                              scene,   meshes,         ground ? &*ground : nullptr};
    if (command.frames == 0 || !grows) {
        status = console.take(place_forest(scene, project, grown));
    }
    if (status == ExitStatus::Ok) {
        status =
            command.frames != 0 ? write_forest_frames(output, grown) : write_forest(output, grown);
    }
    return status == ExitStatus::Ok && command.stats ? print_stats(command, grown, meshes, context)
                                                     : status;
}

} // namespace lsys::lsc
