// SPDX-License-Identifier: MIT
// View: common state of plant and forest views: last picture, messages, shaders. Every call needs a
// current OpenGL context.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/program/console.h"
#include "viewer/app/film_export.h"
#include "viewer/app/making_progress.h"
#include "viewer/app/options.h"
#include "viewer/app/picking.h"
#include "viewer/app/source_text.h"
#include "viewer/app/styled_text.h"
#include "viewer/gl/renderer.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

constexpr double kMillisecondsPerSecond = 1e3;
/// Time that a note stays on the screen.
constexpr std::chrono::seconds kNoteTime{10};

/// Time after which the window shows what is being made.
constexpr std::chrono::milliseconds kProgressDelay{300};

/// A message in the overlay.
struct ShownMessage {
    Severity severity = Severity::Note;
    std::string head; // `file:line:column: severity: message [code]`
    std::string text; // the whole message, with source lines
    std::optional<FilePosition> place{};
};

class View {
public:
    /// `wake` is called on any thread when update() has work.
    View(const ViewOptions& options,
         const Console& console,
         Renderer& renderer,
         std::function<void()> wake);
    View(const View&) = delete;
    View& operator=(const View&) = delete;
    virtual ~View() = default;

    /// Takes finished work and requests work for changed settings, between two frames. Returns
    /// whether panels may show something new: messages, a description or a trace.
    virtual bool update() = 0;
    /// Draws if something has changed. Returns whether it drew.
    virtual bool draw(std::uint32_t width, std::uint32_t height) = 0;
    /// Call when the last picture is on the screen. `draw_seconds`: time to draw it.
    virtual void picture_shown(double draw_seconds) = 0;
    /// Whether work or motion goes on, so that update() is due soon.
    [[nodiscard]] virtual bool is_busy() const = 0;
    /// The work of another thread for the next picture. Empty if there is none, and in the first
    /// kProgressDelay of the work.
    [[nodiscard]] virtual std::optional<MakingState> making() const = 0;
    /// Stops what making() returns. The last plant or forest stays, with the settings that made it.
    virtual void cancel_making() = 0;
    /// Makes changed settings a step of undo(). Call between two frames while no control is held.
    virtual void record_edits() = 0;
    virtual void undo() = 0;
    virtual void redo() = 0;
    /// Reads all files again.
    virtual void reload() = 0;
    /// Moves the camera to show everything.
    virtual void frame_all() = 0;
    /// Moves the camera to a standard view of everything.
    virtual void show_from(StandardView view) {
        camera() = seen_from(view, camera());
        frame_all();
    }
    /// Path of the grammar or scene shown; empty in the start view.
    [[nodiscard]] virtual const std::string& path() const = 0;
    [[nodiscard]] virtual Camera& camera() = 0;
    /// Whether a forest is shown.
    [[nodiscard]] virtual bool is_forest() const { return false; }
    /// Whether the plant or forest grows, so that a film can show its growth.
    [[nodiscard]] virtual bool has_growth() const { return false; }
    /// Whether there are changes that save() writes to the file.
    [[nodiscard]] virtual bool is_unsaved() const { return false; }
    /// Writes the changes to the file and reports the result in a note. They stay unsaved if that
    /// fails.
    virtual void save() {}

    /// Starts to describe the part that a pixel of the last picture shows; picked() returns the
    /// description once it is made. Then a trace of its module begins.
    void pick(const PicturePixel& pixel);
    /// Description of the part picked last; without lines if there is none.
    [[nodiscard]] const Description& picked() const { return picked_; }
    /// Count of descriptions made.
    [[nodiscard]] std::uint64_t pick_count() const { return pick_count_; }
    void forget_picked();
    /// Starts to trace the module picked last; traced() has the trace once it is made. Does nothing
    /// without a module.
    void trace(TraceScope scope);
    /// Scope of the last trace, and of the first trace of the next module.
    [[nodiscard]] TraceScope trace_scope() const { return trace_scope_; }
    /// Trace of the module picked last, in lines; empty if there is none or it is not made yet.
    [[nodiscard]] const std::vector<TextLine>& traced() const { return traced_; }
    /// Whether the trace of the module picked last is shown or being made.
    [[nodiscard]] bool shows_trace() const { return wants_trace_; }
    void forget_trace();

