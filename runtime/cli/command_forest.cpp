#include "grammar/base/paths.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/output_set.h"
#include "runtime/cli/surface_options.h"
#include "runtime/export/export_forest.h"
#include "runtime/export/placed_plant.h"
#include "runtime/forest/different_trees.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/forest_growth.h"
#include "runtime/pipeline/forest_lods.h"
#include "runtime/pipeline/instancing_choice.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/placement/domination.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/scene/painting.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

constexpr std::uint32_t kGroundCells = 128; // cells of the ground mesh per side

enum class OutputKind : std::uint8_t { None, Instances, Mesh, Statistics };

/// The kind and format of the output, which its extension decides.
struct OutputTarget {
    OutputKind kind = OutputKind::None;
    ExportFormat format = ExportFormat::Glb;
};

bool has_instances(const FormatTraits& format) {
    return format.write_forest != nullptr;
}

Result<OutputTarget> target_of(const ForestCommand& command) {
    if (command.output.empty()) {
        return OutputTarget{};
    }
    const std::filesystem::path path = command.output;
    if (path.extension() == ".json") {
        return OutputTarget{OutputKind::Statistics};
    }
    const std::optional<ExportFormat> format = format_of_path(command.output);
    if (command.bake) {
        if (!format || !traits_of(*format).uses_mesh) {
            return Error{
                fmt::format("`{}`: --bake writes {}", command.output,
                            format_names("or", [](const auto& each) { return each.uses_mesh; }))};
        }
        return OutputTarget{OutputKind::Mesh, *format};
    }
    if (!format || !has_instances(traits_of(*format))) {
        return Error{fmt::format("the name of `{}` does not tell a format with instances: {}, or "
                                 "json for statistics; --bake writes others",
                                 command.output, format_names("or", has_instances))};
    }
    return OutputTarget{OutputKind::Instances, *format};
}

/// A message if --collision, --unit or --pivot does not fit the output; empty if all fit.
std::string find_option_conflict(const ForestCommand& command, const OutputTarget& target) {
    const bool has_format = target.kind == OutputKind::Instances || target.kind == OutputKind::Mesh;
    if (command.collision != CollisionKind::None) {
        if (target.kind != OutputKind::Instances || !traits_of(target.format).collision) {
            return fmt::format(
                "--collision has a place in {} with instances",
                format_names("and", [](const auto& each) { return each.collision; }));
        }
        if (command.instances != ForestInstances::Trees) {
            return "--collision is for whole trees of one level of detail: --instances trees";
        }
    }
    const bool metres = command.unit == LengthUnit::Metres;
    if (!has_format && !(metres && command.pivot == ForestPivot::Origin)) {
        return "--unit and --pivot are for files of trees";
    }
    if (has_format && !metres && !traits_of(target.format).units) {
        return fmt::format("--unit is for {}; {}",
                           format_names("and", [](const auto& each) { return each.units; }),
                           traits_of(target.format).collision
                               ? "glTF is in metres by definition, and importers scale it to the "
                                 "unit of the engine"
                               : "this format has a scale of its own");
    }
    return {};
}

