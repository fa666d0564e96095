// SPDX-License-Identifier: MIT
#include "viewer/app/picture_series.h"

#include "grammar/base/hash.h"
#include "runtime/meshing/texture.h"
#include "runtime/program/files.h"
#include "viewer/app/daylight.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <numbers>
#include <utility>

namespace lsys::view {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Max number of pixels of a draw; larger pictures are drawn in stripes.
constexpr std::uint64_t kStripePixels = std::uint64_t{1} << 22;

/// Divides colours by opacity, because pixels at edges are mixed with transparent black.
void divide_by_opacity(std::vector<std::uint8_t>& texels) {
    constexpr unsigned kOpaque = 255;
    for (std::size_t at = 0; at + 3 < texels.size(); at += 4) {
        const unsigned opacity = texels[at + 3];
        if (opacity == 0 || opacity == kOpaque) {
            continue;
        }
        for (std::size_t channel = at; channel < at + 3; ++channel) {
            texels[channel] = static_cast<std::uint8_t>(
                std::min((texels[channel] * kOpaque + opacity / 2) / opacity, kOpaque));
        }
    }
}

/// Writes a file under a temporary name and appends it to `outputs`. The file gets the name `path`
/// when `outputs` are committed.
Result<void> write_part(const std::string& path,
                        const std::string& bytes,
                        const Console& console,
                        std::vector<Output>& outputs) {
    Result<Output> output = Output::open(path, console);
    if (!output) {
        return output.error();
    }
    outputs.push_back(std::move(output.value()));
    const Result<void> written = outputs.back().write(bytes);
    return written ? outputs.back().finish() : written;
}

} // namespace

Texture
draw_picture(const Frame& frame, Renderer& renderer, FrameStats& stats, double& read_milliseconds) {
    Texture picture;
    picture.width = frame.width;
    picture.height = frame.height;
    const auto rows = static_cast<std::uint32_t>(
        std::clamp<std::uint64_t>(kStripePixels / frame.width, 1, frame.height));
    std::vector<std::uint8_t> stripe;
    for (std::uint32_t top = frame.height; top != 0;) {
        const std::uint32_t height = std::min(rows, top);
        top -= height;
        const FrameStats drawn = renderer.draw(frame, {0, top, frame.width, height});
        stats.draws += drawn.draws;
        stats.triangles += drawn.triangles;
        const Clock::time_point start = Clock::now();
        renderer.read(stripe);
        read_milliseconds += milliseconds_since(start);
        stats.triangles += renderer.forest_stats().device_triangles;
        if (height == frame.height) {
            picture.texels = std::move(stripe);
        } else {
            picture.texels.insert(picture.texels.end(), stripe.begin(), stripe.end());
        }
    }
    if (frame.transparent) {
        divide_by_opacity(picture.texels);
    }
    return picture;
}

