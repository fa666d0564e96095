// PictureSeries: pictures of a run as files, one or a numbered series, and how long each took.
#pragma once

#include "runtime/program/console.h"
#include "viewer/app/options.h"
#include "viewer/gl/renderer.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lsys::view {

struct PictureSeries {
    // Of each picture, in ms.
    std::vector<double> prepare; // what the caller did before it
    std::vector<double> draw;
    std::vector<double> read; // back from the device
    std::vector<double> write;
    FrameStats drawn;         // of the last one
    std::uint64_t digest = 0; // tells whether two runs made the same pictures
};

/// 0 of none.
[[nodiscard]] double median(std::vector<double> values);

/// The frame that the options ask for.
[[nodiscard]] Frame frame_of(const ViewOptions& options, const Camera& camera);

/// Draws and writes the pictures that the options ask for, from `frame` on. `prepare`, which may be
/// empty, is called before each with its frame; other than Fine ends the series. So is `after`,
/// after each was drawn. Fails if OpenGL reports an error.
[[nodiscard]] ExitStatus take_series(const ViewOptions& options,
                                     Frame frame,
                                     Renderer& renderer,
                                     const Console& console,
                                     const std::function<ExitStatus(const Frame& frame)>& prepare,
                                     const std::function<void(const Frame& frame)>& after,
                                     PictureSeries& series);

/// Writes the text where --stats says.
[[nodiscard]] ExitStatus
write_stats_text(const ViewOptions& options, const std::string& text, const Console& console);

} // namespace lsys::view