/// A message about options that conflict; empty if none do.
std::string find_conflict(const ForestCommand& command, const OutputTarget& target) {
    if (command.output.empty() && !command.stats && !command.check) {
        return "nothing is asked for; say where to write with -o, or --stats, or --check";
    }
    if (command.expand && command.bake) {
        return "--expand and --bake do not go together: the one writes a node for each tree, the "
               "other one mesh of all";
    }
    if (command.expand &&
        (target.kind != OutputKind::Instances || !traits_of(target.format).expands_forest)) {
        return "--expand is for " +
               format_names("and", [](const auto& each) { return each.expands_forest; });
    }
    const bool has_format = target.kind == OutputKind::Instances || target.kind == OutputKind::Mesh;
    if (command.compression && !(has_format && traits_of(target.format).compresses)) {
        return "--compress is for " +
               format_names("and", [](const auto& each) { return each.compresses; });
    }
    const bool lods = command.instances == ForestInstances::Lods;
    if (command.instances != ForestInstances::Branches &&
        command.overrides.rho.value_or(0.0F) > 0.0F) {
        return fmt::format(
            "--instances {} shows heroes as they are, so --rho does not go with it; more "
            "--heroes make more different trees",
            lods ? "lods" : "trees");
    }
    if (command.viewpoint && !lods) {
        return "--viewpoint is for --instances lods, whose trees have levels by distance";
    }
    if (lods && command.frames != 0) {
        return "--instances lods and --frames do not go together: levels are fitted to the trees "
               "of "
               "one moment; --instances trees writes a series";
    }
    if (lods && target.kind == OutputKind::Statistics) {
        return "--instances lods writes a forest; its statistics are those of --instances trees";
    }
    if (command.mesh.method == MeshMethod::Solid) {
        return "--method solid is for a single plant: the branches of a forest are instances";
    }
    if (target.kind == OutputKind::None || target.kind == OutputKind::Statistics) {
        if (command.surface.up != UpAxis::Y || command.surface.both_sides) {
            return "--up and --both-sides are for files of trees";
        }
    } else if (std::string conflict = find_surface_conflict(command.surface, target.format);
               !conflict.empty()) {
        return conflict;
    }
    if (const std::string conflict = find_option_conflict(command, target); !conflict.empty()) {
        return conflict;
    }
    if (command.frames != 0 && (command.output.empty() || command.output == "-")) {
        return "--frames writes a numbered series, so it needs -o FILE";
    }
    return {};
}

/// The state shared by all files of a run.
struct Run {
    const ForestCommand& command;
    const Console& console;
    const Project& project;
    const OutputTarget& target;
    const Scene& scene;
    GrownForest grown;
    std::vector<std::vector<InstanceMeshes>> meshes; // by species and stage
    std::optional<Mesh> ground;
};

