// SPDX-License-Identifier: MIT
// View: state that plant and forest views have in common: last picture, messages, shaders. Every
// call needs a current OpenGL context.
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
/// Duration for which a note stays on screen.
constexpr std::chrono::seconds kNoteTime{10};

/// Delay after which the window shows that something is being made.
constexpr std::chrono::milliseconds kProgressDelay{300};

/// A message as the window shows it.
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

    /// Call between two frames. Takes finished work of other threads and requests work for changed
    /// settings. Returns whether panels may show something new: messages, a description or a trace.
    virtual bool update() = 0;
    /// Draws the picture if something has changed. Returns whether it drew.
    virtual bool draw(std::uint32_t width, std::uint32_t height) = 0;
    /// Call when the last picture is on screen. `draw_seconds`: time taken to draw it.
    virtual void picture_shown(double draw_seconds) = 0;
    /// Whether there is work or motion, so that update() must be called soon.
    [[nodiscard]] virtual bool is_busy() const = 0;
    /// The work of another thread for the next picture. nullopt if there is no work, and for the
    /// first kProgressDelay of the work.
    [[nodiscard]] virtual std::optional<MakingState> making() const = 0;
    /// Stops the work that making() describes. The last plant or forest stays, with the settings
    /// from which it was made.
    virtual void cancel_making() = 0;
    /// Makes changed settings a step of undo(). Call between two frames while the user holds no
    /// control.
    virtual void record_edits() = 0;
    virtual void undo() = 0;
    virtual void redo() = 0;
    /// Reads all files again.
    virtual void reload() = 0;
    /// Moves the camera so that it shows the whole plant or forest.
    virtual void frame_all() = 0;
    /// Moves the camera to a standard view of the whole plant or forest.
    virtual void show_from(StandardView view) {
        camera() = seen_from(view, camera());
        frame_all();
    }
    /// Path of the grammar or scene that is shown; empty in the start view.
    [[nodiscard]] virtual const std::string& path() const = 0;
    [[nodiscard]] virtual Camera& camera() = 0;
    /// Whether a forest is shown.
    [[nodiscard]] virtual bool is_forest() const { return false; }
    /// Whether the plant or forest can grow, so that a film can show its growth.
    [[nodiscard]] virtual bool has_growth() const { return false; }
    /// Whether there are changes that save() writes to the file.
    [[nodiscard]] virtual bool is_unsaved() const { return false; }
    /// Writes the changes to the file and reports the result in a note. If this fails, the changes
    /// stay unsaved.
    virtual void save() {}

    /// Starts to describe the part that a pixel of the last picture shows. picked() returns the
    /// description once it is made; then a trace of the part's module begins.
    void pick(const PicturePixel& pixel);
    /// Description of the part that was picked last; it has no lines if nothing was picked.
    [[nodiscard]] const Description& picked() const { return picked_; }
    /// Number of descriptions made so far.
    [[nodiscard]] std::uint64_t pick_count() const { return pick_count_; }
    void forget_picked();
    /// Starts to trace the module that was picked last. traced() returns the trace once it is made.
    /// Does nothing without a module.
    void trace(TraceScope scope);
    /// Scope of the last trace, which is also used for the first trace of the next module.
    [[nodiscard]] TraceScope trace_scope() const { return trace_scope_; }
    /// Trace of the module that was picked last, in lines; empty if there is no trace, or no trace
    /// yet.
    [[nodiscard]] const std::vector<TextLine>& traced() const { return traced_; }
    /// Whether the trace of the module that was picked last is shown or being made.
    [[nodiscard]] bool shows_trace() const { return wants_trace_; }
    void forget_trace();

    /// Adds a sample to each pixel of the last picture. Precondition: the picture is up to date, as
    /// draw() has just returned false. Returns whether it drew.
    [[nodiscard]] bool refine() {
        return frame_ && frame_->samples > 1 && !changed_ && renderer_->refine();
    }
    /// Copies the last picture to a part of the window whose OpenGL context is current.
    void present(const PixelArea& area) { renderer_->present(area); }
    /// Writes the last picture to a new file in the current folder and reports its name.
    void write_screenshot();
    /// Draws the last picture again with the size and the samples of `settings`, writes it to
    /// settings.path(), and reports the result in a note. After this, draw() draws the picture of
    /// the window again.
    void write_picture(const PictureSettings& settings);
    /// Options with which run_pictures() draws the plant or forest that is shown, at rest, with the
    /// camera of the window. A film of growth ends at the last generation or year.
    [[nodiscard]] virtual ViewOptions picture_options(FilmKind kind) const = 0;
    /// Width and height of the last picture, pixels; 0 before the first one.
    [[nodiscard]] std::uint32_t picture_width() const { return frame_ ? frame_->width : 0; }
    [[nodiscard]] std::uint32_t picture_height() const { return frame_ ? frame_->height : 0; }
    void set_note(const std::string& note);
    /// Removes the note if it has been shown for kNoteTime. Returns whether it did.
    bool drop_old_note(SteadyClock::time_point now);

    /// Messages of the last request, formatted as `lsc` does.
    [[nodiscard]] const std::string& messages() const { return text_; }
    /// Messages of the last request, of shaders and of OpenGL.
    [[nodiscard]] std::string all_messages() const;
    /// Messages of the last request, one by one.
    [[nodiscard]] const std::vector<ShownMessage>& entries() const { return entries_; }
    /// The sources that the last request has read.
    [[nodiscard]] virtual LoadedSources loaded_sources() const = 0;
    /// Number of requests whose messages were taken. When it changes, loaded_sources() changes,
    /// too.
    [[nodiscard]] std::uint64_t taken_request_count() const { return taken_request_count_; }
    /// The file of the last request whose messages were taken.
    [[nodiscard]] const std::string& loaded_file() const { return loaded_file_; }
    /// Whether the last request failed.
    [[nodiscard]] bool failed() const { return failed_; }
    /// Error of shaders when they were last loaded; empty: none.
    [[nodiscard]] const std::string& shader_message() const { return shader_message_; }
    /// Last note, for example "wrote plant-1.png"; empty if it is old.
    [[nodiscard]] const std::string& note() const { return note_; }
    [[nodiscard]] const Console& console() const { return console_; }
    [[nodiscard]] const Renderer& renderer() const { return *renderer_; }

