#include "runtime/cli/commands.h"
#include "runtime/cli/output_set.h"
#include "runtime/export/export_forest.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/placement/domination.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
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

constexpr std::uint32_t kGroundCells = 128; // per side

enum class Kind : std::uint8_t { None, Instances, Mesh, Statistics };

/// The kind and format of the output, by its extension.
struct Target {
    Kind kind = Kind::None;
    ForestFormat forest = ForestFormat::Glb;
    ExportFormat mesh = ExportFormat::Glb;
};

Result<Target> target_of(const ForestCommand& command) {
    Target target;
    if (command.output.empty()) {
        return target;
    }
    const std::string extension = std::filesystem::path(command.output).extension().string();
    if (extension == ".json") {
        target.kind = Kind::Statistics;
        return target;
    }
    if (command.bake) {
        const std::optional<ExportFormat> format = format_of_path(command.output);
        if (!format || !uses_mesh(*format)) {
            return Error{fmt::format("`{}`: --bake writes obj, ply, off, stl, glb, gltf or usda",
                                     command.output)};
        }
        target.kind = Kind::Mesh;
        target.mesh = *format;
        return target;
    }
    target.kind = Kind::Instances;
    if (extension == ".glb") {
        target.forest = ForestFormat::Glb;
    } else if (extension == ".gltf") {
        target.forest = ForestFormat::Gltf;
    } else if (extension == ".usda") {
        target.forest = ForestFormat::Usda;
    } else {
        return Error{fmt::format("the name of `{}` does not tell a format with instances: glb, "
                                 "gltf or usda, or json for statistics; --bake writes others",
                                 command.output)};
    }
    return target;
}

