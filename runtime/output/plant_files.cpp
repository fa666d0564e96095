// SPDX-License-Identifier: MIT
#include "runtime/output/plant_files.h"

#include "grammar/base/paths.h"
#include "runtime/export/export.h"
#include "runtime/export/placed_plant.h"
#include "runtime/meshing/mesh.h"
#include "runtime/output/impl/plant_run.h"
#include "runtime/output/lod_files.h"
#include "runtime/physics/animation.h"
#include "runtime/pipeline/plant.h"
#include "runtime/pipeline/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// Adds the files that accompany the file `path`: pictures, the materials of an OBJ, the buffer of
/// a glTF. Puts their names into `info`.
ExitStatus add_side_files(PlantRun& run,
                          const Skeleton& skeleton,
                          const std::filesystem::path& path,
                          ExportInfo& info,
                          OutputSet& files) {
    // Each level of detail has pictures of its own; all frames share theirs.
    info.picture_prefix = run.options.lods != 0 ? path_text(path.stem())
                                                : path_text(path_of(run.options.output).stem());
    const bool separate = run.options.buffers == BufferPlace::Separate;
    const std::filesystem::path buffer = std::filesystem::path(path).replace_extension(".bin");
    info.buffer_name = separate ? path_text(buffer.filename()) : std::string();
    std::vector<PictureFile> pictures;
    ExitStatus status =
        run.context.console.take(make_picture_files(run.mesh, run.format, info), pictures);
    if (status != ExitStatus::Ok) {
        return status;
    }
    if (const Result<void> named = check_picture_names(pictures, info.picture_prefix); !named) {
        return report_error(named.error(), run.context.console);
    }
    for (const PictureFile& picture : pictures) {
        if (!run.pictures.insert(picture.name).second) {
            continue;
        }
        status = files.add(path_text(path.parent_path() / path_of(picture.name)),
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
    Result<std::string> name = mtl_name(library);
    if (!name) {
        return report_error(name.error(), run.context.console);
    }
    info.mtl_name = std::move(name.value());
    return files.add(path_text(library),
                     [&](const ByteSink& sink) { return write_mtl(run.mesh, info, sink); });
}

/// Plans levels of detail, once for all poses of the plant. Sets DetailChain::pictures if the
/// format and the output allow pictures.
ExitStatus plan_levels(PlantRun& run, const Skeleton& skeleton, DetailChain chain) {
    const bool is_pose = skeleton.segments.size() == run.plant.skeleton.segments.size() &&
                         skeleton.objects.size() == run.plant.skeleton.objects.size() &&
                         skeleton.polygons.size() == run.plant.skeleton.polygons.size();
    if (!run.levels.levels.empty() && is_pose) {
        return ExitStatus::Ok;
    }
    MeshOptions finest = run.options.mesh;
    finest.level = 0;
    const ExportPictures pictures = traits_of(run.format).pictures;
    chain.pictures =
        pictures == ExportPictures::Inside ||
        (pictures != ExportPictures::None && run.context.can_write_beside(run.options.output));
    return run.context.console.take(plan_plant_levels(run.plant,
                                                      is_pose ? run.plant.skeleton : skeleton,
                                                      finest, chain, run.context.project),
                                    run.levels);
}

/// Meshes `skeleton` at the level of detail of `--level`, or at the coarsest level if there are
/// fewer.
ExitStatus mesh_wanted_level(PlantRun& run, const Skeleton& skeleton, const MeshOptions& options) {
    const std::uint32_t wanted = run.options.mesh.level;
    if (wanted == 0) {
        return run.context.console.take(
            mesh_plant(run.plant, skeleton, options, run.context.project), run.mesh);
    }
    const ExitStatus status = plan_levels(run, skeleton, {.last = wanted, .first_fitted = wanted});
    if (status != ExitStatus::Ok) {
        return status;
    }
    const std::size_t number = std::min<std::size_t>(wanted, run.levels.levels.size() - 1);
    return run.context.console.take(
        mesh_plant_level(run.plant, skeleton, run.levels, number, options, run.context.project),
        run.mesh);
}

ExportInfo export_info(const PlantRun& run) {
    const PlantFileOptions& file_options = run.options;
    ExportInfo info;
    info.grammar = path_text(path_of(run.file).filename());
    // Nodes are named after the output, else after the grammar; exporters have a default name.
    const std::string& named = file_options.output == "-" ? run.file : file_options.output;
    info.name = named == "-" ? "" : path_text(path_of(named).stem());
    info.seed = run.plant.seed;
    info.generations = run.plant.generations;
    info.generator = run.context.generator;
    info.user_meshes = &run.plant.user_meshes;
    info.threads = run.context.project.threads;
    info.wind_data = file_options.wind_data;
    info.compression = file_options.compression.value_or(ExportCompression::None);
    info.up = file_options.surface.up;
    info.both_sides = file_options.surface.both_sides;
    info.unit = file_options.unit;
    info.collision = file_options.collision;
    info.collision_names = file_options.collision_names;
    return info;
}

} // namespace

PlantPlacement placement_of(const PlantRun& run, const Skeleton& skeleton) {
    if (run.is_placed) {
        return {};
    }
    const Skeleton& rest = run.plant.skeleton.segments.empty() ? skeleton : run.plant.skeleton;
    return {run.pivot.value_or(pivot_of(rest, run.options.pivot)),
            units_per_metre(run.options.unit)};
}

ExitStatus mesh_frame(PlantRun& run, const Skeleton& skeleton, bool segments) {
    const SteadyClock::time_point start = SteadyClock::now();
    MeshOptions options = run.options.mesh;
    options.segments = segments;
    run.mesh = {};
    // Frames of growth are different plants, so planned levels do not apply to them: `--level` only
    // reduces the number of sides.
    const ExitStatus status =
        run.options.grow
            ? run.context.console.take(
                  mesh_plant(run.plant, skeleton, options, run.context.project), run.mesh)
            : mesh_wanted_level(run, skeleton, options);
    run.timing.mesh_seconds += seconds_since(start);
    return status;
}

ExitStatus write_mesh(PlantRun& run,
                      const Skeleton& skeleton,
                      const std::string& path,
                      const Movement& movement) {
    const PlantFileOptions& file_options = run.options;
    const SteadyClock::time_point start = SteadyClock::now();
    ExportInfo info = export_info(run);
    info.animation = movement.animation;
    info.film = movement.film;
    info.variants = run.variants;
    constexpr std::uint32_t kDefaultJoints = 128;
    info.max_joints = file_options.bones.value_or(kDefaultJoints);
    const PlantPlacement placement = placement_of(run, skeleton);
    const bool is_identity = placement == PlantPlacement{};
    Skeleton placed;
    PlantAnimation placed_animation;
    if (!is_identity) {
        placed = skeleton;
        place(placement, run.mesh);
        place(placement, placed);
        if (movement.animation != nullptr) {
            placed_animation = *movement.animation;
            place(placement, placed_animation);
            info.animation = &placed_animation;
        }
    }
    const Skeleton& written = is_identity ? skeleton : placed;
    OutputSet files(run.context);
    ExitStatus status = ExitStatus::Ok;
    if (run.context.can_write_beside(path)) {
        status = add_side_files(run, written, path_of(path), info, files);
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

ExitStatus write_plant(PlantRun& run,
                       const Skeleton& skeleton,
                       const std::string& path,
                       const PlantAnimation* animation) {
    if (traits_of(run.format).uses_mesh) {
        const ExitStatus status =
            mesh_frame(run, skeleton, animation != nullptr || run.options.wind_data);
        if (status != ExitStatus::Ok) {
            return status;
        }
    }
    return write_mesh(run, skeleton, path, {animation, nullptr});
}

namespace {

/// Writes the levels of detail of `skeleton`: all into one file, or one file per level and a list.
ExitStatus write_lods(PlantRun& run, const Skeleton& skeleton) {
    const PlantFileOptions& file_options = run.options;
    const bool one_file = traits_of(run.format).lods && !file_options.lod_files;
    SteadyClock::time_point start = SteadyClock::now();
    ExitStatus status = plan_levels(run, skeleton, {.count = file_options.lods});
    if (status != ExitStatus::Ok) {
        return status;
    }
    const std::size_t count = run.levels.levels.size();
    if (count < file_options.lods) {
        run.context.console.info(
            fmt::format("the plant has {} {} of detail", count, count == 1 ? "level" : "levels"));
    }
    MeshOptions options = file_options.mesh;
    options.segments = file_options.wind_data;
    std::vector<CoarserMesh> meshes(count);
    for (std::size_t i = 0; i < count && status == ExitStatus::Ok; ++i) {
        status = run.context.console.take(
            mesh_plant_level(run.plant, skeleton, run.levels, i, options, run.context.project),
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
    OutputSet files(run.context);
    if (one_file) {
        meshes.erase(meshes.begin());
        ExportInfo info = origin;
        info.coarser = &meshes;
        if (run.context.can_write_beside(file_options.output)) {
            status = add_side_files(run, placed, path_of(file_options.output), info, files);
        }
        if (status != ExitStatus::Ok) {
            return status;
        }
        status = files.add(file_options.output, [&](const ByteSink& sink) {
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
            const std::string path = lod_path(file_options.output, i);
            ExportInfo info = origin;
            info.collision = i == 0 ? origin.collision : CollisionKind::None;
            status = add_side_files(run, placed, path_of(path), info, files);
            if (status == ExitStatus::Ok) {
                status = files.add(path, [&](const ByteSink& sink) {
                    return export_mesh(run.mesh, placed, run.format, info, sink);
                });
            }
            list.push_back({.name = path_text(path_of(path).filename()),
                            .triangles = run.mesh.indices.size() / 3,
                            .pixels = run.levels.levels[i].pixels,
                            .coverage = meshes[i].coverage});
        }
        if (count > 1) {
            run.mesh = std::move(finest);
        }
        if (status == ExitStatus::Ok) {
            status = files.add_text(lods_json_path(file_options.output),
                                    lods_json(origin, extent, list));
        }
    }
    if (status == ExitStatus::Ok) {
        status = files.commit();
    }
    run.timing.bytes += files.byte_count();
    run.timing.write_seconds += seconds_since(start);
    return status;
}

} // namespace

ExitStatus write_still(PlantRun& run, const Skeleton& skeleton) {
    if (run.collected != nullptr) {
        const ExitStatus status = mesh_frame(run, skeleton, false);
        if (status == ExitStatus::Ok) {
            place(placement_of(run, skeleton), run.mesh);
            run.collected->push_back(std::move(run.mesh));
        }
        return status;
    }
    return run.options.lods != 0 ? write_lods(run, skeleton)
                                 : write_plant(run, skeleton, run.options.output, nullptr);
}

ExitStatus write_plant_files(const PlantFileOptions& options,
                             ExportFormat format,
                             const PlantSource& source,
                             const Plant& plant,
                             const OutputContext& context,
                             PlantFileReport& report) {
    PlantRun run{options, format, source.file, source.grammar, context, plant};
    const SteadyClock::time_point start = SteadyClock::now();
    const bool bends = options.gravity || options.wind;
    const ExitStatus status = bends ? write_bent(run) : write_still(run, plant.skeleton);
    report.timing = run.timing;
    if (bends) { // the remaining time is physics
        report.timing.physics_seconds =
            seconds_since(start) - run.timing.mesh_seconds - run.timing.write_seconds;
    }
    report.mesh = std::move(run.mesh);
    return status;
}

ExitStatus write_variant_files(const PlantFileOptions& options,
                               ExportFormat format,
                               const std::string& file,
                               const VariantValues& values,
                               const GrowVariant& grow,
                               const OutputContext& context,
                               PlantFileReport& report,
                               Plant& first) {
    PlantVariants variants{.set = values.name, .names = values.texts, .others = {}};
    Grammar first_grammar;
    for (std::size_t i = 0; i < values.values.size(); ++i) {
        Grammar later_grammar;
        Plant later;
        Grammar& grammar = i == 0 ? first_grammar : later_grammar;
        Plant& plant = i == 0 ? first : later;
        ExitStatus status = grow(i, grammar, plant);
        if (status != ExitStatus::Ok) {
            return status;
        }
        PlantRun run{options, format, file, grammar, context, plant, report.timing};
        run.collected = &variants.others;
        status =
            options.gravity || options.wind ? write_bent(run) : write_still(run, plant.skeleton);
        if (status != ExitStatus::Ok) {
            return status;
        }
        report.timing = run.timing;
    }
    PlantRun run{options, format, file, first_grammar, context, first, report.timing};
    run.mesh = std::move(variants.others.front());
    variants.others.erase(variants.others.begin());
    run.is_placed = true;
    run.variants = &variants;
    const ExitStatus status = write_mesh(run, first.skeleton, options.output, {});
    report.timing = run.timing;
    report.mesh = std::move(run.mesh);
    return status;
}

} // namespace lsys
