// SPDX-License-Identifier: MIT
// PictureSeries: the pictures that a run writes, one or a numbered series, with the times taken by
// each.
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
    std::vector<double> prepare; // work of the caller before it draws
    std::vector<double> draw;    // drawing
    std::vector<double> read;    // reading the picture back from the GPU
    std::vector<double> cpu;     // processor time of the drawing thread
    std::vector<double> gpu;     // by timer queries
    std::vector<double> write;   // writing the picture to a file
    FrameStats drawn;            // statistics of the last picture
    std::uint64_t digest = 0;    // hash of all pictures
};

/// The median of `values`; 0 if there are none.
[[nodiscard]] double median(std::vector<double> values);

/// A frame with a camera and the values of the options.
[[nodiscard]] Frame frame_of(const ViewOptions& options, const Camera& camera);

/// Draws a picture in stripes. Adds to `stats` and `read_milliseconds`. With Frame::transparent,
/// colours are not multiplied by opacity, as PNG requires.
[[nodiscard]] Texture
draw_picture(const Frame& frame, Renderer& renderer, FrameStats& stats, double& read_milliseconds);

/// Draws and writes the pictures that the options request, the first with `frame`. Calls `prepare`
/// with the frame before each picture, unless `prepare` is empty, and `after` after each picture.
/// If either returns a status other than Ok, the series ends. Fails on OpenGL errors.
[[nodiscard]] ExitStatus take_series(const ViewOptions& options,
                                     Frame frame,
                                     Renderer& renderer,
                                     const Console& console,
                                     const std::function<ExitStatus(Frame& frame)>& prepare,
                                     const std::function<ExitStatus(const Frame& frame)>& after,
                                     PictureSeries& series);

/// Writes the lines of --pick for a frame to standard output; in a series, after a line with the
/// number of the picture. Calls `describe` with the result of Renderer::pick(), unless this is
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
