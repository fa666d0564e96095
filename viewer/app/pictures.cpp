// SPDX-License-Identifier: MIT
#include "viewer/app/pictures.h"

#include "runtime/physics/physics.h"
#include "runtime/pipeline/plant_growth.h"
#include "runtime/pipeline/step.h"
#include "runtime/program/host.h"
#include "runtime/program/weight_report.h"
#include "viewer/app/picking.h"
#include "viewer/app/picture_series.h"
#include "viewer/scene/figure.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace lsys::view {

namespace {

constexpr double kStepsPerSecond = 60.0; // min number of physics steps per second

PhysicsOptions forces_of(const ViewOptions& options, const PlantDocument& document) {
    PhysicsOptions forces;
    forces.gravity = options.gravity.value_or(0.0F);
    forces.wind = options.wind.value_or(Wind{});
    forces.damping = document.grammar.bytecode.settings.damping;
    forces.load = document.grammar.bytecode.settings.load;
    forces.threads = options.run.threads;
    return forces;
}

/// Warns if the plant falls under its weight, as `lsc` does.
ExitStatus
check_weight(const ViewOptions& options, const PlantDocument& document, const Console& console) {
    Diagnostics warning = make_fall_warning(
        document.plant.skeleton, document.grammar.bytecode.settings, forces_of(options, document));
    return warning.all().empty() ? ExitStatus::Ok
                                 : console.show(warning, *document.grammar.sources);
}

/// Moves a plant by physics during a series of pictures.
class Motion {
public:
    Motion(const ViewOptions& options, const PlantDocument& document)
        : seconds_of_frame_(1.0 / static_cast<double>(options.frames_per_second)) {
        if (!options.gravity && !options.wind) {
            return;
        }
        PhysicsOptions forces = forces_of(options, document);
        // A frame takes a whole number of physics steps.
        const double steps = std::max(1.0, std::ceil(kStepsPerSecond * seconds_of_frame_));
        forces.time_step = static_cast<float>(seconds_of_frame_ / steps);
        physics_ = std::make_unique<PlantPhysics>(document.plant.skeleton, forces);
        constexpr double kRadians = 1e-6; // tolerance of settle()
        static_cast<void>(
            physics_->settle(kRadians, settle_rounds(document.plant.skeleton.segments.size())));
        go_to(static_cast<double>(options.time));
    }

