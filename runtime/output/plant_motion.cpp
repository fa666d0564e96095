// SPDX-License-Identifier: MIT
#include "grammar/base/counted_text.h"
#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/meshing/mesh_film.h"
#include "runtime/output/impl/plant_run.h"
#include "runtime/physics/animation.h"
#include "runtime/physics/physics.h"
#include "runtime/pipeline/plant_growth.h"
#include "runtime/program/files.h"
#include "runtime/program/weight_report.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace lsys {

ExitStatus check_animation(const PlantRun& run, std::uint64_t bytes) {
    const std::uint64_t limit = run.context.project.limits.max_bytes;
    if (bytes <= limit) {
        return ExitStatus::Ok;
    }
    Diagnostics diagnostics;
    diagnostics.add(plant_limit_diagnostic(
        "the animation", byte_size_text(limit),
        "ask for fewer frames with `--frames`, for fewer generations with `-n`, or raise the limit "
        "with `--max-memory`"));
    static_cast<void>(run.context.console.show(diagnostics, *run.grammar.sources));
    return ExitStatus::Limit;
}

namespace {

/// Writes the motion as a loop, to one file or to numbered files.
ExitStatus write_loop(PlantRun& run, PlantPhysics& physics) {
    const PlantFileOptions& file_options = run.options;
    const std::uint64_t segments = run.plant.skeleton.segments.size();
    if (const ExitStatus fits = check_animation(run, loop_bytes(segments, file_options.frames));
        fits != ExitStatus::Ok) {
        return fits;
    }
    const PlantLoop loop =
        record_loop(physics, file_options.frames, file_options.frames_per_second);
    run.context.console.detail(
        fmt::format("the last frame of the loop differs from the first by {:.3g} % of the plant's "
                    "size before blending, after a run-in of {}",
                    100.0 * loop.mismatch, counted(loop.run_in, "loop")));
    Skeleton pose;
    pose_at(physics.rest(), loop.animation.frame(0), pose);
    if (traits_of(run.format).motion) {
        return write_plant(run, pose, file_options.output, &loop.animation);
    }
    for (std::uint32_t frame = 1; frame <= file_options.frames; ++frame) {
        pose_at(physics.rest(), loop.animation.frame(frame - 1), pose);
        const ExitStatus status =
            write_plant(run, pose, numbered_path(file_options.output, frame), nullptr);
        if (status != ExitStatus::Ok) {
            report_complete_frames(file_options.output, frame - 1, file_options.frames,
                                   run.context.console);
            return status;
        }
    }
    return ExitStatus::Ok;
}

/// Writes all frames of the motion to one file.
ExitStatus write_animation(PlantRun& run, PlantPhysics& physics) {
    const PlantFileOptions& file_options = run.options;
    const std::uint64_t segments = run.plant.skeleton.segments.size();
    if (const ExitStatus fits =
            check_animation(run, animation_bytes(segments, file_options.frames));
        fits != ExitStatus::Ok) {
        return fits;
    }
    Skeleton first;
    physics.pose(first);
    const PlantAnimation animation =
        record(physics, file_options.frames, file_options.frames_per_second);
    return write_plant(run, first, file_options.output, &animation);
}

/// Warns if the plant falls under its own weight, without wind. Large plants are not checked,
/// because the check settles the plant many times.
ExitStatus check_weight(const PlantRun& run, const PhysicsOptions& options) {
    Diagnostics warning =
        make_fall_warning(run.plant.skeleton, run.grammar.bytecode.settings, options);
    return warning.all().empty() ? ExitStatus::Ok
                                 : run.context.console.show(warning, *run.grammar.sources);
}

} // namespace

ExitStatus write_bent(PlantRun& run) {
    const PlantFileOptions& file_options = run.options;
    constexpr double kRestAngle = 1e-6; // radians
    constexpr float kStepsPerSecond = 60.0F;
    PhysicsOptions options;
    options.gravity = file_options.gravity.value_or(0.0F);
    options.wind = file_options.wind.value_or(Wind{});
    options.damping = run.grammar.bytecode.settings.damping;
    options.load = run.grammar.bytecode.settings.load;
    options.threads = run.context.project.threads;
    // Use a whole number of simulation steps per frame.
    const auto steps = static_cast<std::uint32_t>(
        std::max(1.0F, std::ceil(kStepsPerSecond / file_options.frames_per_second)));
    options.time_step = 1.0F / (file_options.frames_per_second * static_cast<float>(steps));
    if (const ExitStatus weight = check_weight(run, options); weight != ExitStatus::Ok) {
        return weight;
    }
    PlantPhysics physics(run.plant.skeleton, options);
    if (file_options.loop) {
        return write_loop(run, physics);
    }
    const std::size_t segments = run.plant.skeleton.segments.size();
    const std::uint32_t rounds = settle_rounds(segments);
    if ((file_options.settle || file_options.frames == 0) && !physics.settle(kRestAngle, rounds)) {
        run.context.console.info(
            fmt::format("the plant has not quite come to rest in {} rounds, the limit "
                        "for {} segments",
                        rounds, segments));
    }
    Skeleton bent;
    if (file_options.frames == 0) {
        physics.pose(bent);
        return write_still(run, bent);
    }
    if (traits_of(run.format).motion) {
        return write_animation(run, physics);
    }
    for (std::uint32_t frame = 1; frame <= file_options.frames; ++frame) {
        physics.pose(bent);
        const ExitStatus status =
            write_plant(run, bent, numbered_path(file_options.output, frame), nullptr);
        if (status != ExitStatus::Ok) {
            report_complete_frames(file_options.output, frame - 1, file_options.frames,
                                   run.context.console);
            return status;
        }
        for (std::uint32_t step = 0; step < steps; ++step) {
            physics.step();
        }
    }
    return ExitStatus::Ok;
}

