#include "runtime/cli/commands.h"
#include "runtime/cli/files.h"
#include "runtime/cli/forest_scene.h"
#include "runtime/cli/grow_forest.h"
#include "runtime/cli/tell.h"
#include "runtime/domination.h"
#include "runtime/export_forest.h"
#include "runtime/turtle_diagnostic.h"

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

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kGroundCells = 128; // along each side

enum class Kind : std::uint8_t { None, Instances, Mesh, Statistics };

/// What the name of the output asks for.
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

/// Options that do not go together, in words; empty if all is well.
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

/// Everything that the files of one run share.
struct Run {
    const ForestCommand& command;
    const Console& console;
    const Target& target;
    const Scene& scene;
    GrownForest grown;
    std::vector<std::vector<InstanceMeshes>> meshes; // by species and stage
    std::optional<Mesh> ground;
};

Status show_limit(Diagnostic diagnostic, const Console& console) {
    Diagnostics diagnostics;
    diagnostics.add(std::move(diagnostic));
    static_cast<void>(console.show(diagnostics, {}));
    return Status::Limit;
}

Status make_meshes(Run& run) {
    MeshOptions options = run.command.mesh;
    options.threads = run.command.threads;
    options.max_bytes = run.command.max_bytes;
    const Forest& forest = run.grown.forest;
    for (std::size_t s = 0; s < forest.species.size(); ++s) {
        std::vector<InstanceMeshes>& meshes = run.meshes.emplace_back();
        for (const ForestStage& stage : forest.species[s].stages) {
            switch (make_instance_meshes(stage.cache, run.grown.user_meshes[s], options,
                                         meshes.emplace_back())) {
            case InstanceMeshStatus::Ok:
            case InstanceMeshStatus::Joined: // only of boxes, which are not offered
                break;
            case InstanceMeshStatus::TooManyVertices:
                return fail(Error{"the heroes have more than 4,294,967,295 vertices; ask for fewer "
                                  "--heroes, --sides or generations"},
                            run.console);
            case InstanceMeshStatus::Limit:
                return show_limit(
                    plant_limit_diagnostic("the mesh of the heroes", run.command.max_bytes),
                    run.console);
            case InstanceMeshStatus::OutOfMemory:
                return show_limit(no_memory_diagnostic("the mesh of the heroes"), run.console);
            }
        }
    }
    if (run.scene.terrain.kind != TerrainKind::Flat || run.command.files.size() == 1) {
        TerrainMeshOptions ground;
        ground.columns = kGroundCells;
        ground.rows = kGroundCells;
        ground.threads = run.command.threads;
        Result<Mesh> made = make_terrain_mesh(*run.grown.terrain, ground);
        if (!made) {
            return fail(made.error(), run.console);
        }
        run.ground = std::move(made.value());
    }
    return Status::Fine;
}

/// Writes the bytes of `write` to `path` and adds the file to `outputs`, not to be seen yet.
template <typename Write>
Status
add_output(Run& run, const std::string& path, const Write& write, std::vector<Output>& outputs) {
    Result<Output> output = Output::open(path, run.console);
    if (!output) {
        return fail(output.error(), run.console);
    }
    std::optional<Error> failure;
    const Status status = write([&](std::string_view bytes) {
        if (run.console.interrupted()) {
            return false;
        }
        const Result<Done> done = output.value().write(bytes);
        if (!done) {
            failure = done.error();
        }
        return done.ok();
    });
    if (failure) {
        return fail(*failure, run.console);
    }
    if (status != Status::Fine) {
        return status;
    }
    if (const Result<Done> finished = output.value().finish(); !finished) {
        return fail(finished.error(), run.console);
    }
    outputs.push_back(std::move(output.value()));
    return Status::Fine;
}

/// Lets the files be seen, all or none.
Status show_outputs(std::vector<Output>& outputs, const Console& console) {
    const Result<Done> done = commit_all(outputs);
    return done ? Status::Fine : fail(done.error(), console);
}

/// Writes the bytes of `write` to `path`, complete or not at all.
template <typename Write>
Status write_output(Run& run, const std::string& path, const Write& write) {
    std::vector<Output> outputs;
    const Status status = add_output(run, path, write, outputs);
    return status == Status::Fine ? show_outputs(outputs, run.console) : status;
}