    /// Adds samples to the last picture, which must be up to date: draw() has just returned false.
    /// Returns whether it drew.
    [[nodiscard]] bool refine() {
        return frame_ && frame_->samples > 1 && !changed_ && renderer_->refine();
    }
    /// Copies the last picture to a part of the window whose context is current.
    void present(const PixelArea& area) { renderer_->present(area); }
    /// Writes the last picture to a new file in the current folder and reports its name.
    void write_screenshot();
    /// Draws the last picture again with the size and samples of `settings`, writes it to
    /// settings.path(), and reports the result in a note. The next draw() draws the window's
    /// picture again.
    void write_picture(const PictureSettings& settings);
    /// Options of lsview with which run_pictures() draws the plant or forest shown, at rest, with
    /// the camera of the window. A film of growth ends at the last generation or year.
    [[nodiscard]] virtual ViewOptions picture_options(FilmKind kind) const = 0;
    /// Width and height of the last picture, pixels; 0 before the first one.
    [[nodiscard]] std::uint32_t picture_width() const { return frame_ ? frame_->width : 0; }
    [[nodiscard]] std::uint32_t picture_height() const { return frame_ ? frame_->height : 0; }
    void set_note(const std::string& note);
    /// Removes the note once it was shown for kNoteTime. Returns whether it did.
    bool drop_old_note(SteadyClock::time_point now);

    /// Messages of the last request, formatted as `lsc` does.
    [[nodiscard]] const std::string& messages() const { return text_; }
    /// Messages of the last request, of shaders and of OpenGL.
    [[nodiscard]] std::string all_messages() const;
    /// Messages of the last request, one by one.
    [[nodiscard]] const std::vector<ShownMessage>& entries() const { return entries_; }
    /// The sources that the last request has read.
    [[nodiscard]] virtual LoadedSources loaded_sources() const = 0;
    /// Count of requests whose messages were taken; loaded_sources() changes with it.
    [[nodiscard]] std::uint64_t taken_request_count() const { return taken_request_count_; }
    /// The file of the last request whose messages were taken.
    [[nodiscard]] const std::string& loaded_file() const { return loaded_file_; }
    /// Whether the last request failed.
    [[nodiscard]] bool failed() const { return failed_; }
    [[nodiscard]] const std::string& shader_message() const { return shader_message_; }
    /// Last note, for example "wrote plant-1.png"; empty if it is old.
    [[nodiscard]] const std::string& note() const { return note_; }
    [[nodiscard]] const Console& console() const { return console_; }
    [[nodiscard]] const Renderer& renderer() const { return *renderer_; }

protected:
    /// The request that describes `picked`; PickRequest::describe is empty if there is
    /// nothing to describe.
    /// Precondition: `picked` is not PickedKind::Nothing.
    [[nodiscard]] virtual PickRequest request_for(const Picked& picked) const = 0;
    /// Takes the outcomes of picker_ and tracer_. Returns whether picked() or traced() changed.
    bool take_picked();
    /// Whether a pick or a trace is being made.
    [[nodiscard]] bool is_picking() const {
        return (picker_ != nullptr && picker_->is_busy()) ||
               (tracer_ != nullptr && tracer_->is_busy());
    }
    /// Sets the quality of the next pictures. An error is a note; the old quality stays.
    void use_quality(Quality quality);
    /// Draws `frame` if something has changed. Returns whether it drew.
    bool draw_frame(const Frame& frame);
    /// Stores the messages of a request; prints them if they differ from the last ones.
    void take_messages(const Messages& messages, bool succeeded);
    void request_shader_reload() { shaders_changed_ = true; }
    /// loaded_sources() with the fields that all views have.
    [[nodiscard]] LoadedSources common_sources() const;
    /// Reloads shaders if they changed. Returns whether messages changed.
    bool reload_shaders();
    [[nodiscard]] bool is_shader(const std::string& file) const;
    /// Appends the files of the shader folder to `files`.
    [[nodiscard]] std::vector<std::string> with_shader_files(std::vector<std::string> files) const;

    ViewOptions options_;
    Console console_;
    Renderer* renderer_;
    std::function<void()> wake_; // on any thread, when update() has work
    std::string shader_message_;
    // Last picture.
    std::optional<Frame> frame_;
    FrameStats drawn_;
    float aspect_ = 1.0F;
    std::optional<Quality> quality_; // the last one that use_quality() set
    bool changed_ = true;            // the next picture is drawn even if its frame equals frame_

private:
    std::string text_;
    std::vector<ShownMessage> entries_;
    std::shared_ptr<const Messages> messages_; // of the last request
    std::string loaded_file_;
    std::uint64_t taken_request_count_ = 0;
    std::string note_;
    SteadyClock::time_point note_since_;
    bool failed_ = false;
    std::atomic<bool> shaders_changed_{false};
    bool take_trace();

    Description picked_;
    std::uint64_t pick_count_ = 0;
    TraceFunction trace_function_; // traces the part picked last
    TraceScope trace_scope_ = TraceScope::Written;
    std::vector<TextLine> traced_;
    bool wants_trace_ = false;            // a trace was requested and not forgotten
    std::unique_ptr<TraceWorker> tracer_; // made by the first trace
    bool wants_picked_ = false;           // a description was requested and not forgotten
    std::unique_ptr<PickWorker> picker_;  // made by the first pick
};

} // namespace lsys::view
