// SPDX-License-Identifier: MIT
#include "viewer/app/film_export.h"

#include "grammar/base/paths.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/platform/child.h"
#include "runtime/program/files.h"
#include "runtime/program/run_files.h"
#include "viewer/app/lsview.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <utility>

namespace lsys::view {

namespace {

/// A new folder beside the film for the pictures of a .mp4 film; removed at the end with all its
/// files.
class PictureFolder {
public:
    explicit PictureFolder(const std::string& film) {
        path_ =
            path_of(film).parent_path() / fmt::format(".lsview-{:016x}", platform::random_bits());
        std::error_code error;
        std::filesystem::create_directory(path_, error);
        is_made_ = !error;
    }
    PictureFolder(const PictureFolder&) = delete;
    PictureFolder& operator=(const PictureFolder&) = delete;
    ~PictureFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] bool is_made() const { return is_made_; }
    [[nodiscard]] std::string operator/(const char* name) const { return path_text(path_ / name); }

private:
    std::filesystem::path path_;
    bool is_made_ = false; // the folder could be made
};

/// The last line of a text.
std::string last_line(std::string text) {
    text.erase(text.find_last_not_of(" \n") + 1);
    return text.substr(text.find_last_of('\n') + 1);
}

/// The pattern from which ffmpeg derives the numbered file names. A % in the folder's name is
/// escaped, because it has a meaning for ffmpeg.
std::string pattern_of(const std::string& folder) {
    std::string pattern;
    for (const char each : folder) {
        pattern += each == '%' ? std::string("%%") : std::string(1, each);
    }
    return pattern + "/film.%04d.png";
}

/// Encodes the pictures of a folder as a .mp4 film.
Result<void> encode(const PictureFolder& pictures,
                    const PictureSettings& settings,
                    const Console& console,
                    const std::atomic<bool>& cancelled) {
    const std::string program = platform::find_program("ffmpeg");
    if (program.empty()) {
        return Error{"ffmpeg is not installed, and it writes films as .mp4"};
    }
    const std::string film = pictures / "film.mp4";
    const std::string messages = pictures / "messages";
    std::string folder = pictures / "";
    folder.pop_back();
    // The filter `pad` makes width and height even, as H.264 needs.
    const std::vector<std::string> arguments = {program,
                                                "-nostdin",
                                                "-loglevel",
                                                "error",
                                                "-y",
                                                "-framerate",
                                                fmt::format("{}", settings.frames_per_second),
                                                "-i",
                                                pattern_of(folder),
                                                "-vf",
                                                "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                                "-c:v",
                                                "libx264",
                                                "-crf",
                                                "18",
                                                "-pix_fmt",
                                                "yuv420p",
                                                "-movflags",
                                                "+faststart",
                                                film};
    int status = 0;
    if (const platform::Reason reason =
            platform::run_program(arguments, messages, cancelled, status);
        reason != 0) {
        return Error{fmt::format("cannot run ffmpeg: {}", errno_text(reason))};
    }
    if (status != 0 || cancelled) {
        const Result<std::string> said = read_file(messages, {std::uint64_t{1} << 20U}, console);
        return Error{fmt::format("ffmpeg: {}", said && !said.value().empty()
                                                   ? last_line(said.value())
                                                   : fmt::format("it ended with {}", status))};
    }
    const platform::Reason reason = platform::rename_file(film, settings.path());
    return reason == 0
               ? Result<void>()
               : Error{fmt::format("cannot write `{}`: {}", settings.path(), errno_text(reason))};
}

/// Writes the film; returns the exit status of lsview with the same options.
ExitStatus write_film(const FilmExportRequest& request,
                      const Console& console,
                      const std::atomic<bool>& cancelled) {
    const PictureSettings& settings = request.settings;
    ViewOptions options = *request.options;
    options.frames = settings.frames();
    options.frames_per_second = settings.frames_per_second;
    options.turntable = settings.kind == FilmKind::Turntable;
    options.grow = settings.kind == FilmKind::Growth;
    options.width = settings.width;
    options.height = settings.height;
    options.samples = settings.samples;
    options.transparent = settings.transparent && !options.is_forest && !settings.as_mp4;
    options.pictures_done = request.finished_pictures.get();
    options.beside_window = true;
    if (!settings.as_mp4) {
        options.screenshot = settings.path();
        options.all_or_none = true;
        return run_pictures(options, console);
    }
    const PictureFolder pictures(settings.path());
    if (!pictures.is_made()) {
        return report_error(
            Error{fmt::format("cannot write into the folder of `{}`", settings.path())}, console);
    }
    options.screenshot = pictures / "film.png";
    const ExitStatus status = run_pictures(options, console);
    return status == ExitStatus::Ok
               ? report_result(encode(pictures, settings, console, cancelled), console)
               : status;
}

} // namespace