namespace {

bool is_empty(const Skeleton& skeleton) {
    return skeleton.segments.empty() && skeleton.objects.empty() && skeleton.polygons.empty();
}

/// Sets `generation` to the first generation that draws something, or to 0 if none does.
ExitStatus find_first_drawn(const PlantRun& run, PlantGrowth& growth, std::uint32_t& generation) {
    Skeleton drawn;
    for (generation = 0; generation <= growth.last_generation(); ++generation) {
        const ExitStatus status = run.context.console.interrupted()
                                      ? ExitStatus::Interrupted
                                      : run.context.console.take(growth.pose(
                                            {generation, 0.0}, run.context.project, drawn));
        if (status != ExitStatus::Ok || !is_empty(drawn)) {
            return status;
        }
    }
    generation = 0;
    return ExitStatus::Ok;
}

/// Sets `grown` to the skeleton of a moment.
ExitStatus
pose_growth(const PlantRun& run, PlantGrowth& growth, const GrowthMoment& moment, Skeleton& grown) {
    return run.context.console.interrupted()
               ? ExitStatus::Interrupted
               : run.context.console.take(growth.pose(moment, run.context.project, grown));
}

/// Sets the pivot of all frames to the pivot of the plant of the last generation. Derives nothing
/// if the pivot is the origin.
ExitStatus find_growth_pivot(PlantRun& run, PlantGrowth& growth) {
    if (run.options.pivot == PlantPivot::Origin) {
        return ExitStatus::Ok;
    }
    Skeleton last;
    const Outcome<void> posed =
        growth.pose({growth.last_generation(), 0.0}, run.context.project, last);
    if (!posed) {
        run.context.console.show(posed.messages());
        return status_of(posed.stop());
    }
    run.pivot = pivot_of(last, run.options.pivot); // writing the last frame prints the messages
    return ExitStatus::Ok;
}

/// Writes the growth of the plant to its last generation, one numbered file per frame. The
/// first generations have no files if they draw nothing. `grown` becomes the skeleton of the last
/// frame.
ExitStatus write_growth(PlantRun& run, PlantGrowth& growth, Skeleton& grown) {
    const PlantFileOptions& file_options = run.options;
    std::uint32_t first = 0;
    if (const ExitStatus status = find_first_drawn(run, growth, first); status != ExitStatus::Ok) {
        return status;
    }
    // Growth starts one generation before the first that draws. The start has no file, since it is
    // empty: the first frame is one step later.
    const std::uint32_t start = first == 0 ? 0 : first - 1;
    const std::uint32_t skipped = first == 0 ? 0 : 1;
    if (first > 0) {
        run.context.console.info(fmt::format(
            "nothing is drawn before generation {}; the frames start after generation {}", first,
            start));
    }
    if (const ExitStatus status = find_growth_pivot(run, growth); status != ExitStatus::Ok) {
        return status;
    }
    for (std::uint32_t frame = 0; frame < file_options.frames; ++frame) {
        GrowthMoment moment = moment_of_frame(frame + skipped, file_options.frames + skipped,
                                              growth.last_generation() - start);
        moment.generation += start;
        ExitStatus status = pose_growth(run, growth, moment, grown);
        if (status == ExitStatus::Ok) {
            status =
                write_plant(run, grown, numbered_path(file_options.output, frame + 1), nullptr);
        }
        if (status != ExitStatus::Ok) {
            report_complete_frames(file_options.output, frame, file_options.frames,
                                   run.context.console);
            return status;
        }
    }
    return ExitStatus::Ok;
}

/// Writes the growth of the plant from its axiom to its last generation to one file. `grown`
/// becomes the skeleton of the last frame.
ExitStatus write_film(PlantRun& run, PlantGrowth& growth, Skeleton& grown) {
    const PlantFileOptions& file_options = run.options;
    MeshFilmBuilder builder(file_options.frames_per_second);
    for (std::uint32_t frame = 0; frame < file_options.frames; ++frame) {
        ExitStatus status = pose_growth(
            run, growth, moment_of_frame(frame, file_options.frames, growth.last_generation()),
            grown);
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
    return write_mesh(run, grown, file_options.output, {nullptr, &film});
}

} // namespace

ExitStatus write_growth_files(const PlantFileOptions& options,
                              ExportFormat format,
                              const PlantOptions& plant,
                              Grammar& grammar,
                              const OutputContext& context,
                              PlantFileReport& report,
                              Plant& last) {
    Outcome<PlantGrowth> begun = PlantGrowth::begin(plant, grammar, context.project);
    context.console.show(begun.messages());
    if (!begun) {
        return status_of(begun.stop());
    }
    PlantGrowth& growth = begun.value();
    PlantRun run{options, format, plant.file, grammar, context, growth.plant()};
    Skeleton grown;
    const ExitStatus status =
        traits_of(format).film ? write_film(run, growth, grown) : write_growth(run, growth, grown);
    report.timing = run.timing;
    report.mesh = std::move(run.mesh);
    last = growth.plant();
    last.skeleton = std::move(grown);
    return status;
}

} // namespace lsys
