#include "grammar/base/counted_text.h"
#include "grammar/base/paths.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/derivation_report.h"
#include "runtime/cli/export_stats.h"
#include "runtime/cli/lod_files.h"
#include "runtime/cli/output_set.h"
#include "runtime/cli/plant_options.h"
#include "runtime/cli/progress.h"
#include "runtime/cli/surface_options.h"
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/export/export.h"
#include "runtime/export/placed_plant.h"
#include "runtime/meshing/mesh.h"
#include "runtime/physics/animation.h"
#include "runtime/pipeline/plant.h"
#include "runtime/pipeline/plant_growth.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/program/weight_report.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

/// The state shared by all files of an export.
struct Export {
    const ExportCommand& command;
    ExportFormat format;
    const Grammar& grammar;
    const Console& console;
    const Project& project;
    const Plant& plant;
    ExportTiming timing;
    Mesh mesh;                           // of the last file
    DetailLevels levels;                 // of the plant; empty if only the finest level is needed
    std::set<std::string> pictures;      // names of the written pictures, shared by all frames
    std::optional<glm::vec3> pivot = {}; // for all frames of a growth: pivot of the last plant
    bool is_placed = false;              // whether pivot and unit have been applied to the mesh
    std::vector<Mesh>* collected = nullptr; // if not null, receives the meshes in place of files
    const PlantVariants* variants = nullptr;
};