ExitStatus make_meshes(Run& run) {
    const bool lods = run.command.instances == ForestInstances::Lods; // write_lods() makes meshes
    if (!lods || run.command.messages.format == MessageFormat::Json) {
        const ExitStatus status =
            run.console.take(mesh_forest(run.grown, run.command.mesh, run.project), run.meshes);
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    if (run.scene.terrain.kind != TerrainKind::Flat || run.command.files.size() == 1 ||
        run.grown.ground.colour != nullptr) {
        TerrainMeshOptions ground;
        ground.columns = kGroundCells;
        ground.rows = kGroundCells;
        ground.threads = run.command.run.threads;
        ground.pictures = run.grown.ground;
        // A baked mesh has tangents only if all its parts have tangents.
        ground.tangents =
            run.grown.ground.normals != nullptr || run.target.kind == OutputKind::Mesh;
        Result<Mesh> made = make_terrain_mesh(*run.grown.terrain, ground);
        if (!made) {
            return report_error(made.error(), run.console);
        }
        run.ground = std::move(made.value());
    }
    return ExitStatus::Ok;
}

/// Adds pictures as files in the folder of `path`.
ExitStatus add_pictures(const std::vector<PictureFile>& pictures,
                        const std::string& path,
                        OutputSet& outputs) {
    for (const PictureFile& picture : pictures) {
        const std::string beside =
            path_text(std::filesystem::path(path).parent_path() / picture.name);
        const ExitStatus added = outputs.add(
            beside, [&](const ByteSink& sink) { return write_picture_file(picture, sink); });
        if (added != ExitStatus::Ok) {
            return added;
        }
    }
    return ExitStatus::Ok;
}

/// The point of the scene that becomes the origin of the file.
glm::vec3 pivot_of(const Run& run) {
    if (run.command.pivot == ForestPivot::Origin) {
        return glm::vec3(0.0F);
    }
    const Region& region = run.scene.placement.region;
    const auto x = static_cast<float>(region.x + 0.5 * region.width);
    const auto z = static_cast<float>(region.z + 0.5 * region.depth);
    return {x, run.grown.terrain->height(x, z), z};
}

ExitStatus write_instances(Run& run, const ForestScene& scene, const std::string& path) {
    ForestExportInfo info;
    info.name = path_text(std::filesystem::path(path).stem());
    info.generator = "lsc " LSC_VERSION;
    constexpr float kCell = 100.0F;
    const bool whole_trees = run.command.instances != ForestInstances::Branches;
    info.cell = run.command.cell.value_or(whole_trees ? 0.0F : kCell);
    info.up = run.command.surface.up;
    info.unit = run.command.unit;
    info.pivot = pivot_of(run);
    info.collision = run.command.collision;
    info.collision_names = run.command.collision_names;
    info.threads = run.command.run.threads;
    info.compression = run.command.compression.value_or(ExportCompression::None);
    info.picture_prefix = path_text(std::filesystem::path(run.command.output).stem());
    OutputSet outputs(run.console); // pictures are added before the file that names them
    if (traits_of(run.target.format).pictures != ExportPictures::Inside) {
        info.textures = path != "-";
        std::vector<PictureFile> pictures;
        const ExitStatus status =
            run.console.take(make_forest_picture_files(scene, run.target.format, info), pictures);
        if (status != ExitStatus::Ok) {
            return status;
        }
        if (const ExitStatus added = add_pictures(pictures, path, outputs);
            added != ExitStatus::Ok) {
            return added;
        }
    }
    const ForestForm form = run.command.expand ? ForestForm::Expanded : ForestForm::Instanced;
    const auto put = [&](const ByteSink& sink) {
        return export_forest(scene, run.target.format, form, info, sink);
    };
    const ExitStatus status = outputs.add(path, put);
    return status == ExitStatus::Ok ? outputs.commit() : status;
}

ExitStatus write_baked(Run& run, const ForestScene& scene, const std::string& path) {
    const RunOptions& options = run.command.run;
    Mesh mesh;
    ExitStatus status =
        run.console.take(bake_forest(scene, options.limits.max_bytes, options.threads), mesh);
    if (status != ExitStatus::Ok) {
        return status;
    }
    place(PlantPlacement{pivot_of(run), units_per_metre(run.command.unit)}, mesh);
    ExportInfo info;
    info.subject = ExportSubject::Forest;
    info.unit = run.command.unit;
    info.grammar = path_text(std::filesystem::path(path).stem());
    info.seed = run.grown.forest.key;
    info.generator = "lsc " LSC_VERSION;
    info.threads = options.threads;
    info.compression = run.command.compression.value_or(ExportCompression::None);
    info.up = run.command.surface.up;
    info.both_sides = run.command.surface.both_sides;
    const FormatTraits& format = traits_of(run.target.format);
    OutputSet outputs(run.console); // side files are added before the mesh that names them
    if (path == "-") {
        info.textures = format.pictures == ExportPictures::Inside;
    } else {
        info.picture_prefix = path_text(std::filesystem::path(run.command.output).stem());
        std::vector<PictureFile> pictures;
        status = run.console.take(make_picture_files(mesh, run.target.format, info), pictures);
        if (status == ExitStatus::Ok) {
            status = add_pictures(pictures, path, outputs);
        }
        if (status == ExitStatus::Ok && format.has_mtl) {
            const std::filesystem::path library =
                std::filesystem::path(path).replace_extension(".mtl");
            info.mtl_name = path_text(library.filename());
            status = outputs.add(path_text(library),
                                 [&](const ByteSink& sink) { return write_mtl(mesh, info, sink); });
        }
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    const Skeleton none;
    status = outputs.add(path, [&](const ByteSink& sink) {
        return export_mesh(mesh, none, run.target.format, info, sink);
    });
    return status == ExitStatus::Ok ? outputs.commit() : status;
}

/// Writes whole heroes with levels of detail by distance.
ExitStatus write_lods(Run& run, const std::string& path) {
    ForestLods lods;
    const ExitStatus status = run.console.take(
        make_forest_lods(run.grown, run.command.mesh, run.command.viewpoint, run.project), lods);
    if (status != ExitStatus::Ok) {
        return status;
    }
    run.console.detail(fmt::format("levels of detail as seen from {:.4g},{:.4g},{:.4g}",
                                   lods.viewpoint.x, lods.viewpoint.y, lods.viewpoint.z));
    const ForestScene scene{lods.forest, lods.meshes, run.ground ? &*run.ground : nullptr};
    return run.target.kind == OutputKind::Mesh ? write_baked(run, scene, path)
                                               : write_instances(run, scene, path);
}

ExitStatus write_forest(Run& run, const std::string& path) {
    if (run.command.instances == ForestInstances::Lods && run.target.kind != OutputKind::None) {
        return write_lods(run, path);
    }
    const ForestScene scene{run.grown.forest, run.meshes, run.ground ? &*run.ground : nullptr};
    switch (run.target.kind) {
    case OutputKind::None:
        return ExitStatus::Ok;
    case OutputKind::Instances:
        return write_instances(run, scene, path);
    case OutputKind::Mesh:
        return write_baked(run, scene, path);
    case OutputKind::Statistics:
        break;
    }
    const std::string text = forest_stats_json(scene, {true, run.command.run.threads}) + "\n";
    return report_result(write_file(path, text, run.console), run.console);
}

/// Statistics as a table.
std::string stats_text(const Run& run, const ForestCounts& counts, double seconds) {
    const Forest& forest = run.grown.forest;
    const std::uint64_t different = count_different_trees(forest, run.command.run.threads);
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
                    find_tallest(run.grown, run.project), counts.digest,
                    run.grown.cache_seconds * 1e3, run.grown.place_seconds * 1e3, seconds * 1e3);
    std::vector<std::uint64_t> trees(forest.species.size(), 0);
    for (const Tree& tree : forest.trees) {
        ++trees[tree.species];
    }
    for (std::size_t s = 0; s < forest.species.size(); ++s) {
        text += fmt::format("{}: {} trees\n", forest.species[s].name, trees[s]);
        for (const ForestStage& stage : forest.species[s].stages) {
            const InstanceCache& cache = stage.cache;
            std::uint64_t hits = 0;
            std::uint64_t misses = 0;
            for (const InstanceSlot& slot : cache.slots) {
                hits += slot.hits;
                misses += slot.misses;
            }
            text += fmt::format(
                "  {} generations: {} instances of {} keys, {} segments; {} taken, {} recorded "
                "because there was none to take\n",
                stage.generations, cache.instances.size(), cache.slots.size(),
                cache.skeleton.segments.size(), hits, misses);
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

ExitStatus print_stats(const Run& run) {
    std::string text;
    if (run.command.messages.format == MessageFormat::Json) {
        const ForestScene scene{run.grown.forest, run.meshes, nullptr};
        text = forest_stats_json(scene, {true, run.command.run.threads}) + "\n";
    } else {
        const Stopwatch counting;
        const ForestCounts counts = count_forest(run.grown.forest, run.command.run.threads);
        text = stats_text(run, counts, counting.seconds());
    }
    return report_result(run.console.write(text), run.console);
}

/// Writes `frames` files of a forest whose trees have stages, from their first stage to the last.
ExitStatus write_stages(Run& run) {
    Outcome<ForestGrowth> begun = ForestGrowth::begin(run.scene, run.grown, run.project);
    if (!begun) {
        run.console.show(begun.messages());
        return status_of(begun.stop());
    }
    ForestGrowth growth = std::move(begun.value());
    for (std::uint32_t frame = 0; frame < run.command.frames; ++frame) {
        // Rounded down to a whole stage, since a file has no trees between two stages.
        const GrowthMoment moment{
            moment_of_frame(frame, run.command.frames, growth.last_year()).generation, 0.0};
        const TreeHeight no_height = [](const Tree& /*tree*/) { return 0.0F; };
        ExitStatus status =
            run.console.take(growth.trees(moment, no_height, run.project, run.grown.forest.trees));
        const std::string path = numbered_path(run.command.output, frame + 1);
        status = status == ExitStatus::Ok ? write_forest(run, path) : status;
        if (status != ExitStatus::Ok) {
            report_complete_frames(run.command.output, frame, run.command.frames, run.console);
            return status;
        }
        run.console.detail(fmt::format("{}: {} of {} stages after the start, {} plants", path,
                                       moment.generation, growth.last_year(),
                                       run.grown.forest.trees.size()));
    }
    return ExitStatus::Ok;
}

/// Writes the forest at `frames` evenly spaced years, the last of which is the last year.
ExitStatus write_years(Run& run) {
    PlacementOptions options = run.scene.placement;
    options.threads = run.project.threads;
    Result<Domination> begun = Domination::begin(options, *run.grown.terrain);
    if (!begun) {
        return report_error(Error{fmt::format("placement: {}", begun.error().message)},
                            run.console);
    }
    Domination& domination = begun.value();
    for (std::uint32_t frame = 1; frame <= run.command.frames; ++frame) {
        const auto year =
            static_cast<std::uint32_t>(std::uint64_t{options.years} * frame / run.command.frames);
        while (domination.year() < year) {
            if (run.console.interrupted()) {
                return ExitStatus::Interrupted;
            }
            if (const Result<void> done = domination.step(); !done) {
                return report_error(
                    Error{fmt::format("year {}: {}", domination.year() + 1, done.error().message)},
                    run.console);
            }
        }
        run.grown.forest.trees = domination.trees();
        if (const ExitStatus sized =
                run.console.take(size_forest(run.scene, run.project, run.grown));
            sized != ExitStatus::Ok) {
            return sized;
        }
        apply_painting(run.scene.painting, options.region, *run.grown.terrain,
                       run.grown.forest.trees);
        const std::string path = numbered_path(run.command.output, frame);
        const ExitStatus status = write_forest(run, path);
        if (status != ExitStatus::Ok) {
            report_complete_frames(run.command.output, frame - 1, run.command.frames, run.console);
            return status;
        }
        run.console.detail(
            fmt::format("{}: year {}, {} plants", path, year, run.grown.forest.trees.size()));
    }
    return ExitStatus::Ok;
}

} // namespace

ExitStatus run_command(const ForestCommand& command, const Console& console) {
    const Result<OutputTarget> target = target_of(command);
    if (!target) {
        return report_error(target.error(), console);
    }
    if (const std::string conflict = find_conflict(command, target.value()); !conflict.empty()) {
        return report_error(Error{conflict}, console);
    }
    const Project project = make_project(console, command.run);
    SceneOverrides overrides = command.overrides;
    if (command.instances != ForestInstances::Branches) {
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
    Run run{command, console, project, target.value(), scene, {}, {}, {}};
    ExitStatus status = console.take(grow_species(loaded, project, {}), run.grown);
    if (status != ExitStatus::Ok || command.check) {
        return status;
    }
    if (target.value().kind != OutputKind::None || command.messages.format == MessageFormat::Json) {
        status = make_meshes(run);
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    if (command.frames != 0 && grows) {
        status = write_years(run);
    } else {
        status = console.take(place_forest(scene, project, run.grown));
        if (status == ExitStatus::Ok) {
            status = command.frames != 0 ? write_stages(run) : write_forest(run, command.output);
        }
    }
    if (status == ExitStatus::Ok && command.stats) {
        status = print_stats(run);
    }
    return status;
}

} // namespace lsys::lsc