    [[nodiscard]] bool moves() const { return physics_ != nullptr; }
    /// Steps the physics until the time `seconds` (s); does nothing without physics.
    void go_to(double seconds) {
        while (physics_ != nullptr &&
               physics_->time() + 0.5 * static_cast<double>(physics_->options().time_step) <
                   seconds) {
            physics_->step();
        }
    }
    void pose(Skeleton& skeleton) const { physics_->pose(skeleton); }

private:
    double seconds_of_frame_;
    std::unique_ptr<PlantPhysics> physics_;
};

std::string stats_text(const ViewOptions& options,
                       const Camera& camera,
                       const PlantDocument& document,
                       const Renderer& renderer,
                       const PictureSeries& series) {
    nlohmann::ordered_json stats;
    stats["file"] = options.file;
    stats["device"] = renderer.device_name();
    stats["width"] = options.width;
    stats["height"] = options.height;
    stats["camera"] = to_text(camera);
    stats["modules"] = document.plant.modules;
    stats["segments"] = document.plant.skeleton.segments.size();
    stats["vertices"] = document.mesh.positions.size();
    stats["mesh_triangles"] = document.mesh.indices.size() / 3;
    stats["pictures"] = series.draw.size();
    stats["draws"] = series.drawn.draws;
    stats["triangles"] = series.drawn.triangles;
    stats["uploaded_bytes"] = renderer.uploaded_bytes();
    stats["live_objects"] = renderer.live_objects();
    stats["errors"] = renderer.errors();
    stats["digest"] = fmt::format("{:016x}", series.digest);
    nlohmann::ordered_json& milliseconds = stats["milliseconds"];
    milliseconds["compile"] = 1e3 * document.load_seconds;
    milliseconds["derive"] = 1e3 * document.plant.derive_seconds;
    milliseconds["turtle"] = 1e3 * document.plant.draw_seconds;
    milliseconds["mesh"] = 1e3 * document.mesh_seconds;
    milliseconds["bend"] = median(series.prepare);
    milliseconds["draw"] = median(series.draw);
    milliseconds["write"] = median(series.write);
    return stats.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// Shows the messages of a growth step, except messages about the grammar and its last generation,
/// which were shown when the document was made.
ExitStatus show_step_messages(const Outcome<void>& outcome, const Console& console) {
    if (!outcome) {
        return console.take(outcome);
    }
    for (const Message& message : outcome.messages().all()) {
        if (message.kind == Message::Kind::Info) {
            console.info(message.text);
        }
    }
    return ExitStatus::Ok;
}

/// Begins `growth`. Copies to `grammar` the parts of the document's grammar that the growth needs;
/// `grammar` must outlive `growth`.
ExitStatus begin_growth(const ViewOptions& options,
                        const PlantDocument& document,
                        Grammar& grammar,
                        const Project& project,
                        const Console& console,
                        std::optional<PlantGrowth>& growth) {
    grammar.sources = document.grammar.sources;
    grammar.bytecode = document.grammar.bytecode;
    grammar.is_module_file = document.grammar.is_module_file;
    PlantOptions plant;
    plant.file = options.file;
    plant.generations = document.plant.generations;
    plant.seed = document.plant.seed;
    Outcome<PlantGrowth> begun = PlantGrowth::begin(plant, grammar, project);
    if (!begun) {
        console.show(begun.messages());
        return status_of(begun.stop());
    }
    growth.emplace(std::move(begun.value()));
    return ExitStatus::Ok;
}

/// Like describe(), with the trace of --why as a further line.
Outcome<Description> describe_with_trace(const PickedTriangle& picked,
                                         const PlantDocument& document,
                                         const ViewOptions& options,
                                         const Project& project) {
    Step step(project);
    Description description;
    if (!step.take(describe(picked, document, options, project), description)) {
        return step.end();
    }
    if (options.why && description.module) {
        const bool colour = options.messages.colour == ColourMode::Always;
        std::string text;
        if (!step.take(
                trace_picked(*description.module, *options.why, colour, document, options, project),
                text)) {
            return step.end();
        }
        text.pop_back(); // removes the line end at the end of the text
        description.lines.push_back("\n" + text);
    }
    return step.done(std::move(description));
}

} // namespace

ExitStatus take_pictures(const ViewOptions& options,
                         const Camera& camera,
                         const PlantDocument& document,
                         Renderer& renderer,
                         const Console& console) {
    if (const ExitStatus status = check_weight(options, document, console);
        status != ExitStatus::Ok) {
        return status;
    }
    Motion motion(options, document);
    Skeleton pose;
    Mesh mesh;
    const Project project = make_project(console, options.run);
    std::function<ExitStatus(Frame&)> prepare;
    Grammar grammar;
    std::optional<PlantGrowth> growth;
    std::uint32_t frame_number = 0;
    if (options.grow) {
        const ExitStatus begun = begin_growth(options, document, grammar, project, console, growth);
        if (begun != ExitStatus::Ok) {
            return begun;
        }
        prepare = [&](const Frame& /*frame*/) {
            const GrowthMoment moment =
                moment_of_frame(frame_number++, options.frames, growth->last_generation());
            ExitStatus status = show_step_messages(growth->pose(moment, project, pose), console);
            if (status == ExitStatus::Ok) {
                status =
                    console.take(mesh_plant(document.plant, pose, options.mesh, project), mesh);
            }
            if (status == ExitStatus::Ok) {
                renderer.show_plant(mesh);
                renderer.show_lines(make_lines(pose, options.lines));
                const std::shared_ptr<const SensedPlant> sensed = growth->sensed();
                renderer.show_senses(sensed == nullptr ? SenseDrawing{}
                                                       : make_sense_drawing(*sensed, options.senses,
                                                                            {}, renderer.bounds()));
            }
            return status;
        };
    }
    const auto show_bent = [&] {
        motion.pose(pose);
        const ExitStatus status =
            console.take(mesh_plant(document.plant, pose, options.mesh, project), mesh);
        if (status == ExitStatus::Ok) {
            renderer.show_plant(mesh);
            renderer.show_lines(make_lines(pose, options.lines));
        }
        return status;
    };
    if (const ExitStatus status = motion.moves() ? show_bent() : ExitStatus::Ok;
        status != ExitStatus::Ok) {
        return status;
    }
    const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    const Bounds seen = options.figure ? with_figure(renderer.bounds()) : renderer.bounds();
    const Camera from = with_parts(options.camera, first_view(camera, seen, aspect));
    if (motion.moves()) {
        prepare = [&](const Frame& frame) {
            motion.go_to(frame.time);
            return show_bent();
        };
    }
    PictureSeries series;
    std::uint32_t pictures = 0;
    std::function<ExitStatus(const Frame&)> after;
    if (options.pick) {
        after = [&](const Frame& frame) {
            return write_picked(
                options, frame, ++pictures, renderer, console, [&](const Picked& picked) {
                    PickedTriangle triangle;
                    triangle.triangle = picked.triangle;
                    triangle.place = picked.place;
                    triangle.pose = prepare ? &pose : &document.plant.skeleton;
                    triangle.mesh = options.mesh;
                    if (growth) {
                        triangle.moment = moment_of_frame(pictures - 1, options.frames,
                                                          growth->last_generation());
                    }
                    return describe_with_trace(triangle, document, options, project);
                });
        };
    }
    Frame frame = frame_of(options, from);
    if (options.figure) {
        frame.figure = figure_beside(renderer.bounds());
    }
    if (options.grow && !renderer.bounds().empty) {
        // The disc under the plant of the last generation is used in all pictures.
        frame.ground_disc = ground_disc_of(renderer.bounds());
    }
    const ExitStatus status =
        take_series(options, frame, renderer, console, prepare, after, series);
    return status != ExitStatus::Ok || options.stats.empty()
               ? status
               : write_stats_text(options, stats_text(options, from, document, renderer, series),
                                  console);
}

} // namespace lsys::view