Status tell(ForestExportStatus status, const Run& run) {
    switch (status) {
    case ForestExportStatus::Ok:
        return Status::Fine;
    case ForestExportStatus::Nothing:
        return fail(Error{"the forest has nothing to draw, so no file is written"}, run.console);
    case ForestExportStatus::TooLarge:
        return fail(Error{"the forest is larger than a file of this format can be"}, run.console);
    case ForestExportStatus::TooManyNodes:
        return show_limit(plant_limit_diagnostic("the expanded forest", "1,000,000 branches",
                                                 "without --expand, branches are instances"),
                          run.console);
    case ForestExportStatus::Stopped:
        return Status::Interrupted;
    case ForestExportStatus::OutOfMemory:
        return show_limit(no_memory_diagnostic("the file"), run.console);
    }
    return Status::Failure;
}

Status write_instances(Run& run, const ForestScene& scene, const std::string& path) {
    ForestExportInfo info;
    info.name = std::filesystem::path(path).stem().string();
    info.generator = "lsc " LSC_VERSION;
    info.cell = run.command.cell;
    info.threads = run.command.threads;
    info.picture_prefix = std::filesystem::path(run.command.output).stem().string();
    std::vector<Output> outputs; // pictures before the file that names them
    if (run.target.forest == ForestFormat::Usda) {
        info.textures = path != "-";
        std::vector<PictureFile> pictures;
        const Status status = tell(make_forest_picture_files(scene, info, pictures), run);
        if (status != Status::Fine) {
            return status;
        }
        for (const PictureFile& picture : pictures) {
            const std::string beside =
                (std::filesystem::path(path).parent_path() / picture.name).string();
            const auto put = [&](const ByteSink& sink) {
                return sink(picture.bytes) ? Status::Fine : Status::Interrupted;
            };
            if (const Status added = add_output(run, beside, put, outputs); added != Status::Fine) {
                return added;
            }
        }
    }
    const ForestForm form = run.command.expand ? ForestForm::Expanded : ForestForm::Instanced;
    const auto put = [&](const ByteSink& sink) {
        return tell(export_forest(scene, run.target.forest, form, info, sink), run);
    };
    const Status status = add_output(run, path, put, outputs);
    return status == Status::Fine ? show_outputs(outputs, run.console) : status;
}

Status write_baked(Run& run, const ForestScene& scene, const std::string& path) {
    Mesh mesh;
    switch (bake_forest(scene, run.command.max_bytes, run.command.threads, mesh)) {
    case MeshStatus::Ok:
        break;
    case MeshStatus::TooManyVertices:
        return fail(Error{"the baked forest has more than 4,294,967,295 vertices; without --bake, "
                          "branches are instances"},
                    run.console);
    case MeshStatus::Limit:
        return show_limit(plant_limit_diagnostic("the baked forest", run.command.max_bytes),
                          run.console);
    case MeshStatus::OutOfMemory:
        return show_limit(no_memory_diagnostic("the baked forest"), run.console);
    }
    ExportInfo info;
    info.grammar = std::filesystem::path(path).stem().string();
    info.seed = run.grown.forest.key;
    info.generator = "lsc " LSC_VERSION;
    info.textures = run.target.mesh == ExportFormat::Glb || run.target.mesh == ExportFormat::Gltf;
    const Skeleton none;
    return write_output(run, path, [&](const ByteSink& sink) {
        switch (export_mesh(mesh, none, run.target.mesh, info, sink)) {
        case ExportStatus::Ok:
            return Status::Fine;
        case ExportStatus::Nothing:
            return fail(Error{"the forest has nothing to draw, so no file is written"},
                        run.console);
        case ExportStatus::Stopped:
            return Status::Interrupted;
        case ExportStatus::OutOfMemory:
            return show_limit(no_memory_diagnostic("the file"), run.console);
        case ExportStatus::TooLarge:
        case ExportStatus::TooManyJoints:
            break;
        }
        return fail(Error{"the forest is larger than a file of this format can be"}, run.console);
    });
}

