// SPDX-License-Identifier: MIT
#include "viewer/app/forest_pictures.h"

#include "runtime/pipeline/forest_growth.h"
#include "runtime/platform/memory.h"
#include "runtime/program/host.h"
#include "viewer/app/forest_senses.h"
#include "viewer/app/forest_streamer.h"
#include "viewer/app/picking.h"
#include "viewer/app/picture_series.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace lsys::view {

namespace {

/// Times taken to choose the trees of each picture, ms.
struct CullTimes {
    std::vector<double> wall;
    std::vector<double> cpu;
    std::vector<double> gpu;
};

nlohmann::ordered_json pass_stats(const FrameStats& pass) {
    nlohmann::ordered_json stats;
    stats["draws"] = pass.draws;
    stats["triangles"] = pass.triangles;
    stats["gpu_ms"] = pass.gpu_milliseconds;
    return stats;
}

/// Statistics of a streamed forest as JSON. Its member `trees` is an estimate, tree_count().
nlohmann::ordered_json streaming_stats(const ForestStreamer& streamer,
                                       const ForestDocument& document) {
    const StreamStats numbers = streamer.stats();
    nlohmann::ordered_json stats;
    stats["trees"] = tree_count(document);
    stats["square_m"] = document.model.streamed->layout.side;
    stats["squares_shown"] = numbers.shown;
    stats["squares_kept"] = numbers.kept;
    stats["squares_made"] = numbers.made;
    stats["bytes"] = numbers.bytes;
    stats["peak_bytes"] = numbers.peak_bytes;
    stats["slowest_step_ms"] = 1e3 * numbers.slowest_step;
    stats["wait_ms"] = 1e3 * numbers.wait_seconds;
    return stats;
}

std::string stats_text(const ViewOptions& options,
                       const Camera& camera,
                       const ForestDocument& document,
                       const Renderer& renderer,
                       const PictureSeries& series,
                       const CullTimes& cull,
                       const FrameStats& shadow,
                       const ForestStreamer* streamer) {
    const ForestFrameStats& frame = renderer.forest_stats();
    const ForestSizes sizes = renderer.forest_sizes();
    nlohmann::ordered_json stats;
    stats["file"] = options.file;
    stats["device"] = renderer.device_name();
    stats["culling"] = frame.is_culled_on_device ? "gpu" : "cpu";
    stats["width"] = options.width;
    stats["height"] = options.height;
    stats["samples"] = options.samples;
    stats["quality"] = name_of(renderer.quality());
    stats["camera"] = to_text(camera);
    stats["air_km"] = options.visibility ? static_cast<double>(*options.visibility)
                                         : default_visibility(document);
    stats["trees"] = sizes.trees;
    if (streamer != nullptr) {
        stats["streaming"] = streaming_stats(*streamer, document);
    }
    nlohmann::ordered_json& drawn = stats["trees_drawn"];
    for (std::size_t level = 0; level < frame.trees_of_level.size(); ++level) {
        drawn[fmt::format("level_{}", level)] = frame.trees_of_level[level];
    }
    drawn["impostors"] = frame.far_trees;
    drawn["in_cells"] = frame.clustered_trees;
    drawn["blended"] = frame.blended_trees;
    drawn["behind_ground"] = frame.occluded_trees;
    stats["cells_drawn"] = frame.clusters;
    stats["branches_drawn"] = frame.drawn_branches;
    stats["trees_expanded"] = frame.expanded_trees;
    stats["detail"] = frame.detail;
    stats["pictures"] = series.draw.size();
    stats["draws"] = series.drawn.draws;
    stats["triangles"] = series.drawn.triangles;
    nlohmann::ordered_json& passes = stats["passes"];
    passes["branches"] = pass_stats(frame.branches);
    passes["impostors"] = pass_stats(frame.impostors);
    passes["terrain"] = pass_stats(frame.terrain);
    passes["shadow"] = pass_stats(shadow); // sum of the series
    nlohmann::ordered_json& bytes = stats["bytes"];
    bytes["trees"] = sizes.tree_bytes;
    bytes["branches"] = sizes.branch_bytes;
    bytes["culling"] = sizes.culling_bytes;
    bytes["meshes"] = sizes.mesh_bytes;
    bytes["textures"] = sizes.texture_bytes;
    bytes["uploaded"] = renderer.uploaded_bytes();
    bytes["peak_resident"] = platform::peak_memory();
    stats["live_objects"] = renderer.live_objects();
    stats["errors"] = renderer.errors();
    stats["digest"] = fmt::format("{:016x}", series.digest);
    nlohmann::ordered_json& milliseconds = stats["milliseconds"];
    milliseconds["parse"] = 1e3 * document.parse_seconds;
    milliseconds["heroes"] = 1e3 * document.grown.cache_seconds;
    milliseconds["place"] = 1e3 * document.grown.place_seconds;
    milliseconds["mesh"] = 1e3 * document.mesh_seconds;
    milliseconds["upload"] = sizes.upload_milliseconds;
    milliseconds["impostors"] = sizes.impostor_milliseconds;
    milliseconds["first_draw"] = series.draw.empty() ? 0.0 : series.draw.front();
    milliseconds["cull"] = median(cull.wall);
    milliseconds["cull_cpu"] = median(cull.cpu);
    milliseconds["cull_gpu"] = median(cull.gpu);
    milliseconds["draw_cpu"] = median(series.cpu);
    milliseconds["draw_gpu"] = median(series.gpu);
    milliseconds["draw"] = median(series.draw);
    milliseconds["fastest_draw"] =
        series.draw.empty() ? 0.0 : *std::min_element(series.draw.begin(), series.draw.end());
    milliseconds["read"] = median(series.read);
    milliseconds["write"] = median(series.write);
    return stats.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// Makes the renderer show the forest at a moment of its growth.
ExitStatus show_moment(const GrowthMoment& moment,
                       const SenseLook& senses,
                       const Camera& camera,
                       const Project& project,
                       const Console& console,
                       ForestGrowth& growth,
                       ForestDocument& document,
                       Renderer& renderer) {
    const auto height_of = [&](const Tree& tree) {
        return document.model.forms[document.model.form_of(tree)].height();
    };
    const ExitStatus status =
        console.take(growth.trees(moment, height_of, project, document.grown.forest.trees));
    if (status != ExitStatus::Ok) {
        return status;
    }
    if (const Result<void> shown = renderer.show_forest(document.model); !shown) {
        return report_error(shown.error(), console);
    }
    static_cast<void>(renderer.bake_impostors(std::numeric_limits<double>::infinity()));
    renderer.show_senses(forest_sense_drawing(document, senses, camera));
    return ExitStatus::Ok;
}

} // namespace

ExitStatus take_forest_pictures(const ViewOptions& options,
                                const Camera& camera,
                                ForestDocument& document,
                                Renderer& renderer,
                                const Console& console) {
    std::optional<ForestGrowth> growth;
    const Project project = make_project(console, options.run);
    std::uint32_t frame_number = 0;
    std::function<ExitStatus(Frame&)> prepare;
    std::unique_ptr<ForestStreamer> streamer;
    if (options.grow && document.squares != nullptr) {
        return report_error(Error{"a streamed forest does not grow; leave out --grow"}, console);
    }
    if (options.grow) {
        Outcome<ForestGrowth> begun = ForestGrowth::begin(document.scene, document.grown, project);
        if (!begun) {
            console.show(begun.messages());
            return status_of(begun.stop());
        }
        growth.emplace(std::move(begun.value()));
        prepare = [&](const Frame& shown) {
            const GrowthMoment moment =
                moment_of_frame(frame_number++, options.frames, growth->last_year());
            return show_moment(moment, options.senses, shown.camera, project, console, *growth,
                               document, renderer);
        };
    }
    renderer.show_senses(forest_sense_drawing(document, options.senses, camera));
    if (document.squares != nullptr) {
        streamer = std::make_unique<ForestStreamer>(document, options.stream_bytes,
                                                    streaming_threads(options.run.threads), [] {});
        prepare = [&](Frame& shown) {
            const std::optional<float> range = streamer->settle(
                shown.camera, shown.height,
                [&](const SquareChanges& changes) { renderer.change_squares(changes); },
                [&] { return console.interrupted(); });
            if (!range) {
                return ExitStatus::Interrupted;
            }
            shown.tree_range = *range;
            return ExitStatus::Ok;
        };
    }
    PictureSeries series;
    CullTimes cull;
    FrameStats shadow;
    std::uint32_t pictures = 0;
    const auto after = [&](const Frame& shown) {
        const ForestFrameStats& drawn = renderer.forest_stats();
        cull.wall.push_back(drawn.cull_milliseconds);
        cull.cpu.push_back(drawn.cull_cpu_milliseconds);
        cull.gpu.push_back(drawn.cull_gpu_milliseconds);
        shadow.draws += drawn.shadow.draws;
        shadow.triangles += drawn.shadow.triangles;
        shadow.gpu_milliseconds = drawn.shadow.gpu_milliseconds; // of its last drawing
        ++pictures;
        if (!options.pick) {
            return ExitStatus::Ok;
        }
        return write_picked(options, shown, pictures, renderer, console, [&](const Picked& picked) {
            return describe(picked, renderer.trees_of(picked.form), document, options.file,
                            project);
        });
    };
    Frame frame = frame_of(options, camera);
    frame.light = forest_light(document, options.visibility, options.light);
    if (options.figure) {
        frame.figure = figure_at(document, camera);
    }
    const ExitStatus status =
        take_series(options, frame, renderer, console, prepare, after, series);
    return status != ExitStatus::Ok || options.stats.empty()
               ? status
               : write_stats_text(options,
                                  stats_text(options, camera, document, renderer, series, cull,
                                             shadow, streamer.get()),
                                  console);
}

} // namespace lsys::view