/// A message about conflicting options; empty if there are none.
std::string find_conflict(const ForestCommand& command, const Target& target) {
    if (command.output.empty() && !command.stats && !command.check) {
        return "nothing is asked for; say where to write with -o, or --stats, or --check";
    }
    if (command.expand && command.bake) {
        return "--expand and --bake do not go together";
    }
    if (command.expand && (target.kind != Kind::Instances || target.forest == ForestFormat::Usda)) {
        return "--expand is for glb and gltf";
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
    const Target& target;
    const Scene& scene;
    GrownForest grown;
    std::vector<std::vector<InstanceMeshes>> meshes; // by species and stage
    std::optional<Mesh> ground;
};

ExitStatus make_meshes(Run& run) {
    const ExitStatus status =
        run.console.take(mesh_forest(run.grown, run.command.mesh, run.project), run.meshes);
    if (status != ExitStatus::Ok) {
        return status;
    }
    if (run.scene.terrain.kind != TerrainKind::Flat || run.command.files.size() == 1) {
        TerrainMeshOptions ground;
        ground.columns = kGroundCells;
        ground.rows = kGroundCells;
        ground.threads = run.command.run.threads;
        Result<Mesh> made = make_terrain_mesh(*run.grown.terrain, ground);
        if (!made) {
            return report_error(made.error(), run.console);
        }
        run.ground = std::move(made.value());
    }
    return ExitStatus::Ok;
}

/// Prints why an export ended without its file; returns the exit status.
ExitStatus report_export(ForestExportStatus status, const Run& run) {
    switch (status) {
    case ForestExportStatus::Ok:
        return ExitStatus::Ok;
    case ForestExportStatus::Nothing:
        return report_error(Error{"the forest has nothing to draw, so no file is written"},
                            run.console);
    case ForestExportStatus::TooLarge:
        return report_error(Error{"the forest is larger than a file of this format can be"},
                            run.console);
    case ForestExportStatus::TooManyNodes:
        return run.console.show(plant_limit_diagnostic("the expanded forest", "1,000,000 branches",
                                                       "without --expand, branches are instances"),
                                ExitStatus::Limit);
    case ForestExportStatus::Stopped:
        return ExitStatus::Interrupted;
    case ForestExportStatus::OutOfMemory:
        return run.console.show(no_memory_diagnostic("the file"), ExitStatus::Limit);
    }
    return ExitStatus::Failure;
}

ExitStatus write_instances(Run& run, const ForestScene& scene, const std::string& path) {
    ForestExportInfo info;
    info.name = std::filesystem::path(path).stem().string();
    info.generator = "lsc " LSC_VERSION;
    info.cell = run.command.cell;
    info.threads = run.command.run.threads;
    info.picture_prefix = std::filesystem::path(run.command.output).stem().string();
    OutputSet outputs(run.console); // pictures first, then the file with their names
    if (run.target.forest == ForestFormat::Usda) {
        info.textures = path != "-";
        std::vector<PictureFile> pictures;
        const ExitStatus status =
            report_export(make_forest_picture_files(scene, info, pictures), run);
        if (status != ExitStatus::Ok) {
            return status;
        }
        for (const PictureFile& picture : pictures) {
            const std::string beside =
                (std::filesystem::path(path).parent_path() / picture.name).string();
            const auto put = [&](const ByteSink& sink) {
                return sink(picture.bytes) ? ExitStatus::Ok : ExitStatus::Interrupted;
            };
            if (const ExitStatus added = outputs.add(beside, put); added != ExitStatus::Ok) {
                return added;
            }
        }
    }
    const ForestForm form = run.command.expand ? ForestForm::Expanded : ForestForm::Instanced;
    const auto put = [&](const ByteSink& sink) {
        return report_export(export_forest(scene, run.target.forest, form, info, sink), run);
    };
    const ExitStatus status = outputs.add(path, put);
    return status == ExitStatus::Ok ? outputs.commit() : status;
}

ExitStatus write_baked(Run& run, const ForestScene& scene, const std::string& path) {
    Mesh mesh;
    switch (bake_forest(scene, run.command.run.limits.max_bytes, run.command.run.threads, mesh)) {
    case MeshStatus::Ok:
        break;
    case MeshStatus::TooManyVertices:
        return report_error(
            Error{"the baked forest has more than 4,294,967,295 vertices; without --bake, "
                  "branches are instances"},
            run.console);
    case MeshStatus::Limit:
        return run.console.show(
            plant_limit_diagnostic("the baked forest", run.command.run.limits.max_bytes),
            ExitStatus::Limit);
    case MeshStatus::OutOfMemory:
        return run.console.show(no_memory_diagnostic("the baked forest"), ExitStatus::Limit);
    }
    ExportInfo info;
    info.grammar = std::filesystem::path(path).stem().string();
    info.seed = run.grown.forest.key;
    info.generator = "lsc " LSC_VERSION;
    info.textures = run.target.mesh == ExportFormat::Glb || run.target.mesh == ExportFormat::Gltf;
    const Skeleton none;
    OutputSet outputs(run.console);
    const ExitStatus status = outputs.add(path, [&](const ByteSink& sink) {
        switch (export_mesh(mesh, none, run.target.mesh, info, sink)) {
        case ExportStatus::Ok:
            return ExitStatus::Ok;
        case ExportStatus::Nothing:
            return report_error(Error{"the forest has nothing to draw, so no file is written"},
                                run.console);
        case ExportStatus::Stopped:
            return ExitStatus::Interrupted;
        case ExportStatus::OutOfMemory:
            return run.console.show(no_memory_diagnostic("the file"), ExitStatus::Limit);
        case ExportStatus::TooLarge:
        case ExportStatus::TooManyJoints:
            break;
        }
        return report_error(Error{"the forest is larger than a file of this format can be"},
                            run.console);
    });
    return status == ExitStatus::Ok ? outputs.commit() : status;
}

ExitStatus write_forest(Run& run, const std::string& path) {
    const ForestScene scene{run.grown.forest, run.meshes, run.ground ? &*run.ground : nullptr};
    switch (run.target.kind) {
    case Kind::None:
        return ExitStatus::Ok;
    case Kind::Instances:
        return write_instances(run, scene, path);
    case Kind::Mesh:
        return write_baked(run, scene, path);
    case Kind::Statistics:
        break;
    }
    const std::string text = forest_stats_json(scene, {true, run.command.run.threads}) + "\n";
    return report_result(write_file(path, text, run.console), run.console);
}

/// Statistics as a table.
std::string stats_text(const Run& run, const ForestCounts& counts, double seconds) {
    const Forest& forest = run.grown.forest;
    const std::uint64_t different = count_different_trees(forest, run.command.run.threads);
    std::string text = fmt::format(
        "trees      {}, {} of them different\n"
        "branches   {} ({:.1f} a tree, at most {})\n"
        "segments   {}, objects {}, polygons {}\n"
        "digest     {:016x}\n"
        "heroes     {:.1f} ms, placement {:.1f} ms, expansion {:.1f} ms\n",
        counts.trees, different, counts.branches,
        counts.trees == 0
            ? 0.0
            : static_cast<double>(counts.branches) / static_cast<double>(counts.trees),
        counts.most_branches, counts.segments, counts.objects, counts.polygons, counts.digest,
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
            // The sum over all keys of an id and age.
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

/// Writes the forest in `frames` of its years, including the last.
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
            if (const Result<Done> done = domination.step(); !done) {
                return report_error(
                    Error{fmt::format("year {}: {}", domination.year() + 1, done.error().message)},
                    run.console);
            }
        }
        run.grown.forest.trees = domination.trees();
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
    const Result<Target> target = target_of(command);
    if (!target) {
        return report_error(target.error(), console);
    }
    if (const std::string conflict = find_conflict(command, target.value()); !conflict.empty()) {
        return report_error(Error{conflict}, console);
    }
    const Project project = make_project(console, command.run);
    LoadedScene loaded;
    if (const ExitStatus status =
            console.take(load_scene(command.files, command.overrides, project), loaded);
        status != ExitStatus::Ok) {
        return status;
    }
    const Scene& scene = loaded.scene;
    const bool grows = scene.placement.method == PlacementMethod::Domination;
    if (command.frames != 0 && !grows) {
        return report_error(
            Error{"--frames shows a forest that grows, which is --placement domination"}, console);
    }
    Run run{command, console, project, target.value(), scene, {}, {}, {}};
    ExitStatus status = console.take(grow_species(loaded, project, {}), run.grown);
    if (status != ExitStatus::Ok || command.check) {
        return status;
    }
    if (target.value().kind != Kind::None || command.messages.format == MessageFormat::Json) {
        status = make_meshes(run);
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    if (command.frames != 0) {
        status = write_years(run);
    } else {
        Done placed;
        status = console.take(place_forest(scene, project, run.grown), placed);
        if (status == ExitStatus::Ok) {
            status = write_forest(run, command.output);
        }
    }
    if (status == ExitStatus::Ok && command.stats) {
        status = print_stats(run);
    }
    return status;
}

} // namespace lsys::lsc
