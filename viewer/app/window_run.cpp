// SPDX-License-Identifier: MIT
#include "viewer/app/window_run.h"

#include "runtime/program/files.h"
#include "viewer/app/controls.h"
#include "viewer/app/panels.h"
#include "viewer/app/recent_files.h"
#include "viewer/app/shader_folder.h"
#include "viewer/app/view_switcher.h"
#include "viewer/gl/window.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

namespace lsys::view {

namespace {

using Clock = std::chrono::steady_clock;

// Max time in s to wait for input: without work, and with work to do.
constexpr double kIdle = 0.5; // also the max delay after Ctrl-C
constexpr double kBusy = 0.02;
// Duration between two pictures of a progress bar.
constexpr std::chrono::milliseconds kProgressInterval{100};
// Max time step in s of a flying camera, so that the camera does not jump after a slow picture.
constexpr double kMaxFlightStep = 0.1;
/// Time without a change after which pictures are refined.
constexpr std::chrono::milliseconds kRest{300};
/// Max time in s to draw a picture that is refined; input must wait while a sample is drawn.
constexpr double kMaxRefinedSeconds = 0.15;
/// Number of pictures after input that ImGui needs until its layout is final.
constexpr int kPicturesAfterInput = 3;

std::string title_of(const std::string& file) {
    if (file.empty()) {
        return "lsview";
    }
    return std::filesystem::path(file).filename().string() + " - lsview";
}

class WindowRun {
public:
    WindowRun(Window& window, ViewSwitcher& switcher, const Console& console)
        : window_(window), switcher_(switcher), console_(console) {
        panels_.state_folder = state_folder();
        panels_.look = read_look(panels_.state_folder);
        look_ = panels_.look;
        window_.set_look(look_);
        panels_.source.look = read_source_look(panels_.state_folder);
        source_look_ = panels_.source.look;
        panels_.wake = [this] { window_.wake(); };
        panels_.add_image = [this](const Texture& picture) { return window_.add_image(picture); };
        if (!switcher_.current().path().empty()) {
            remember_file(panels_.state_folder, switcher_.current().path(), console_);
        }
    }

    /// Handles input and draws a picture if needed. Returns false to quit.
    bool step() {
        const double wait =
            pictures_left_ > 0 || refines_ || controls_.is_moving() ? 0.0
            : switcher_.current().is_busy() || panels_.film.is_busy() || panels_.sheet.is_busy()
                ? kBusy
                : kIdle;
        const WindowInput input = window_.wait(wait);
        const Clock::time_point now = Clock::now();
        const double passed =
            std::min(std::chrono::duration<double>(now - last_).count(), kMaxFlightStep);
        last_ = now;
        const bool flew = panels_.flies;
        const std::string file = switcher_.current().path();
        panels_.window_width = window_.width();
        panels_.window_height = window_.height();
        controls_.apply(input, passed, picture_area(), switcher_, panels_);
        if (panels_.flies != flew) {
            window_.capture_mouse(panels_.flies);
        }
        if (panels_.quits) {
            return false;
        }
        if (input.close_requested) {
            window_.stay_open();
        }
        if (!is_control_held()) {
            switcher_.current().record_edits();
        }
        if (shows_sheet_ && panels_.dialog != OpenDialog::Sheet) {
            window_.drop_images();
        }
        shows_sheet_ = panels_.dialog == OpenDialog::Sheet;
        const std::optional<std::string> film = panels_.film.take();
        if (film) {
            switcher_.current().set_note(*film);
        }
        bool has_new_content = switcher_.current().update() || film;
        has_new_content =
            panels_.source.update(switcher_.current(), panels_.wake) || has_new_content;
        if (const std::string failure = panels_.editors.forget_ended(); !failure.empty()) {
            switcher_.current().set_note(failure);
            has_new_content = true;
        }
        const bool dropped_note = switcher_.current().drop_old_note(now);
        if (input.has_events || has_new_content || dropped_note) {
            pictures_left_ = kPicturesAfterInput;
        }
        update_progress(now);
        draw();
        if (switcher_.current().path() != file) { // a panel has opened another file
            window_.set_title(title_of(switcher_.current().path()));
            window_.drop_images(); // the start page, whose pictures these are, is not shown again
            panels_.start = {};
            if (panels_.dialog == OpenDialog::Sheet) {
                close_sheet(panels_);
            }
            remember_file(panels_.state_folder, switcher_.current().path(), console_);
            pictures_left_ = kPicturesAfterInput;
        }
        if (is_loading(panels_.start) || panels_.sheet.has_pictures()) {
            pictures_left_ = std::max(pictures_left_, 1);
        }
        return true;
    }

private:
    /// The part of the window beside the panel.
    [[nodiscard]] PixelArea picture_area() const {
        PixelArea area{0, 0, window_.width(), window_.height()};
        if (panels_.panels && area.width != 0) {
            area.x =
                std::min(static_cast<std::uint32_t>(panel_width(window_.scale())), area.width - 1);
            area.width -= area.x;
        }
        if (!switcher_.current().path().empty()) {
            const float source =
                source_width(panels_, static_cast<float>(window_.width()), window_.scale());
            area.width -= std::min(static_cast<std::uint32_t>(source), area.width);
        }
        return area;
    }

