// SPDX-License-Identifier: MIT
#include "viewer/app/lsview.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/platform/memory.h"
#include "runtime/program/build_info.h"
#include "runtime/program/console.h"
#include "runtime/program/host.h"
#include "runtime/program/limited_run.h"
#include "runtime/program/process.h"
#include "runtime/program/run_files.h"
#include "viewer/app/forest_document.h"
#include "viewer/app/forest_pictures.h"
#include "viewer/app/options.h"
#include "viewer/app/pictures.h"
#include "viewer/app/plant_document.h"
#include "viewer/app/shader_folder.h"
#include "viewer/app/window_run.h"
#include "viewer/gl/headless_context.h"
#include "viewer/gl/library_versions.h"
#include "viewer/gl/renderer.h"

#include <fmt/format.h>

#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace lsys::view {

namespace {

/// A renderer without a window.
struct HiddenRenderer {
    std::unique_ptr<HeadlessContext> context; // destroyed last
    std::unique_ptr<Renderer> renderer;
};

ExitStatus make_renderer(const ViewOptions& options, const Console& console, HiddenRenderer& made) {
    Result<std::unique_ptr<HeadlessContext>> context =
        options.beside_window ? HeadlessContext::make_without_window() : HeadlessContext::make();
    if (!context) {
        return report_error(context.error(), console);
    }
    made.context = std::move(context.value());
    Result<std::unique_ptr<Renderer>> renderer =
        Renderer::make(shaders_of(options.shaders, console));
    if (!renderer) {
        return report_error(shader_error(options.shaders, renderer.error()), console);
    }
    made.renderer = std::move(renderer.value());
    made.renderer->set_culling(options.culling);
    if (const Result<void> set = made.renderer->set_quality(options.quality); !set) {
        return report_error(set.error(), console);
    }
    console.detail(fmt::format("drawing by {}: {}", made.context->description(),
                               made.renderer->device_name()));
    return ExitStatus::Ok;
}

ExitStatus run_forest_pictures(const ViewOptions& options, const Console& console) {
    std::shared_ptr<ForestDocument> made_document;
    ExitStatus status = console.take(
        make_forest_document(options, make_project(console, options.run)), made_document);
    if (status != ExitStatus::Ok) {
        return status;
    }
    ForestDocument& document = *made_document;
    const float aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    const Camera from = above_ground(with_parts(options.camera, first_view(document, aspect)),
                                     *document.grown.terrain);
    HiddenRenderer hidden_renderer;
    status = make_renderer(options, console, hidden_renderer);
    if (status != ExitStatus::Ok) {
        return status;
    }
    hidden_renderer.renderer->colour_branches(options.colours);
    // Keeps the model if it is read again later: for each picture of a growing forest, for --pick,
    // or for squares, which need its forms.
    const bool keeps_model = options.grow || options.pick || document.squares != nullptr;
    if (const Result<void> shown = hidden_renderer.renderer->show_forest(
            keeps_model ? document.model : std::move(document.model));
        !shown) {
        return report_error(shown.error(), console);
    }
    static_cast<void>(
        hidden_renderer.renderer->bake_impostors(std::numeric_limits<double>::infinity()));
    return take_forest_pictures(options, from, document, *hidden_renderer.renderer, console);
}

ExitStatus
run_plant_pictures(const ViewOptions& options, const Camera& camera, const Console& console) {
    std::shared_ptr<const PlantDocument> made_document;
    ExitStatus status = console.take(
        make_plant_document(options, make_project(console, options.run)), made_document);
    if (status != ExitStatus::Ok) {
        return status;
    }
    const PlantDocument& document = *made_document;
    HiddenRenderer hidden_renderer;
    status = make_renderer(options, console, hidden_renderer);
    if (status != ExitStatus::Ok) {
        return status;
    }
    Renderer& renderer = *hidden_renderer.renderer;
    renderer.show_plant(document.mesh);
    renderer.show_lines(make_lines(document.plant.skeleton, options.lines));
    if (document.plant.sensed != nullptr) {
        renderer.show_senses(
            make_sense_drawing(*document.plant.sensed, options.senses, {}, renderer.bounds()));
    }
    return take_pictures(options, camera, document, renderer, console);
}

std::string describe(const char* revision) {
    std::vector<LibraryVersion> libraries = viewer_libraries();
    for (LibraryVersion& library : common_libraries()) {
        libraries.push_back(std::move(library));
    }
    return describe_build(revision, libraries);
}

struct Dispatch {
    const Io& io;

    ExitStatus operator()(const PrintText& text) const {
        const Console console(io, {});
        const std::string build = text.with_build ? describe(io.revision) : std::string();
        const Result<void> written = console.write(text.text + build);
        return written ? console.finish(ExitStatus::Ok) : report_error(written.error(), console);
    }
    ExitStatus operator()(const UsageError& usage) const {
        const Console console(io, {});
        console.error(usage.message);
        console.help(usage.help);
        return ExitStatus::Failure;
    }
    ExitStatus operator()(const ViewOptions& options) const {
        if (!options.screenshot.empty()) {
            RunFiles files;
            Io recording = io;
            recording.files = &files;
            return run_within_limits(
                options.run, options.messages, recording,
                [&](const Console& console) { return run_pictures(options, console); });
        }
        const Console console(io, options.messages);
        return console.finish(run_window(options, console));
    }
};

} // namespace

ExitStatus run_pictures(const ViewOptions& options, const Console& console) {
    const Result<Camera> camera = parse_camera(options.camera, Camera{});
    if (!camera) {
        return report_error(Error{fmt::format("--camera: {}", camera.error().message)}, console);
    }
    if (const Result<Camera> last = parse_camera(options.fly_to, camera.value()); !last) {
        return report_error(Error{fmt::format("--fly-to: {}", last.error().message)}, console);
    }
    return options.is_forest ? run_forest_pictures(options, console)
                             : run_plant_pictures(options, camera.value(), console);
}

int run(std::span<const std::string> arguments, const Io& io) {
    platform::keep_freed_memory();
    return catch_out_of_memory(
        [&] { return static_cast<int>(std::visit(Dispatch{io}, parse_options(arguments))); },
        [&] { return report_out_of_memory(io); });
}

} // namespace lsys::view
