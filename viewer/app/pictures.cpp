#include "viewer/app/pictures.h"

#include "runtime/cli/files.h"
#include "runtime/cli/tell.h"
#include "runtime/physics.h"
#include "runtime/texture.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

namespace lsys::view {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Pixels that are drawn at once: a larger picture is drawn in stripes.
constexpr std::uint64_t kStripePixels = std::uint64_t{1} << 22;
constexpr double kStepsPerSecond = 60.0;

/// Times of the pictures of a run, each in ms.
struct PictureTimes {
    std::vector<double> bend;
    std::vector<double> draw; // with the transfer back
    std::vector<double> write;
};

double median(std::vector<double> values) {
    if (values.empty()) {
        return 0.0;
    }
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Rows of a picture, drawn stripe by stripe.
Texture draw_picture(const Frame& frame, Renderer& renderer, FrameStats& stats) {
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
        renderer.read(stripe);
        if (height == frame.height) {
            picture.texels = std::move(stripe);
        } else {
            picture.texels.insert(picture.texels.end(), stripe.begin(), stripe.end());
        }
    }
    return picture;
}

/// FNV-1a: tells whether two runs made the same picture.
std::uint64_t digest_of(const std::vector<std::uint8_t>& texels) {
    std::uint64_t digest = 0xCBF29CE484222325U;
    for (const std::uint8_t texel : texels) {
        digest = (digest ^ texel) * 0x100000001B3U;
    }
    return digest;
}

/// tree.png and 12: tree.0012.png
std::string numbered(const std::string& path, std::uint32_t number) {
    const std::filesystem::path name(path);
    std::filesystem::path result = name;
    return result.replace_extension(fmt::format(".{:04}{}", number, name.extension().string()))
        .string();
}

/// The plant as it is at moments of its motion.
class Motion {
public:
    Motion(const ViewOptions& options, const PlantDocument& document)
        : seconds_of_frame_(1.0 / static_cast<double>(options.frames_per_second)) {
        if (!options.gravity && !options.wind) {
            return;
        }
        PhysicsOptions forces;
        forces.gravity = options.gravity.value_or(0.0F);
        forces.wind = options.wind.value_or(Wind{});
        forces.damping = document.grammar.bytecode->settings.damping;
        forces.threads = options.threads;
        // Whole steps from one frame to the next.
        const double steps = std::max(1.0, std::ceil(kStepsPerSecond * seconds_of_frame_));
        forces.time_step = static_cast<float>(seconds_of_frame_ / steps);
        physics_ = std::make_unique<PlantPhysics>(document.plant.skeleton, forces);
        constexpr double kRadians = 1e-6;
        constexpr std::uint32_t kRounds = 10'000;
        static_cast<void>(physics_->settle(kRadians, kRounds));
        go_to(static_cast<double>(options.time));
    }

    [[nodiscard]] bool moves() const { return physics_ != nullptr; }
    /// Nothing if it does not bend.
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

lsc::Status write_stats(const ViewOptions& options,
                        const Camera& camera,
                        const PlantDocument& document,
                        const Renderer& renderer,
                        const FrameStats& drawn,
                        const PictureTimes& times,
                        std::uint64_t digest,
                        const lsc::Console& console) {
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
    stats["pictures"] = times.draw.size();
    stats["draws"] = drawn.draws;
    stats["triangles"] = drawn.triangles;
    stats["uploaded_bytes"] = renderer.uploaded_bytes();
    stats["live_objects"] = renderer.live_objects();
    stats["errors"] = renderer.errors();
    stats["digest"] = fmt::format("{:016x}", digest);
    nlohmann::ordered_json& milliseconds = stats["milliseconds"];
    milliseconds["compile"] = 1e3 * document.load_seconds;
    milliseconds["derive"] = 1e3 * document.plant.derive_seconds;
    milliseconds["turtle"] = 1e3 * document.plant.draw_seconds;
    milliseconds["mesh"] = 1e3 * document.mesh_seconds;
    milliseconds["bend"] = median(times.bend);
    milliseconds["draw"] = median(times.draw);
    milliseconds["write"] = median(times.write);
    const std::string text =
        stats.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    const Result<Done> written =
        options.stats == "-" ? console.write(text) : lsc::write_file(options.stats, text, console);
    return written ? lsc::Status::Fine : lsc::fail(written.error(), console);
}

} // namespace

lsc::Status take_pictures(const ViewOptions& options,
                          const Camera& camera,
                          PlantDocument& document,
                          Renderer& renderer,
                          const lsc::Console& console) {
    Frame frame;
    frame.camera = camera;
    frame.width = options.width;
    frame.height = options.height;
    frame.shadows = options.shadows;
    frame.ground = options.ground;
    frame.style = options.style;
    frame.wind = options.wind.value_or(Wind{});
    Motion motion(options, document);
    Skeleton pose;
    MeshOptions mesh_options = options.mesh;
    mesh_options.threads = options.threads;
    mesh_options.max_bytes = options.max_bytes;
    PictureTimes times;
    FrameStats drawn;
    std::uint64_t digest = 0;
    const std::uint32_t count = std::max(options.frames, 1U);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (console.interrupted()) {
            return lsc::Status::Interrupted;
        }
        frame.time = static_cast<double>(options.time) +
                     static_cast<double>(i) / static_cast<double>(options.frames_per_second);
        if (motion.moves()) {
            const Clock::time_point start = Clock::now();
            motion.go_to(frame.time);
            motion.pose(pose);
            const lsc::Status status = lsc::mesh_plant(document.plant, pose, mesh_options,
                                                       document.grammar, console, document.mesh);
            if (status != lsc::Status::Fine) {
                return status;
            }
            renderer.show_plant(document.mesh);
            renderer.show_lines(make_lines(pose, options.lines));
            times.bend.push_back(milliseconds_since(start));
        }
        if (options.turntable) {
            frame.camera = orbited(camera,
                                   2.0F * std::numbers::pi_v<float> * static_cast<float>(i) /
                                       static_cast<float>(count),
                                   0.0F);
        }
        Clock::time_point start = Clock::now();
        drawn = {};
        const Texture picture = draw_picture(frame, renderer, drawn);
        times.draw.push_back(milliseconds_since(start));
        start = Clock::now();
        digest ^= digest_of(picture.texels) + i;
        const std::string bytes = encode_png(picture);
        if (bytes.empty()) {
            return lsc::fail(Error{"there is no memory for the picture"}, console);
        }
        const std::string path =
            options.frames == 0 ? options.screenshot : numbered(options.screenshot, i + 1);
        if (const Result<Done> written = lsc::write_file(path, bytes, console); !written) {
            return lsc::fail(written.error(), console);
        }
        times.write.push_back(milliseconds_since(start));
    }
    if (!renderer.errors().empty()) {
        return lsc::fail(Error{fmt::format("OpenGL: {}", renderer.errors().front())}, console);
    }
    return options.stats.empty()
               ? lsc::Status::Fine
               : write_stats(options, camera, document, renderer, drawn, times, digest, console);
}

} // namespace lsys::view