    /// Draws while something is being made, and once more when it is ready.
    void update_progress(Clock::time_point now) {
        const bool is_making =
            switcher_.current().making().has_value() || panels_.film.state().has_value();
        if (is_making != shows_progress_ ||
            (is_making && now - last_progress_ >= kProgressInterval)) {
            pictures_left_ = std::max(pictures_left_, 1);
            last_progress_ = now;
        }
        shows_progress_ = is_making;
    }

    void draw() {
        const PixelArea area = picture_area();
        if (area.width == 0 || area.height == 0) {
            return;
        }
        const Clock::time_point start = Clock::now();
        const bool drew = switcher_.current().draw(area.width, area.height);
        if (drew) {
            last_drawn_ = start;
        }
        // When nothing moves, adds one sample at a time to the picture, so that input is handled
        // between samples.
        refines_ = start - last_drawn_ >= kRest && last_seconds_ <= kMaxRefinedSeconds &&
                   !controls_.is_moving() && !switcher_.current().is_busy() &&
                   switcher_.current().refine();
        if (!drew && !refines_ && pictures_left_ == 0) {
            return;
        }
        pictures_left_ = drew ? std::max(pictures_left_, 1) : std::max(pictures_left_ - 1, 0);
        switcher_.current().present(area);
        window_.begin_panels();
        View* const drawn = &switcher_.current();
        draw_panels(switcher_, panels_, window_.scale());
        window_.set_panel_keys(panels_.focus.has_keys());
        window_.present();
        if (panels_.look != look_ && !is_control_held()) {
            look_ = panels_.look;
            window_.set_look(look_);
            write_look(panels_.state_folder, look_, console_);
            pictures_left_ = kPicturesAfterInput;
        }
        if (panels_.source.look != source_look_ && !is_control_held()) {
            source_look_ = panels_.source.look;
            write_source_look(panels_.state_folder, source_look_, console_);
            pictures_left_ = kPicturesAfterInput;
        }
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (drew || refines_) {
            last_seconds_ = seconds;
        }
        if (drew && drawn == &switcher_.current()) {
            drawn->picture_shown(seconds);
        }
    }

    Window& window_;
    ViewSwitcher& switcher_;
    const Console& console_;
    Controls controls_;
    PanelState panels_;
    Clock::time_point last_ = Clock::now();   // time of the last round
    Clock::time_point last_progress_ = last_; // time of the last picture for the progress
    bool shows_progress_ = false;             // something was being made in the last round
    bool shows_sheet_ = false;                // the sheet was open in the last round
    WindowLook look_;                         // look of the window
    SourcePaneLook source_look_;              // settings of the source pane, as last written
    Clock::time_point last_drawn_ = last_;    // time of the last new picture of the view
    double last_seconds_ = 0.0;               // time taken by the last picture or sample
    bool refines_ = false;                    // the last round added a sample to the picture
    int pictures_left_ = kPicturesAfterInput; // pictures to draw before the window rests
};

} // namespace

ExitStatus run_window(const ViewOptions& options, const Console& console) {
    const Result<Camera> camera = parse_camera(options.camera, Camera{});
    if (!camera) {
        return report_error(Error{fmt::format("--camera: {}", camera.error().message)}, console);
    }
    // A file that cannot be read is a usage error; errors in a file that can be read are shown in
    // the window.
    if (!options.file.empty()) {
        if (const Result<std::string> bytes = read_file(options.file, {kMaxSourceBytes}, console);
            !bytes) {
            return report_error(bytes.error(), console);
        }
    }
    Result<std::unique_ptr<Window>> window =
        Window::make(title_of(options.file), options.width, options.height);
    if (!window) {
        const ExitStatus status = report_error(window.error(), console);
        console.help(options.file.empty()
                         ? "`lsview FILE --screenshot PICTURE` makes a picture without a window"
                         : "`--screenshot FILE` makes a picture without a window");
        return status;
    }
    Result<std::unique_ptr<Renderer>> renderer =
        Renderer::make(shaders_of(options.shaders, console));
    if (!renderer) {
        return report_error(shader_error(options.shaders, renderer.error()), console);
    }
    renderer.value()->set_culling(options.culling);
    console.detail(fmt::format("drawing by a window: {}", renderer.value()->device_name()));
    ViewSwitcher switcher(options, console, *renderer.value(),
                          [made = window.value().get()] { made->wake(); });
    switcher.current().camera() = camera.value();
    WindowRun run(*window.value(), switcher, console);
    while (run.step()) {
        if (console.interrupted()) {
            return ExitStatus::Interrupted;
        }
    }
    console.detail(fmt::format("--camera \"{}\"", to_text(switcher.current().camera())));
    if (!renderer.value()->errors().empty()) {
        return report_error(Error{fmt::format("OpenGL: {}", renderer.value()->errors().front())},
                            console);
    }
    return ExitStatus::Ok;
}

} // namespace lsys::view