std::string PictureSettings::path() const {
    const std::string file = name + (is_film && as_mp4 ? ".mp4" : ".png");
    return folder.empty() ? file : path_text(path_of(folder) / path_of(file));
}

std::uint32_t PictureSettings::frames() const {
    constexpr float kMost = 100'000.0F;
    return static_cast<std::uint32_t>(
        std::clamp(std::round(seconds * frames_per_second), 2.0F, kMost));
}

std::string unused_picture_name(const std::string& folder, const std::string& stem) {
    PictureSettings settings;
    settings.folder = folder;
    std::error_code error;
    for (std::uint32_t number = 1;
         settings.name.empty() || std::filesystem::exists(path_of(settings.path()), error);
         ++number) {
        settings.name = fmt::format("{}-{}", stem, number);
    }
    return settings.name;
}

std::string export_film(const FilmExportRequest& request, const std::atomic<bool>& cancelled) {
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    MessageOptions messages = request.options->messages;
    messages.verbose = false;
    messages.colour = ColourMode::Never;
    RunFiles files;
    Io io{in, out, err, false, &cancelled, "lsview"};
    io.files = &files;
    const Console console(io, messages);
    ExitStatus status = ExitStatus::Limit;
    const auto work = [&] {
        status = write_film(request, console, cancelled);
        return true;
    };
    if (!catch_out_of_memory(work, [] { return false; })) {
        console.error("out of memory");
    }
    const PictureSettings& settings = request.settings;
    if (status != ExitStatus::Ok) {
        return err.str();
    }
    return settings.as_mp4
               ? fmt::format("Wrote {}, {} pictures", settings.path(), settings.frames())
               : fmt::format("Wrote {} to {}", numbered_path(settings.path(), 1),
                             numbered_path(settings.path(), settings.frames()));
}

void FilmExport::begin(const ViewOptions& options,
                       const PictureSettings& settings,
                       std::function<void()> wake) {
    settings_ = settings;
    done_ = std::make_shared<std::atomic<std::uint32_t>>(0);
    worker_ = std::make_unique<LatestRequestWorker<FilmExportRequest, std::string>>(
        export_film, std::move(wake));
    worker_->request(
        {std::make_shared<const ViewOptions>(options), settings, done_, SteadyClock::now(), false});
}

std::optional<std::string> FilmExport::take() {
    return worker_ == nullptr ? std::nullopt : worker_->take();
}

std::optional<MakingState> FilmExport::state() const {
    if (!is_busy() || !worker_->running_time()) {
        return std::nullopt;
    }
    const std::uint32_t count = settings_.frames();
    const std::uint32_t done = std::min(done_->load(), count);
    return MakingState{done == count && settings_.as_mp4
                           ? "Encoding " + settings_.path()
                           : fmt::format("Film: picture {} of {}", done, count),
                       static_cast<float>(done) / static_cast<float>(count)};
}

void FilmExport::cancel() {
    if (worker_ != nullptr) {
        worker_->cancel();
    }
}

} // namespace lsys::view