Status write_forest(Run& run, const std::string& path) {
    const ForestScene scene{run.grown.forest, run.meshes, run.ground ? &*run.ground : nullptr};
    switch (run.target.kind) {
    case Kind::None:
        return Status::Fine;
    case Kind::Instances:
        return write_instances(run, scene, path);
    case Kind::Mesh:
        return write_baked(run, scene, path);
    case Kind::Statistics:
        break;
    }
    const std::string text = forest_stats_json(scene, {true, run.command.threads}) + "\n";
    const Result<Done> done = write_file(path, text, run.console);
    return done ? Status::Fine : fail(done.error(), run.console);
}

/// The statistics as a table.
std::string stats_text(const Run& run, const ForestCounts& counts, double seconds) {
    const Forest& forest = run.grown.forest;
    const std::uint64_t different = count_different_trees(forest, run.command.threads);
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
            // Keys of one id and age together.
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

Status print_stats(const Run& run) {
    std::string text;
    if (run.command.messages.format == MessageFormat::Json) {
        const ForestScene scene{run.grown.forest, run.meshes, nullptr};
        text = forest_stats_json(scene, {true, run.command.threads}) + "\n";
    } else {
        const Clock::time_point start = Clock::now();
        const ForestCounts counts = count_forest(run.grown.forest, run.command.threads);
        const double spent = std::chrono::duration<double>(Clock::now() - start).count();
        text = stats_text(run, counts, spent);
    }
    const Result<Done> done = run.console.write(text);
    return done ? Status::Fine : fail(done.error(), run.console);
}

/// The forest in `frames` of its years, the last one included.
Status write_years(Run& run, const ForestLimits& limits) {
    PlacementOptions options = run.scene.placement;
    options.threads = limits.threads;
    Result<Domination> begun = Domination::begin(options, *run.grown.terrain);
    if (!begun) {
        return fail(Error{fmt::format("placement: {}", begun.error().message)}, run.console);
    }
    Domination& domination = begun.value();
    for (std::uint32_t frame = 1; frame <= run.command.frames; ++frame) {
        const auto year =
            static_cast<std::uint32_t>(std::uint64_t{options.years} * frame / run.command.frames);
        while (domination.year() < year) {
            if (run.console.interrupted()) {
                return Status::Interrupted;
            }
            if (const Result<Done> done = domination.step(); !done) {
                return fail(
                    Error{fmt::format("year {}: {}", domination.year() + 1, done.error().message)},
                    run.console);
            }
        }
        run.grown.forest.trees = domination.trees();
        const std::string path = numbered(run.command.output, frame);
        const Status status = write_forest(run, path);
        if (status != Status::Fine) {
            note_frames(run.command.output, frame - 1, run.command.frames, run.console);
            return status;
        }
        run.console.detail(
            fmt::format("{}: year {}, {} plants", path, year, run.grown.forest.trees.size()));
    }
    return Status::Fine;
}

} // namespace

Status run_forest(const ForestCommand& command, const Console& console) {
    const Result<Target> target = target_of(command);
    if (!target) {
        return fail(target.error(), console);
    }
    if (const std::string conflict = find_conflict(command, target.value()); !conflict.empty()) {
        return fail(Error{conflict}, console);
    }
    CommandScene loaded;
    if (const Status status = load_command_scene(command, console, loaded);
        status != Status::Fine) {
        return status;
    }
    const Scene& scene = loaded.scene;
    const bool grows = scene.placement.method == PlacementMethod::Domination;
    if (command.frames != 0 && !grows) {
        return fail(Error{"--frames shows a forest that grows, which is --placement domination"},
                    console);
    }
    const ForestLimits limits{command.threads, command.grammar.max_modules, command.max_bytes};
    Run run{command, console, target.value(), scene, {}, {}, {}};
    Status status = grow_species(scene, loaded.sources, loaded.folder, limits, console, run.grown);
    if (status != Status::Fine || command.check) {
        return status;
    }
    if (target.value().kind != Kind::None || command.messages.format == MessageFormat::Json) {
        status = make_meshes(run);
        if (status != Status::Fine) {
            return status;
        }
    }
    if (command.frames != 0) {
        status = write_years(run, limits);
    } else {
        status = place_forest(scene, limits, console, run.grown);
        if (status == Status::Fine) {
            status = write_forest(run, command.output);
        }
    }
    if (status == Status::Fine && command.stats) {
        status = print_stats(run);
    }
    return status;
}

} // namespace lsys::lsc
