// SPDX-License-Identifier: MIT
#include "runtime/output/forest_files.h"

#include "grammar/base/paths.h"
#include "runtime/export/export_forest.h"
#include "runtime/export/placed_plant.h"
#include "runtime/pipeline/forest_growth.h"
#include "runtime/pipeline/forest_lods.h"
#include "runtime/placement/domination.h"
#include "runtime/program/files.h"
#include "runtime/scene/painting.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint32_t kGroundCells = 128; // cells of the ground mesh per side

/// Adds pictures as files in the folder of `path`.
ExitStatus add_pictures(const std::vector<PictureFile>& pictures,
                        const std::string& path,
                        const ForestOutput& run,
                        OutputSet& outputs) {
    const std::string prefix = path_text(path_of(run.options.output).stem());
    if (const Result<void> named = check_picture_names(pictures, prefix); !named) {
        return report_error(named.error(), run.context.console);
    }
    for (const PictureFile& picture : pictures) {
        const std::string beside = path_text(path_of(path).parent_path() / path_of(picture.name));
        const ExitStatus added = outputs.add(
            beside, [&](const ByteSink& sink) { return write_picture_file(picture, sink); });
        if (added != ExitStatus::Ok) {
            return added;
        }
    }
    return ExitStatus::Ok;
}

/// The point of the scene that becomes the origin of the file.
glm::vec3 pivot_of(const ForestOutput& run, const GrownForest& grown) {
    if (run.options.pivot == ForestPivot::Origin) {
        return glm::vec3(0.0F);
    }
    const Region& region = run.scene.placement.region;
    const auto x = static_cast<float>(region.x + 0.5 * region.width);
    const auto z = static_cast<float>(region.z + 0.5 * region.depth);
    return {x, grown.terrain->height(x, z), z};
}

ExitStatus write_instances(const ForestOutput& run,
                           const GrownForest& grown,
                           const ForestScene& scene,
                           const std::string& path) {
    ForestExportInfo info;
    info.name = path_text(path_of(path).stem());
    info.generator = run.context.generator;
    constexpr float kCell = 100.0F;
    const bool whole_trees = run.options.instance_kind != ForestInstances::Branches;
    info.cell = run.options.cell.value_or(whole_trees ? 0.0F : kCell);
    info.up = run.options.surface.up;
    info.unit = run.options.unit;
    info.pivot = pivot_of(run, grown);
    info.collision = run.options.collision;
    info.collision_names = run.options.collision_names;
    info.threads = run.context.project.threads;
    info.compression = run.options.compression.value_or(ExportCompression::None);
    info.picture_prefix = path_text(path_of(run.options.output).stem());
    OutputSet outputs(run.context); // pictures are added before the file that names them
    if (traits_of(run.target.format).pictures != ExportPictures::Inside) {
        info.textures = path != "-";
        std::vector<PictureFile> pictures;
        const ExitStatus status = run.context.console.take(
            make_forest_picture_files(scene, run.target.format, info), pictures);
        if (status != ExitStatus::Ok) {
            return status;
        }
        if (const ExitStatus added = add_pictures(pictures, path, run, outputs);
            added != ExitStatus::Ok) {
            return added;
        }
    }
    const ForestForm form = run.options.expand ? ForestForm::Expanded : ForestForm::Instanced;
    const auto put = [&](const ByteSink& sink) {
        return export_forest(scene, run.target.format, form, info, sink);
    };
    const ExitStatus status = outputs.add(path, put);
    return status == ExitStatus::Ok ? outputs.commit() : status;
}