/// Adds the files that accompany the file `path`: pictures, the materials of an OBJ, the buffer of
/// a glTF. Puts their names into `info`.
ExitStatus add_side_files(Export& run,
                          const Skeleton& skeleton,
                          const std::filesystem::path& path,
                          ExportInfo& info,
                          OutputSet& files) {
    // Each level of detail has pictures of its own; all frames share theirs.
    info.picture_prefix = run.command.lods != 0
                              ? path_text(path.stem())
                              : path_text(std::filesystem::path(run.command.output).stem());
    const bool separate = run.command.buffers == BufferPlace::Separate;
    const std::filesystem::path buffer = std::filesystem::path(path).replace_extension(".bin");
    info.buffer_name = separate ? path_text(buffer.filename()) : std::string();
    std::vector<PictureFile> pictures;
    ExitStatus status = run.console.take(make_picture_files(run.mesh, run.format, info), pictures);
    if (status != ExitStatus::Ok) {
        return status;
    }
    for (const PictureFile& picture : pictures) {
        if (!run.pictures.insert(picture.name).second) {
            continue;
        }
        status = files.add(path.parent_path() / picture.name,
                           [&](const ByteSink& sink) { return write_picture_file(picture, sink); });
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    if (separate) {
        return files.add(path_text(buffer), [&](const ByteSink& sink) {
            return write_gltf_buffer(run.mesh, skeleton, info, sink);
        });
    }
    if (!traits_of(run.format).has_mtl) {
        return ExitStatus::Ok;
    }
    const std::filesystem::path library = std::filesystem::path(path).replace_extension(".mtl");
    info.mtl_name = path_text(library.filename());
    return files.add(path_text(library),
                     [&](const ByteSink& sink) { return write_mtl(run.mesh, info, sink); });
}

/// Whether `path` is, or will be, a regular file: only then can other files accompany it.
bool is_regular(const std::string& path) {
    std::error_code ignored;
    const auto kind = std::filesystem::status(path, ignored).type();
    return path != "-" && (kind == std::filesystem::file_type::not_found ||
                           kind == std::filesystem::file_type::regular);
}

/// Plans levels of detail, once for all poses of the plant. Sets DetailChain::pictures if the format
/// and the output allow pictures.
ExitStatus plan_levels(Export& run, const Skeleton& skeleton, DetailChain chain) {
    const bool is_pose = skeleton.segments.size() == run.plant.skeleton.segments.size() &&
                         skeleton.objects.size() == run.plant.skeleton.objects.size() &&
                         skeleton.polygons.size() == run.plant.skeleton.polygons.size();
    if (!run.levels.levels.empty() && is_pose) {
        return ExitStatus::Ok;
    }
    MeshOptions finest = run.command.mesh;
    finest.level = 0;
    const ExportPictures pictures = traits_of(run.format).pictures;
    chain.pictures = pictures == ExportPictures::Inside ||
                     (pictures != ExportPictures::None && is_regular(run.command.output));
    return run.console.take(plan_plant_levels(run.plant, is_pose ? run.plant.skeleton : skeleton,
                                              finest, chain, run.project),
                            run.levels);
}

/// Meshes the level of detail of `skeleton` given by `--level`, at most the coarsest level.
ExitStatus mesh_wanted_level(Export& run, const Skeleton& skeleton, const MeshOptions& options) {
    const std::uint32_t wanted = run.command.mesh.level;
    if (wanted == 0) {
        return run.console.take(mesh_plant(run.plant, skeleton, options, run.project), run.mesh);
    }
    const ExitStatus status = plan_levels(run, skeleton, {.last = wanted, .first_fitted = wanted});
    if (status != ExitStatus::Ok) {
        return status;
    }
    const std::size_t number = std::min<std::size_t>(wanted, run.levels.levels.size() - 1);
    return run.console.take(
        mesh_plant_level(run.plant, skeleton, run.levels, number, options, run.project), run.mesh);
}

ExportInfo export_info(const Export& run) {
    const ExportCommand& command = run.command;
    ExportInfo info;
    info.grammar = path_text(std::filesystem::path(command.file).filename());
    // Nodes are named after the output, else after the grammar; exporters have a default name.
    const std::string& named = command.output == "-" ? command.file : command.output;
    info.name = named == "-" ? "" : path_text(std::filesystem::path(named).stem());
    info.seed = run.plant.seed;
    info.generations = run.plant.generations;
    info.generator = "lsc " LSC_VERSION;
    info.user_meshes = &run.plant.user_meshes;
    info.threads = command.run.threads;
    info.wind_data = command.wind_data;
    info.compression = command.compression.value_or(ExportCompression::None);
    info.up = command.surface.up;
    info.both_sides = command.surface.both_sides;
    info.unit = command.unit;
    info.collision = command.collision;
    info.collision_names = command.collision_names;
    return info;
}

/// Pivot and unit of the plant in its files. The pivot is a point of the plant at rest.
PlantPlacement placement_of(const Export& run, const Skeleton& skeleton) {
    if (run.is_placed) {
        return {};
    }
    const Skeleton& rest = run.plant.skeleton.segments.empty() ? skeleton : run.plant.skeleton;
    return {run.pivot.value_or(pivot_of(rest, run.command.pivot)),
            units_per_metre(run.command.unit)};
}

/// Makes the mesh of `skeleton`. `segments`: with the segment of each vertex.
ExitStatus mesh_frame(Export& run, const Skeleton& skeleton, bool segments) {
    const SteadyClock::time_point start = SteadyClock::now();
    MeshOptions options = run.command.mesh;
    options.segments = segments;
    run.mesh = {};
    // Frames of a growth are different plants, so planned levels do not fit them: `--level` only
    // reduces the number of sides.
    const ExitStatus status =
        run.command.grow
            ? run.console.take(mesh_plant(run.plant, skeleton, options, run.project), run.mesh)
            : mesh_wanted_level(run, skeleton, options);
    run.timing.mesh_seconds += seconds_since(start);
    return status;
}

/// The motion of the mesh of a file. Both null: no motion.
struct Movement {
    const PlantAnimation* animation = nullptr;
    const MeshFilm* film = nullptr;
};

/// Writes the mesh `run.mesh` and its side files to `path`.
ExitStatus write_mesh(Export& run,
                      const Skeleton& skeleton,
                      const std::string& path,
                      const Movement& movement) {
    const ExportCommand& command = run.command;
    const SteadyClock::time_point start = SteadyClock::now();
    ExportInfo info = export_info(run);
    info.animation = movement.animation;
    info.film = movement.film;
    info.variants = run.variants;
    constexpr std::uint32_t kDefaultJoints = 128;
    info.max_joints = command.bones.value_or(kDefaultJoints);
    const PlantPlacement placement = placement_of(run, skeleton);
    const bool stays = placement == PlantPlacement{};
    Skeleton placed;
    PlantAnimation placed_animation;
    if (!stays) {
        placed = skeleton;
        place(placement, run.mesh);
        place(placement, placed);
        if (movement.animation != nullptr) {
            placed_animation = *movement.animation;
            place(placement, placed_animation);
            info.animation = &placed_animation;
        }
    }
    const Skeleton& written = stays ? skeleton : placed;
    OutputSet files(run.console);
    ExitStatus status = ExitStatus::Ok;
    if (is_regular(path)) {
        status = add_side_files(run, written, path, info, files);
    }
    if (status == ExitStatus::Ok) {
        status = files.add(path, [&](const ByteSink& sink) {
            return export_mesh(run.mesh, written, run.format, info, sink);
        });
    }
    if (status == ExitStatus::Ok) {
        status = files.commit();
    }
    run.timing.bytes += files.byte_count();
    run.timing.write_seconds += seconds_since(start);
    return status;
}

/// Meshes `skeleton` and writes the mesh to `path`. With `animation` the mesh is a skin, whose
/// first pose is `skeleton`.
ExitStatus write_plant(Export& run,
                       const Skeleton& skeleton,
                       const std::string& path,
                       const PlantAnimation* animation = nullptr) {
    if (traits_of(run.format).uses_mesh) {
        const ExitStatus status =
            mesh_frame(run, skeleton, animation != nullptr || run.command.wind_data);
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    return write_mesh(run, skeleton, path, {animation, nullptr});
}

/// Writes the levels of detail of `skeleton`: all into one file, or one file per level and a list.
ExitStatus write_lods(Export& run, const Skeleton& skeleton) {
    const ExportCommand& command = run.command;
    const bool one_file = traits_of(run.format).lods && !command.lod_files;
    SteadyClock::time_point start = SteadyClock::now();
    ExitStatus status = plan_levels(run, skeleton, {.count = command.lods});
    if (status != ExitStatus::Ok) {
        return status;
    }
    const std::size_t count = run.levels.levels.size();
    if (count < command.lods) {
        run.console.info(
            fmt::format("the plant has {} {} of detail", count, count == 1 ? "level" : "levels"));
    }
    MeshOptions options = command.mesh;
    options.segments = command.wind_data;
    std::vector<CoarserMesh> meshes(count);
    for (std::size_t i = 0; i < count && status == ExitStatus::Ok; ++i) {
        status = run.console.take(
            mesh_plant_level(run.plant, skeleton, run.levels, i, options, run.project),
            meshes[i].mesh);
    }
    if (status != ExitStatus::Ok) {
        return status;
    }
    const PlantExtent extent = extent_of(meshes.front().mesh);
    for (std::size_t i = 0; i < count; ++i) {
        meshes[i].coverage = screen_coverage(extent, run.levels.levels[i].pixels);
    }
    Skeleton placed = skeleton;
    if (const PlantPlacement placement = placement_of(run, skeleton);
        placement != PlantPlacement{}) {
        place(placement, placed);
        for (CoarserMesh& each : meshes) {
            place(placement, each.mesh);
        }
    }
    run.mesh = std::move(meshes.front().mesh);
    run.timing.mesh_seconds += seconds_since(start);
    start = SteadyClock::now();
    const ExportInfo origin = export_info(run);
    OutputSet files(run.console);
    if (one_file) {
        meshes.erase(meshes.begin());
        ExportInfo info = origin;
        info.coarser = &meshes;
        if (is_regular(command.output)) {
            status = add_side_files(run, placed, command.output, info, files);
        }
        if (status != ExitStatus::Ok) {
            return status;
        }
        status = files.add(command.output, [&](const ByteSink& sink) {
            return export_mesh(run.mesh, placed, run.format, info, sink);
        });
    } else {
        std::vector<LodFile> list;
        Mesh finest; // kept for the statistics
        for (std::size_t i = 0; i < count && status == ExitStatus::Ok; ++i) {
            if (i == 1) {
                finest = std::move(run.mesh);
            }
            if (i > 0) {
                run.mesh = std::move(meshes[i].mesh);
            }
            const std::string path = lod_path(command.output, i);
            ExportInfo info = origin;
            info.collision = i == 0 ? origin.collision : CollisionKind::None;
            status = add_side_files(run, placed, path, info, files);
            if (status == ExitStatus::Ok) {
                status = files.add(path, [&](const ByteSink& sink) {
                    return export_mesh(run.mesh, placed, run.format, info, sink);
                });
            }
            list.push_back({.name = path_text(std::filesystem::path(path).filename()),
                            .triangles = run.mesh.indices.size() / 3,
                            .pixels = run.levels.levels[i].pixels,
                            .coverage = meshes[i].coverage});
        }
        if (count > 1) {
            run.mesh = std::move(finest);
        }
        if (status == ExitStatus::Ok) {
            const std::string text = lods_json(origin, extent, list);
            status = files.add(lods_json_path(command.output),
                               [&](const ByteSink& sink) -> Outcome<void> {
                                   return sink(text) ? Outcome<void>()
                                                     : Outcome<void>(Stop::Cancelled, Messages{});
                               });
        }
    }
    if (status == ExitStatus::Ok) {
        status = files.commit();
    }
    run.timing.bytes += files.byte_count();
    run.timing.write_seconds += seconds_since(start);
    return status;
}

/// Writes a plant that does not move.
ExitStatus write_still(Export& run, const Skeleton& skeleton) {
    if (run.collected != nullptr) {
        const ExitStatus status = mesh_frame(run, skeleton, false);
        if (status == ExitStatus::Ok) {
            place(placement_of(run, skeleton), run.mesh);
            run.collected->push_back(std::move(run.mesh));
        }
        return status;
    }
    return run.command.lods != 0 ? write_lods(run, skeleton)
                                 : write_plant(run, skeleton, run.command.output);
}

/// Reports an error if the `bytes` of an animation exceed the memory limit.
ExitStatus check_animation(const Export& run, std::uint64_t bytes) {
    const std::uint64_t limit = run.command.run.limits.max_bytes;
    return bytes <= limit ? ExitStatus::Ok
                          : show_diagnostic(plant_limit_diagnostic(
                                                "the animation", byte_size_text(limit),
                                                "ask for fewer frames with `--frames`, for fewer "
                                                "generations with `-n`, or raise the limit with "
                                                "`--max-memory`"),
                                            ExitStatus::Limit, run.grammar, run.console);
}

/// Writes the motion as a loop, to one file or to numbered files.
ExitStatus write_loop(Export& run, PlantPhysics& physics) {
    const ExportCommand& command = run.command;
    const std::uint64_t segments = run.plant.skeleton.segments.size();
    if (const ExitStatus fits = check_animation(run, loop_bytes(segments, command.frames));
        fits != ExitStatus::Ok) {
        return fits;
    }
    const PlantLoop loop = record_loop(physics, command.frames, command.frames_per_second);
    run.console.detail(fmt::format("the loop ends within {:.3g} % of the plant's size of where it "
                                   "begins, after {} before it",
                                   100.0 * loop.mismatch, counted(loop.run_in, "loop")));
    Skeleton pose;
    pose_at(physics.rest(), loop.animation.frame(0), pose);
    if (traits_of(run.format).motion) {
        return write_plant(run, pose, command.output, &loop.animation);
    }
    for (std::uint32_t frame = 1; frame <= command.frames; ++frame) {
        pose_at(physics.rest(), loop.animation.frame(frame - 1), pose);
        const ExitStatus status = write_plant(run, pose, numbered_path(command.output, frame));
        if (status != ExitStatus::Ok) {
            report_complete_frames(command.output, frame - 1, command.frames, run.console);
            return status;
        }
    }
    return ExitStatus::Ok;
}

/// Writes all frames of the motion to one file.
ExitStatus write_animation(Export& run, PlantPhysics& physics) {
    const ExportCommand& command = run.command;
    const std::uint64_t segments = run.plant.skeleton.segments.size();
    if (const ExitStatus fits = check_animation(run, animation_bytes(segments, command.frames));
        fits != ExitStatus::Ok) {
        return fits;
    }
    Skeleton first;
    physics.pose(first);
    const PlantAnimation animation = record(physics, command.frames, command.frames_per_second);
    return write_plant(run, first, command.output, &animation);
}

/// Warns if the plant falls under its own weight, without wind. Large plants are not checked,
/// because the check settles the plant many times.
ExitStatus check_weight(const Export& run, const PhysicsOptions& options) {
    Diagnostics warning =
        make_fall_warning(run.plant.skeleton, run.grammar.bytecode.settings, options);
    return warning.all().empty() ? ExitStatus::Ok : run.console.show(warning, *run.grammar.sources);
}

/// Writes the plant bent by weight and wind: at rest, or in frames of its motion.
ExitStatus write_bent(Export& run) {
    const ExportCommand& command = run.command;
    constexpr double kRestAngle = 1e-6; // radians
    constexpr float kStepsPerSecond = 60.0F;
    PhysicsOptions options;
    options.gravity = command.gravity.value_or(0.0F);
    options.wind = command.wind.value_or(Wind{});
    options.damping = run.grammar.bytecode.settings.damping;
    options.load = run.grammar.bytecode.settings.load;
    options.threads = command.run.threads;
    // Use a whole number of simulation steps per frame.
    const auto steps = static_cast<std::uint32_t>(
        std::max(1.0F, std::ceil(kStepsPerSecond / command.frames_per_second)));
    options.time_step = 1.0F / (command.frames_per_second * static_cast<float>(steps));
    if (const ExitStatus weight = check_weight(run, options); weight != ExitStatus::Ok) {
        return weight;
    }
    PlantPhysics physics(run.plant.skeleton, options);
    if (command.loop) {
        return write_loop(run, physics);
    }
    const std::size_t segments = run.plant.skeleton.segments.size();
    const std::uint32_t rounds = settle_rounds(segments);
    if ((command.settle || command.frames == 0) && !physics.settle(kRestAngle, rounds)) {
        run.console.info(fmt::format("the plant has not quite come to rest in {} rounds, the limit "
                                     "for {} segments",
                                     rounds, segments));
    }
    Skeleton bent;
    if (command.frames == 0) {
        physics.pose(bent);
        return write_still(run, bent);
    }
    if (traits_of(run.format).motion) {
        return write_animation(run, physics);
    }
    for (std::uint32_t frame = 1; frame <= command.frames; ++frame) {
        physics.pose(bent);
        const ExitStatus status = write_plant(run, bent, numbered_path(command.output, frame));
        if (status != ExitStatus::Ok) {
            report_complete_frames(command.output, frame - 1, command.frames, run.console);
            return status;
        }
        for (std::uint32_t step = 0; step < steps; ++step) {
            physics.step();
        }
    }
    return ExitStatus::Ok;
}

/// Prints the counts of the plant and the times of the export.
ExitStatus write_stats(const Export& run, const Plant& plant) {
    const ExportCommand& command = run.command;
    const std::string text = command.messages.format == MessageFormat::Json
                                 ? export_stats_json(plant, run.mesh, run.timing)
                                 : export_stats_text(plant, run.mesh, run.timing);
    if (command.output == "-") { // standard output is taken by the plant
        run.console.line(text);
        return ExitStatus::Ok;
    }
    return report_result(run.console.write(text), run.console);
}

bool is_empty(const Skeleton& skeleton) {
    return skeleton.segments.empty() && skeleton.objects.empty() && skeleton.polygons.empty();
}

/// Sets `generation` to the first generation that draws something, or to 0 if none does.
ExitStatus find_first_drawn(const Export& run, PlantGrowth& growth, std::uint32_t& generation) {
    Skeleton drawn;
    for (generation = 0; generation <= growth.last_generation(); ++generation) {
        const ExitStatus status =
            run.console.interrupted()
                ? ExitStatus::Interrupted
                : run.console.take(growth.pose({generation, 0.0}, run.project, drawn));
        if (status != ExitStatus::Ok || !is_empty(drawn)) {
            return status;
        }
    }
    generation = 0;
    return ExitStatus::Ok;
}

/// Sets `grown` to the skeleton of a moment.
ExitStatus
pose_growth(const Export& run, PlantGrowth& growth, const GrowthMoment& moment, Skeleton& grown) {
    return run.console.interrupted() ? ExitStatus::Interrupted
                                     : run.console.take(growth.pose(moment, run.project, grown));
}

/// Sets the pivot of all frames to the pivot of the last plant. Derives nothing if the pivot is the
/// origin.
ExitStatus find_growth_pivot(Export& run, PlantGrowth& growth) {
    if (run.command.pivot == PlantPivot::Origin) {
        return ExitStatus::Ok;
    }
    Skeleton last;
    const Outcome<void> posed = growth.pose({growth.last_generation(), 0.0}, run.project, last);
    if (!posed) {
        run.console.show(posed.messages());
        return status_of(posed.stop());
    }
    run.pivot = pivot_of(last, run.command.pivot); // writing the last frame prints the messages
    return ExitStatus::Ok;
}

/// Writes the growth of the plant from its axiom to its last generation, one numbered file per
/// frame. `grown` becomes the skeleton of the last frame.
ExitStatus write_growth(Export& run, PlantGrowth& growth, Skeleton& grown) {
    const ExportCommand& command = run.command;
    std::uint32_t first = 0;
    if (const ExitStatus status = find_first_drawn(run, growth, first); status != ExitStatus::Ok) {
        return status;
    }
    // Growth starts at the last generation that draws nothing. This generation has no file, since it is
    // empty: the first frame is one step later.
    const std::uint32_t start = first == 0 ? 0 : first - 1;
    const std::uint32_t skipped = first == 0 ? 0 : 1;
    if (first > 0) {
        run.console.info(fmt::format("nothing is drawn before generation {}; the first frame is on "
                                     "the way to it",
                                     first));
    }
    if (const ExitStatus status = find_growth_pivot(run, growth); status != ExitStatus::Ok) {
        return status;
    }
    for (std::uint32_t frame = 0; frame < command.frames; ++frame) {
        GrowthMoment moment = moment_of_frame(frame + skipped, command.frames + skipped,
                                              growth.last_generation() - start);
        moment.generation += start;
        ExitStatus status = pose_growth(run, growth, moment, grown);
        if (status == ExitStatus::Ok) {
            status = write_plant(run, grown, numbered_path(command.output, frame + 1));
        }
        if (status != ExitStatus::Ok) {
            report_complete_frames(command.output, frame, command.frames, run.console);
            return status;
        }
    }
    return ExitStatus::Ok;
}

/// Writes the growth of the plant from its axiom to its last generation to one file. `grown`
/// becomes the skeleton of the last frame.
ExitStatus write_film(Export& run, PlantGrowth& growth, Skeleton& grown) {
    const ExportCommand& command = run.command;
    MeshFilmBuilder builder(command.frames_per_second);
    for (std::uint32_t frame = 0; frame < command.frames; ++frame) {
        ExitStatus status = pose_growth(
            run, growth, moment_of_frame(frame, command.frames, growth.last_generation()), grown);
        if (status == ExitStatus::Ok) {
            status = mesh_frame(run, grown, false);
        }
        if (status == ExitStatus::Ok) {
            builder.add(std::move(run.mesh));
            status = check_animation(run, builder.byte_count());
        }
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    MeshFilm film = builder.finish();
    place(placement_of(run, grown), film);
    run.is_placed = true;
    run.mesh = std::move(film.mesh);
    return write_mesh(run, grown, command.output, {nullptr, &film});
}

/// A message about options of levels of detail that conflict; empty if none do.
std::string find_lod_conflict(const ExportCommand& command, ExportFormat format) {
    if (command.lod_files && command.lods == 0) {
        return "--lod-files needs the number of levels: --lods";
    }
    if (command.lods == 0) {
        return {};
    }
    if (command.mesh.level != 0) {
        return "--lods and --level do not go together: --lods writes several levels, --level one "
               "of them";
    }
    if (command.frames != 0) {
        return "--lods and --frames do not go together: levels have other vertices, and only one "
               "set "
               "of them can have the skin or the shapes; --level K writes one coarser level that "
               "moves";
    }
    if (command.mesh.method == MeshMethod::Solid) {
        return "--lods and --method solid do not go together: a solid has no coarser levels; a "
               "larger "
               "--min-width gives it fewer triangles";
    }
    if (!traits_of(format).uses_mesh) {
        return fmt::format("--lods needs a format with triangles, which {} is not",
                           traits_of(format).name);
    }
    const bool one_file = traits_of(format).lods && !command.lod_files;
    if (one_file && command.buffers == BufferPlace::Separate) {
        return "--lods in one file holds its buffer and pictures, so --buffers separate needs "
               "--lod-files";
    }
    if (!one_file && !is_regular(command.output)) {
        return fmt::format("--lods writes several files here, which need a file name; {} hold all "
                           "levels in one",
                           format_names("and", [](const FormatTraits& each) { return each.lods; }));
    }
    return {};
}

/// A message about options that conflict with --variants; empty if none do.
std::string find_variant_conflict(const ExportCommand& command, ExportFormat format) {
    if (!command.variants) {
        return {};
    }
    const std::string instead = fmt::format(
        "a file for each value: -D {}={}", command.variants->name, command.variants->texts.front());
    if (!traits_of(format).variants) {
        return fmt::format("--variants is for {}; other formats take {}",
                           format_names("and", [](const auto& each) { return each.variants; }),
                           instead);
    }
    if (command.lods != 0) {
        return "--variants and --lods do not go together, because each plant has levels of its "
               "own; write " +
               instead;
    }
    if (command.frames != 0) {
        return "--variants and --frames do not go together, because each plant moves in its own "
               "way; write " +
               instead;
    }
    if (is_standard_input(command.file)) {
        return "--variants reads the grammar for each value, so it needs a file and not standard "
               "input";
    }
    const auto& given = command.grammar.definitions;
    if (std::any_of(given.begin(), given.end(),
                    [&](const Definition& each) { return each.name == command.variants->name; })) {
        return fmt::format("`{}` has one value by -D and several by --variants; leave out one of "
                           "them",
                           command.variants->name);
    }
    return {};
}

/// A message about options that conflict; empty if none do.
std::string find_conflict(const ExportCommand& command, ExportFormat format) {
    const bool bends = command.gravity || command.wind;
    if (std::string conflict = find_lod_conflict(command, format); !conflict.empty()) {
        return conflict;
    }
    if (const std::string conflict = find_variant_conflict(command, format); !conflict.empty()) {
        return conflict;
    }
    const auto names_with = [](bool FormatTraits::*feature) {
        return format_names("or", [feature](const FormatTraits& each) { return each.*feature; });
    };
    if (command.compression && !traits_of(format).compresses) {
        return fmt::format("--compress needs {}, not {}", names_with(&FormatTraits::compresses),
                           traits_of(format).name);
    }
    if (command.buffers && !traits_of(format).separates) {
        return fmt::format("--buffers needs {}, not {}", names_with(&FormatTraits::separates),
                           traits_of(format).name);
    }
    if (command.grow && command.frames == 0) {
        return "--grow needs the number of its frames: --frames N";
    }
    if (command.grow && bends) {
        return "--grow and --gravity or --wind do not go together: the frames show either the "
               "generations of a plant or the motion of the last one";
    }
    if (command.grow && (command.wind_data || command.bones)) {
        return "--grow and --wind-data or --bones do not go together, because branches come and "
               "go; "
               "both are for the plant that has grown, without --grow";
    }
    if (command.grow &&
        command.compression.value_or(ExportCompression::None) != ExportCompression::None) {
        return "--grow and --compress do not go together: the changes from frame to frame are not "
               "quantised; fewer --frames or --level K make a smaller file";
    }
    if (command.grow && command.stream) {
        return "--grow and --stream do not go together, because a generation is drawn between "
               "stored words";
    }
    constexpr std::uint32_t kMinLoopFrames = 3;
    if (command.loop && command.frames < kMinLoopFrames) {
        return fmt::format("--loop needs --frames N of at least {}: the last is the first again",
                           kMinLoopFrames);
    }
    if (command.bones && (command.frames == 0 || !traits_of(format).motion)) {
        return fmt::format(
            "--bones are joints of an animation: --frames N and {}",
            format_names("or", [](const FormatTraits& each) { return each.motion; }));
    }
    if (command.wind_data && !traits_of(format).wind_data) {
        return fmt::format(
            "--wind-data is for shaders, and has a place in {}",
            format_names("and", [](const FormatTraits& each) { return each.wind_data; }));
    }
    if (command.unit != LengthUnit::Metres && !traits_of(format).units) {
        return fmt::format("--unit is for {}; {}",
                           format_names("and", [](const auto& each) { return each.units; }),
                           traits_of(format).collision
                               ? "glTF is in metres by definition, and importers scale it to the "
                                 "unit of the engine"
                               : "this format has a scale of its own");
    }
    if (command.collision != CollisionKind::None && !traits_of(format).collision) {
        return fmt::format(
            "--collision has a place in {}",
            format_names("and", [](const FormatTraits& each) { return each.collision; }));
    }
    if (command.grow && command.collision != CollisionKind::None) {
        return "--grow and --collision do not go together, because branches come and go; take the "
               "shapes from a file of the plant that has grown, without --grow";
    }
    if (command.loop && command.grow) {
        return "--loop and --grow do not go together, because a plant that has grown is another";
    }
    if (command.loop && (!command.wind || !(command.wind->gust > 0.0F))) {
        return "--loop needs gusts, without which a plant comes to rest: --wind 8,0,0,0.5";
    }
    if (command.settle && !bends) {
        return "--settle needs a force: --gravity or --wind";
    }
    if (command.frames != 0 && !bends && !command.grow) {
        return "--frames needs something that moves: --gravity, --wind or --grow";
    }
    const bool one_file = command.grow ? traits_of(format).film : traits_of(format).motion;
    if (command.frames != 0 && command.output == "-" && !one_file) {
        return fmt::format(
            "--frames writes several files of this format, which do not go to standard "
            "output; {} hold all frames in one",
            format_names("and", [&](const FormatTraits& each) {
                return command.grow ? each.film : each.motion;
            }));
    }
    return {};
}

/// The plant for one value of --variants.
struct VariantPlant {
    ExportCommand command;
    Grammar grammar;
    Plant plant;
};

/// Moves the value out of an outcome and prints its messages, unless equal ones have been printed.
template <typename T>
ExitStatus
take_once(Outcome<T> outcome, T& value, const Console& console, std::set<std::string>& shown) {
    if (shown.insert(messages_text(outcome.messages(), console.options(), "lsc")).second) {
        console.show(outcome.messages());
    }
    if (!outcome) {
        return status_of(outcome.stop());
    }
    value = std::move(outcome.value());
    return ExitStatus::Ok;
}

/// Writes one plant per value of --variants into one file.
ExitStatus export_variants(const ExportCommand& command,
                           ExportFormat format,
                           const Project& project,
                           const Console& console) {
    const VariantValues& values = *command.variants;
    PlantVariants variants{.set = values.name, .names = values.texts, .others = {}};
    VariantPlant first;
    std::set<std::string> shown;
    ExportTiming timing;
    for (std::size_t i = 0; i < values.values.size(); ++i) {
        VariantPlant later;
        VariantPlant& grown = i == 0 ? first : later;
        grown.command = command;
        grown.command.grammar.definitions.push_back({values.name, values.values[i]});
        ExitStatus status = take_once(load_grammar(command.file, grown.command.grammar, project),
                                      grown.grammar, console, shown);
        if (status == ExitStatus::Ok) {
            grown.grammar.program.reset();
            status = take_once(grow_plant(plant_options(command), grown.grammar, project),
                               grown.plant, console, shown);
        }
        if (status != ExitStatus::Ok) {
            return status;
        }
        Export run{grown.command,
                   format,
                   grown.grammar,
                   console,
                   project,
                   grown.plant,
                   timing,
                   {},
                   {},
                   {},
                   {}};
        run.collected = &variants.others;
        status = command.gravity || command.wind ? write_bent(run)
                                                 : write_still(run, grown.plant.skeleton);
        if (status != ExitStatus::Ok) {
            return status;
        }
        timing = run.timing;
    }
    Export run{first.command,
               format,
               first.grammar,
               console,
               project,
               first.plant,
               timing,
               {},
               {},
               {},
               {}};
    run.mesh = std::move(variants.others.front());
    variants.others.erase(variants.others.begin());
    run.is_placed = true;
    run.variants = &variants;
    const ExitStatus status = write_mesh(run, first.plant.skeleton, command.output, {});
    return status == ExitStatus::Ok && command.stats ? write_stats(run, first.plant) : status;
}

/// Grows the plant of a compiled grammar in frames and writes them.
ExitStatus export_growth(const ExportCommand& command,
                         ExportFormat format,
                         Grammar& grammar,
                         const Project& project,
                         const Console& console) {
    Outcome<PlantGrowth> begun = PlantGrowth::begin(plant_options(command), grammar, project);
    console.show(begun.messages());
    if (!begun) {
        return status_of(begun.stop());
    }
    PlantGrowth& growth = begun.value();
    Export run{command, format, grammar, console, project, growth.plant(), {}, {}, {}, {}, {}};
    Skeleton grown;
    const ExitStatus status =
        traits_of(format).film ? write_film(run, growth, grown) : write_growth(run, growth, grown);
    if (status != ExitStatus::Ok || !command.stats) {
        return status;
    }
    Plant last = growth.plant();
    last.skeleton = std::move(grown);
    return write_stats(run, last);
}

} // namespace

namespace {

/// The output name corrected by exchanging two letters of its extension or replacing one; empty: none.
std::string nearest_output(const std::string& output) {
    const std::size_t dot = output.rfind('.');
    if (dot == std::string::npos || dot < folder_of_path(output).size()) {
        return {};
    }
    std::string ending = output.substr(dot + 1);
    std::string sorted = ending;
    std::sort(sorted.begin(), sorted.end());
    for (const std::string_view name :
         {"glb", "gltf", "obj", "ply", "stl", "svg", "usda", "usdz"}) {
        std::string letters(name);
        std::sort(letters.begin(), letters.end());
        if (letters == sorted) {
            return output.substr(0, dot + 1) + std::string(name);
        }
    }
    const auto nearest =
        nearest_name(ending, {"gltf", "usda", "usdz", "glb", "obj", "ply", "stl", "svg"});
    return nearest ? output.substr(0, dot + 1) + std::string(*nearest) : std::string();
}

} // namespace

ExitStatus run_command(const ExportCommand& command, const Console& console) {
    const std::optional<ExportFormat> format =
        command.format ? command.format : format_of_path(command.output);
    if (!format) {
        const std::string meant = nearest_output(command.output);
        return report_error(
            Error{fmt::format("the name `{}` does not tell a format: {}; {}", command.output,
                              format_names("or", [](const FormatTraits&) { return true; }),
                              meant.empty() ? "say which with --format"
                                            : fmt::format("did you mean `{}`?", meant))},
            console);
    }
    std::string conflict = find_surface_conflict(command.surface, *format);
    conflict = conflict.empty() ? find_conflict(command, *format) : conflict;
    if (!conflict.empty()) {
        return report_error(Error{conflict}, console);
    }
    Grammar grammar;
    Project project = make_project(console, command.run);
    if (command.variants) {
        return export_variants(command, *format, project, console);
    }
    ExitStatus status = console.take(load_grammar(command.file, command.grammar, project), grammar);
    if (status != ExitStatus::Ok) {
        return status;
    }
    grammar.program.reset(); // frees memory for the plant
    if (command.grow) {
        return export_growth(command, *format, grammar, project, console);
    }
    const bool bends = command.gravity || command.wind;
    Plant plant;
    PipelineProgress progress(console, project.host);
    Outcome<Plant> grown = grow_plant(plant_options(command), grammar, project);
    progress.clear();
    status = console.take(std::move(grown), plant);
    if (status != ExitStatus::Ok) {
        return status;
    }
    Export run{command, *format, grammar, console, project, plant, {}, {}, {}, {}, {}};
    const SteadyClock::time_point start = SteadyClock::now();
    status = bends ? write_bent(run) : write_still(run, plant.skeleton);
    if (status != ExitStatus::Ok || !command.stats) {
        return status;
    }
    if (bends) { // the remaining time is physics
        run.timing.physics_seconds =
            seconds_since(start) - run.timing.mesh_seconds - run.timing.write_seconds;
    }
    return write_stats(run, plant);
}

} // namespace lsys::lsc
