// SPDX-License-Identifier: MIT
// PictureSeries: pictures written by a run, one or a numbered series, with their times.
#pragma once

#include "runtime/meshing/texture.h"
#include "runtime/program/console.h"
#include "viewer/app/options.h"
#include "viewer/app/picking.h"
#include "viewer/gl/renderer.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lsys::view {

struct PictureSeries {
    // Times of each picture, ms.
    std::vector<double> prepare; // work of the caller before drawing
    std::vector<double> draw;
    std::vector<double> read; // read-back from the GPU
    std::vector<double> cpu;  // processor time of the drawing thread
    std::vector<double> gpu;  // by timer queries
    std::vector<double> write;
    FrameStats drawn;         // statistics of the last picture
    std::uint64_t digest = 0; // equal for runs with the same pictures
};

/// The median of `values`; 0 if there are none.
[[nodiscard]] double median(std::vector<double> values);

/// A frame with the camera and the values of the options.
[[nodiscard]] Frame frame_of(const ViewOptions& options, const Camera& camera);

/// Draws a picture in stripes. Adds to `stats` and `read_milliseconds`. With Frame::transparent,
/// colours are not multiplied by the opacity: PNG requires this.
[[nodiscard]] Texture
draw_picture(const Frame& frame, Renderer& renderer, FrameStats& stats, double& read_milliseconds);

/// Draws and writes the pictures of the options, starting with `frame`. `prepare`, which may be
/// empty, is called before each picture with its frame, and `after` after each picture; a status
/// other than Ok of either ends the series. Fails on OpenGL errors.
[[nodiscard]] ExitStatus take_series(const ViewOptions& options,
                                     Frame frame,
                                     Renderer& renderer,
                                     const Console& console,
                                     const std::function<ExitStatus(Frame& frame)>& prepare,
                                     const std::function<ExitStatus(const Frame& frame)>& after,
                                     PictureSeries& series);

/// Writes the lines of --pick for the frame to standard output; in a series, after a line with the
/// number of the picture. `describe`: called with the result of Renderer::pick(), unless it is
/// PickedKind::Nothing.
[[nodiscard]] ExitStatus
write_picked(const ViewOptions& options,
             const Frame& frame,
             std::uint32_t number, // number of the picture, from 1
             Renderer& renderer,
             const Console& console,
             const std::function<Outcome<Description>(const Picked& picked)>& describe);

/// Writes `text` to the target of --stats.
[[nodiscard]] ExitStatus
write_stats_text(const ViewOptions& options, const std::string& text, const Console& console);

} // namespace lsys::view