ExitStatus write_baked(const ForestOutput& run,
                       const GrownForest& grown,
                       const ForestScene& scene,
                       const std::string& path) {
    const Project& project = run.context.project;
    Mesh mesh;
    ExitStatus status = run.context.console.take(
        bake_forest(scene, project.limits.max_bytes, project.threads), mesh);
    if (status != ExitStatus::Ok) {
        return status;
    }
    place(PlantPlacement{pivot_of(run, grown), units_per_metre(run.options.unit)}, mesh);
    ExportInfo info;
    info.subject = ExportSubject::Forest;
    info.unit = run.options.unit;
    info.grammar = path_text(path_of(path).stem());
    info.seed = grown.forest.key;
    info.generator = run.context.generator;
    info.threads = project.threads;
    info.compression = run.options.compression.value_or(ExportCompression::None);
    info.up = run.options.surface.up;
    info.both_sides = run.options.surface.both_sides;
    const FormatTraits& format = traits_of(run.target.format);
    OutputSet outputs(run.context); // side files are added before the mesh that names them
    if (path == "-") {
        info.textures = format.pictures == ExportPictures::Inside;
    } else {
        info.picture_prefix = path_text(path_of(run.options.output).stem());
        std::vector<PictureFile> pictures;
        status =
            run.context.console.take(make_picture_files(mesh, run.target.format, info), pictures);
        if (status == ExitStatus::Ok) {
            status = add_pictures(pictures, path, run, outputs);
        }
        if (status == ExitStatus::Ok && format.has_mtl) {
            const std::filesystem::path library = path_of(path).replace_extension(".mtl");
            Result<std::string> name = mtl_name(library);
            if (!name) {
                return report_error(name.error(), run.context.console);
            }
            info.mtl_name = std::move(name.value());
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
ExitStatus write_lods(const ForestOutput& run, const GrownForest& grown, const std::string& path) {
    ForestLods lods;
    const ExitStatus status = run.context.console.take(
        make_forest_lods(grown, run.options.mesh, run.options.viewpoint, run.context.project),
        lods);
    if (status != ExitStatus::Ok) {
        return status;
    }
    run.context.console.detail(fmt::format("levels of detail as seen from {:.4g},{:.4g},{:.4g}",
                                           lods.viewpoint.x, lods.viewpoint.y, lods.viewpoint.z));
    const ForestScene scene{lods.forest, lods.meshes, run.ground};
    return run.target.kind == ForestOutputKind::Mesh ? write_baked(run, grown, scene, path)
                                                     : write_instances(run, grown, scene, path);
}

ExitStatus write_at(const ForestOutput& run, const GrownForest& grown, const std::string& path) {
    if (run.options.instance_kind == ForestInstances::Lods &&
        run.target.kind != ForestOutputKind::None) {
        return write_lods(run, grown, path);
    }
    const ForestScene scene{grown.forest, run.meshes, run.ground};
    switch (run.target.kind) {
    case ForestOutputKind::None:
        return ExitStatus::Ok;
    case ForestOutputKind::Instances:
        return write_instances(run, grown, scene, path);
    case ForestOutputKind::Mesh:
        return write_baked(run, grown, scene, path);
    case ForestOutputKind::Statistics:
        break;
    }
    OutputSet outputs(run.context);
    const std::string text = forest_stats_json(scene, {true, run.context.project.threads}) + "\n";
    const ExitStatus status = outputs.add_text(path, text);
    return status == ExitStatus::Ok ? outputs.commit() : status;
}

/// Writes `frames` files of a forest whose trees have stages, from their first stage to the last.
ExitStatus write_stages(const ForestOutput& run, GrownForest& grown) {
    Outcome<ForestGrowth> begun = ForestGrowth::begin(run.scene, grown, run.context.project);
    if (!begun) {
        run.context.console.show(begun.messages());
        return status_of(begun.stop());
    }
    ForestGrowth growth = std::move(begun.value());
    for (std::uint32_t frame = 0; frame < run.options.frames; ++frame) {
        // Round down to a whole stage, because a file has no trees between two stages.
        const GrowthMoment moment{
            moment_of_frame(frame, run.options.frames, growth.last_year()).generation, 0.0};
        const TreeHeight no_height = [](const Tree& /*tree*/) { return 0.0F; };
        ExitStatus status = run.context.console.take(
            growth.trees(moment, no_height, run.context.project, grown.forest.trees));
        const std::string path = numbered_path(run.options.output, frame + 1);
        status = status == ExitStatus::Ok ? write_at(run, grown, path) : status;
        if (status != ExitStatus::Ok) {
            report_complete_frames(run.options.output, frame, run.options.frames,
                                   run.context.console);
            return status;
        }
        run.context.console.detail(fmt::format("{}: {} of {} stages after the start, {} plants",
                                               path, moment.generation, growth.last_year(),
                                               grown.forest.trees.size()));
    }
    return ExitStatus::Ok;
}

/// Lets the trees compete up to `year` and writes the forest of that year to `path`.
ExitStatus write_year(const ForestOutput& run,
                      std::uint32_t year,
                      const std::string& path,
                      Domination& domination,
                      GrownForest& grown) {
    while (domination.year() < year) {
        if (run.context.console.interrupted()) {
            return ExitStatus::Interrupted;
        }
        if (const Result<void> done = domination.step(); !done) {
            return report_error(
                Error{fmt::format("year {}: {}", domination.year() + 1, done.error().message)},
                run.context.console);
        }
    }
    grown.forest.trees = domination.trees();
    if (const ExitStatus sized =
            run.context.console.take(size_forest(run.scene, run.context.project, grown));
        sized != ExitStatus::Ok) {
        return sized;
    }
    apply_painting(run.scene.painting, run.scene.placement.region, *grown.terrain,
                   grown.forest.trees);
    if (const ExitStatus sensed =
            run.context.console.take(sense_forest(run.scene, run.context.project, grown));
        sensed != ExitStatus::Ok) {
        return sensed;
    }
    return write_at(run, grown, path);
}

/// Writes the forest at `frames` evenly spaced years, the last of which is the last year.
ExitStatus write_years(const ForestOutput& run, GrownForest& grown) {
    PlacementOptions options = run.scene.placement;
    options.threads = run.context.project.threads;
    Result<Domination> begun = Domination::begin(options, *grown.terrain);
    if (!begun) {
        return report_error(Error{fmt::format("placement: {}", begun.error().message)},
                            run.context.console);
    }
    for (std::uint32_t frame = 1; frame <= run.options.frames; ++frame) {
        const auto year =
            static_cast<std::uint32_t>(std::uint64_t{options.years} * frame / run.options.frames);
        const std::string path = numbered_path(run.options.output, frame);
        const ExitStatus status = write_year(run, year, path, begun.value(), grown);
        if (status != ExitStatus::Ok) {
            report_complete_frames(run.options.output, frame - 1, run.options.frames,
                                   run.context.console);
            return status;
        }
        run.context.console.detail(
            fmt::format("{}: year {}, {} plants", path, year, grown.forest.trees.size()));
    }
    return ExitStatus::Ok;
}

} // namespace

ExitStatus make_ground(const ForestTarget& target,
                       const GrownForest& grown,
                       const OutputContext& context,
                       std::optional<Mesh>& result) {
    TerrainMeshOptions ground;
    ground.columns = kGroundCells;
    ground.rows = kGroundCells;
    ground.threads = context.project.threads;
    ground.pictures = grown.ground;
    // A baked mesh has tangents only if all its parts have tangents.
    ground.tangents = grown.ground.normals != nullptr || target.kind == ForestOutputKind::Mesh;
    Result<Mesh> ground_mesh = make_terrain_mesh(*grown.terrain, ground);
    if (!ground_mesh) {
        return report_error(ground_mesh.error(), context.console);
    }
    result = std::move(ground_mesh.value());
    return ExitStatus::Ok;
}

ExitStatus write_forest(const ForestOutput& output, const GrownForest& grown) {
    return write_at(output, grown, output.options.output);
}

ExitStatus write_forest_frames(const ForestOutput& output, GrownForest& grown) {
    return output.scene.placement.method == PlacementMethod::Domination
               ? write_years(output, grown)
               : write_stages(output, grown);
}

} // namespace lsys
