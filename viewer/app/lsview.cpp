#include "viewer/app/lsview.h"

#include "runtime/cli/console.h"
#include "runtime/cli/files.h"
#include "runtime/cli/tell.h"
#include "viewer/app/options.h"
#include "viewer/app/pictures.h"
#include "viewer/app/plant_document.h"
#include "viewer/gl/headless.h"
#include "viewer/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <new>
#include <ostream>
#include <stdexcept>
#include <utility>
#include <variant>

namespace lsys::view {

namespace {

using lsc::Console;
using lsc::Status;

/// The shaders of a folder, or those that are built in.
ShaderSource shaders_of(const std::string& folder, const Console& console) {
    if (folder.empty()) {
        return built_in_shader;
    }
    return [folder, &console](std::string_view name) -> std::optional<std::string> {
        constexpr std::uint64_t kMostBytes = 1 << 20;
        Result<std::string> text =
            lsc::read_file((std::filesystem::path(folder) / name).string(), kMostBytes, console);
        return text ? std::optional(std::move(text.value())) : std::nullopt;
    };
}

/// A drawing in the plane of X and Y.
bool is_plane(const Bounds& bounds) {
    const glm::vec3 size = bounds.high - bounds.low;
    return size.z < 0.05F * std::max(size.x, size.y);
}

Status run_pictures(const ViewOptions& options, const Console& console) {
    const Result<Camera> camera = parse_camera(options.camera, Camera{});
    if (!camera) {
        return lsc::fail(Error{fmt::format("--camera: {}", camera.error().message)}, console);
    }
    PlantDocument document;
    const Status made = make_plant_document(options, console, document);
    if (made != Status::Fine) {
        return made;
    }
    const Result<std::unique_ptr<Headless>> context = Headless::make();
    if (!context) {
        return lsc::fail(context.error(), console);
    }
    Result<std::unique_ptr<Renderer>> renderer =
        Renderer::make(shaders_of(options.shaders, console));
    if (!renderer) {
        return lsc::fail(renderer.error(), console);
    }
    console.detail(
        fmt::format("drawing by {}: {}", context.value()->way(), renderer.value()->device_name()));
    renderer.value()->show_plant(document.mesh);
    renderer.value()->show_lines(make_lines(document.plant.skeleton, options.lines));
    Camera from = camera.value();
    if (options.camera.empty()) {
        if (is_plane(renderer.value()->bounds())) {
            from.eye = from.target + glm::vec3(0.0F, 0.0F, 1.0F);
        }
        from = framing(from, renderer.value()->bounds(),
                       static_cast<float>(options.width) / static_cast<float>(options.height));
    }
    return take_pictures(options, from, document, *renderer.value(), console);
}

struct Dispatch {
    const lsc::Io& io;

    Status operator()(const lsc::PrintText& text) const {
        const Console console(io, {});
        const Result<Done> written = console.write(text.text);
        return written ? Status::Fine : lsc::fail(written.error(), console);
    }
    Status operator()(const lsc::UsageError& usage) const {
        const Console console(io, {});
        console.error(usage.message);
        console.help(usage.help);
        return Status::Failure;
    }
    Status operator()(const ViewOptions& options) const {
        return run_pictures(options, Console(io, options.messages));
    }
};

/// Without allocating: there is no memory.
int out_of_memory(const lsc::Io& io) {
    io.err << io.program << ": error: out of memory\n" << std::flush;
    return static_cast<int>(Status::Limit);
}

} // namespace

int run(std::span<const std::string> arguments, const lsc::Io& io) {
    try {
        return static_cast<int>(std::visit(Dispatch{io}, parse_options(arguments)));
    } catch (const std::bad_alloc&) {
        return out_of_memory(io);
    } catch (const std::length_error&) { // what a string or vector throws when it cannot be so long
        return out_of_memory(io);
    }
}

} // namespace lsys::view