double median(std::vector<double> values) {
    if (values.empty()) {
        return 0.0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Frame frame_of(const ViewOptions& options, const Camera& camera) {
    Frame frame;
    frame.camera = camera;
    frame.width = options.width;
    frame.height = options.height;
    frame.shadows = options.shadows;
    frame.ground = options.ground && !options.transparent;
    frame.transparent = options.transparent;
    frame.style = options.style;
    frame.wind = options.wind.value_or(Wind{});
    frame.samples = options.samples;
    frame.temporal = options.temporal == Temporal::On;
    frame.max_triangles = options.max_triangles;
    frame.light = daylight_of(options.light, frame.light);
    return frame;
}

ExitStatus take_series(const ViewOptions& options,
                       Frame frame,
                       Renderer& renderer,
                       const Console& console,
                       const std::function<ExitStatus(Frame& frame)>& prepare,
                       const std::function<ExitStatus(const Frame& frame)>& after,
                       PictureSeries& series) {
    if (options.frames > 1 && !options.turntable && options.fly_to.empty() && !options.grow &&
        !options.gravity && !options.wind) {
        console.info("nothing moves, so all pictures of the series are alike: --grow shows growth, "
                     "--turntable goes around, --fly-to moves, --wind blows");
    }
    const Camera camera = frame.camera;
    const std::uint32_t count = std::max(options.frames, 1U);
    const Camera last = with_parts(options.fly_to, camera);
    std::vector<Output> outputs; // used only with options.all_or_none
    for (std::uint32_t i = 0; i < count; ++i) {
        if (console.interrupted()) {
            return ExitStatus::Interrupted;
        }
        frame.time = static_cast<double>(options.time) +
                     static_cast<double>(i) / static_cast<double>(options.frames_per_second);
        if (options.turntable) {
            frame.camera = orbited(camera,
                                   2.0F * std::numbers::pi_v<float> * static_cast<float>(i) /
                                       static_cast<float>(count),
                                   0.0F);
        }
        if (!options.fly_to.empty()) {
            frame.camera = between(camera, last, static_cast<double>(i) / (count - 1));
        }
        if (prepare) {
            const Clock::time_point start = Clock::now();
            if (const ExitStatus status = prepare(frame); status != ExitStatus::Ok) {
                return status;
            }
            series.prepare.push_back(milliseconds_since(start));
        }
        Clock::time_point start = Clock::now();
        series.drawn = {};
        double read_milliseconds = 0.0;
        const Texture picture = draw_picture(frame, renderer, series.drawn, read_milliseconds);
        series.draw.push_back(milliseconds_since(start));
        series.read.push_back(read_milliseconds);
        series.cpu.push_back(renderer.frame_times().cpu);
        series.gpu.push_back(renderer.frame_times().gpu);
        start = Clock::now();
        series.digest = golden_multiple(series.digest) + fnv1a(picture.texels);
        const std::string bytes = encode_png(picture);
        if (bytes.empty()) {
            return report_error(Error{"not enough memory for the picture"}, console);
        }
        const std::string path =
            options.frames == 0 ? options.screenshot : numbered_path(options.screenshot, i + 1);
        if (const Result<void> written = options.all_or_none
                                             ? write_part(path, bytes, console, outputs)
                                             : write_file(path, bytes, console);
            !written) {
            return report_error(written.error(), console);
        }
        if (options.pictures_done != nullptr) {
            ++*options.pictures_done;
        }
        series.write.push_back(milliseconds_since(start));
        if (after) {
            if (const ExitStatus status = after(frame); status != ExitStatus::Ok) {
                return status;
            }
        }
    }
    if (!renderer.errors().empty()) {
        return report_error(Error{fmt::format("OpenGL: {}", renderer.errors().front())}, console);
    }
    return report_result(commit_all(outputs), console);
}

ExitStatus write_picked(const ViewOptions& options,
                        const Frame& frame,
                        std::uint32_t number,
                        Renderer& renderer,
                        const Console& console,
                        const std::function<Outcome<Description>(const Picked& picked)>& describe) {
    const Result<Picked> picked =
        renderer.pick(frame, options.pick->x, frame.height - 1 - options.pick->y);
    if (!picked) {
        return report_error(picked.error(), console);
    }
    Description description{{"nothing"}, {}, {}};
    if (picked.value().kind != PickedKind::Nothing) {
        if (const ExitStatus status = console.take(describe(picked.value()), description);
            status != ExitStatus::Ok) {
            return status;
        }
    }
    std::string text = options.frames == 0 ? std::string() : fmt::format("picture {}\n", number);
    for (const std::string& line : description.lines) {
        text += line + '\n';
    }
    return report_result(console.write(text), console);
}

ExitStatus
write_stats_text(const ViewOptions& options, const std::string& text, const Console& console) {
    const Result<void> written =
        options.stats == "-" ? console.write(text) : write_file(options.stats, text, console);
    return written ? ExitStatus::Ok : report_error(written.error(), console);
}

} // namespace lsys::view
