// SPDX-License-Identifier: MIT
// Pictures and films that the window writes: their settings, and a film that is written on a thread
// of its own, in an OpenGL context of its own.
#pragma once

#include "viewer/app/latest_request_worker.h"
#include "viewer/app/making_progress.h"
#include "viewer/app/options.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace lsys::view {

/// Motion of a film.
enum class FilmKind : std::uint8_t { Turntable, Growth };

/// Choices of the user.
struct PictureSettings {
    std::uint32_t width = 0; // pixels; width or height 0: size of the window's picture
    std::uint32_t height = 0;
    std::uint32_t samples = 4; // per pixel
    bool transparent = false;  // no sky, no ground; plants only
    std::string folder;        // empty: the current folder
    std::string name;          // without extension
    bool is_film = false;
    FilmKind kind = FilmKind::Turntable;
    float seconds = 10.0F;
    float frames_per_second = 24.0F;
    bool as_mp4 = false;     // else numbered PNG
    bool has_ffmpeg = false; // ffmpeg was found when the dialog opened

    /// Path of the picture or film: folder, name and extension.
    [[nodiscard]] std::string path() const;
    /// Number of pictures of the film, at least 2.
    [[nodiscard]] std::uint32_t frames() const;
};

/// The first of the names `stem`-1, `stem`-2, ... for which `folder` has no file with the extension
/// .png.
[[nodiscard]] std::string unused_picture_name(const std::string& folder, const std::string& stem);

/// The input of the thread that writes a film.
struct FilmExportRequest {
    // Options of the film's pictures; values of `settings` replace them.
    std::shared_ptr<const ViewOptions> options;
    PictureSettings settings;
    std::shared_ptr<std::atomic<std::uint32_t>> finished_pictures; // for progress
    // Fields for LatestRequestWorker.
    SteadyClock::time_point changed_at;
    bool is_repeat = false;
};

/// Writes a film: numbered pictures, all or none, or a .mp4 file by ffmpeg. If it fails or is
/// cancelled, no file changes. Returns "Wrote turn.0001.png to turn.0240.png", or the lines of an
/// error message.
[[nodiscard]] std::string export_film(const FilmExportRequest& request,
                                      const std::atomic<bool>& cancelled);

/// Writes at most one film at a time.
class FilmExport {
public:
    /// Begins to write a film. `wake` is called on any thread when take() has an outcome.
    /// Precondition: !is_busy().
    void
    begin(const ViewOptions& options, const PictureSettings& settings, std::function<void()> wake);
    /// Takes the text that export_film() returned, once.
    [[nodiscard]] std::optional<std::string> take();
    [[nodiscard]] bool is_busy() const { return worker_ != nullptr && worker_->is_busy(); }
    /// Number of pictures written so far; nullopt if no film is being written.
    [[nodiscard]] std::optional<MakingState> state() const;
    /// Stops the film; no outcome follows.
    void cancel();

private:
    PictureSettings settings_;
    std::shared_ptr<std::atomic<std::uint32_t>> done_; // pictures written so far
    std::unique_ptr<LatestRequestWorker<FilmExportRequest, std::string>> worker_;
};

} // namespace lsys::view