protected:
    /// The request that describes `picked`. Its member `describe` is empty if there is nothing to
    /// describe. Precondition: `picked` is not PickedKind::Nothing.
    [[nodiscard]] virtual PickRequest request_for(const Picked& picked) const = 0;
    /// Takes the results of picker_ and tracer_. Returns whether picked() or traced() changed.
    bool take_picked();
    /// Whether a pick or a trace is being made.
    [[nodiscard]] bool is_picking() const {
        return (picker_ != nullptr && picker_->is_busy()) ||
               (tracer_ != nullptr && tracer_->is_busy());
    }
    /// Sets the quality of the next pictures. If this fails, shows a note, and the old quality
    /// stays.
    void use_quality(Quality quality);
    /// Draws `frame` if something has changed. Returns whether it drew.
    bool draw_frame(Frame frame);
    /// Stores the messages of a request, and prints them if they differ from the messages before.
    void take_messages(const Messages& messages, bool succeeded);
    void request_shader_reload() { shaders_changed_ = true; }
    /// loaded_sources() with those members set that all views have.
    [[nodiscard]] LoadedSources common_sources() const;
    /// Reloads shaders if their files have changed. Returns whether messages changed.
    bool reload_shaders();
    [[nodiscard]] bool is_shader(const std::string& file) const;
    /// Appends the files of the shader folder to `files`.
    [[nodiscard]] std::vector<std::string> with_shader_files(std::vector<std::string> files) const;

    ViewOptions options_;
    Console console_;
    Renderer* renderer_;
    std::function<void()> wake_; // called on any thread when update() has work
    std::string shader_message_;
    std::vector<std::string> files_; // files that the last load has requested
    // Last picture.
    std::optional<Frame> frame_;
    FrameStats drawn_;               // statistics of the last picture
    float aspect_ = 1.0F;            // width / height
    std::optional<Quality> quality_; // the last quality passed to use_quality()
    bool changed_ = true;            // the next picture is drawn even if its frame equals frame_

private:
    std::string text_;                         // messages()
    std::vector<ShownMessage> entries_;        // entries()
    std::shared_ptr<const Messages> messages_; // of the last request
    std::string loaded_file_;
    std::uint64_t taken_request_count_ = 0;
    std::string note_;
    SteadyClock::time_point note_since_; // when note_ was set
    bool failed_ = false;                // the last request failed
    std::atomic<bool> shaders_changed_{false};
    bool take_trace(); // shows the trace that tracer_ has made

    Description picked_;
    std::uint64_t pick_count_ = 0;
    TraceFunction trace_function_;                 // traces the part that was picked last
    TraceScope trace_scope_ = TraceScope::Written; // scope of the next trace
    std::vector<TextLine> traced_;
    bool wants_trace_ = false;            // trace() was called, and the trace is still wanted
    std::unique_ptr<TraceWorker> tracer_; // made by the first trace
    bool wants_picked_ = false;           // pick() was called, and the description is still wanted
    std::unique_ptr<PickWorker> picker_;  // made by the first pick
};

} // namespace lsys::view
