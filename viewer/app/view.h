// View: what every view of the window has: the last picture, what there is to say, the
// shaders. A context has to be current whenever it is called.
#pragma once

#include "grammar/base/outcome.h"
#include "runtime/program/console.h"
#include "viewer/app/options.h"
#include "viewer/gl/renderer.h"

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

/// A message of the overlay.
struct ShownMessage {
    Severity severity = Severity::Note;
    std::string head; // `file:line:column: severity: message [code]`
    std::string text; // the whole, with the lines of the source that it speaks of
};

class View {
public:
    View(const ViewOptions& options, const Console& console, Renderer& renderer);
    View(const View&) = delete;
    View& operator=(const View&) = delete;
    virtual ~View() = default;

    /// Between two pictures: takes what was made, asks for what the settings want. Returns whether
    /// there is something else to say.
    virtual bool update() = 0;
    /// Draws, unless the last picture would be the same. Returns whether it did.
    virtual bool draw(std::uint32_t width, std::uint32_t height) = 0;
    /// The last picture is seen; it took so long to draw.
    virtual void shown(double draw_seconds) = 0;
    /// Something is being made, grows or moves: update() is to be called soon.
    [[nodiscard]] virtual bool is_busy() const = 0;
    /// Reads all files again.
    virtual void reload() = 0;
    /// All is in view.
    virtual void frame_all() = 0;
    [[nodiscard]] virtual const std::string& file() const = 0;
    [[nodiscard]] virtual Camera& camera() = 0;
    /// There is something that no file holds.
    [[nodiscard]] virtual bool is_unsaved() const { return false; }

    /// Copies the last picture to this part of the window whose context is current.
    void present(const PixelArea& area) { renderer_->present(area); }
    /// Writes the last picture under a name that is free; says so.
    void write_screenshot();
    void say(const std::string& note);

    /// The messages of the last request, as `lsc` prints them.
    [[nodiscard]] const std::string& messages() const { return text_; }
    /// The same one by one.
    [[nodiscard]] const std::vector<ShownMessage>& entries() const { return entries_; }
    /// It could not be shown.
    [[nodiscard]] bool failed() const { return failed_; }
    [[nodiscard]] const std::string& shader_message() const { return shader_message_; }
    /// What was done last, as "wrote plant-1.png".
    [[nodiscard]] const std::string& note() const { return note_; }
    [[nodiscard]] const Renderer& renderer() const { return *renderer_; }

protected:
    /// As draw().
    bool draw_frame(const Frame& frame);
    /// Keeps the messages of a request; prints them unless they are those of the last one.
    void take_messages(const Messages& messages, bool fine);
    void ask_for_shaders() { shaders_changed_ = true; }
    /// If they have changed. Returns whether there is something to say.
    bool reload_shaders();
    [[nodiscard]] bool is_shader(const std::string& file) const;
    /// With the shaders.
    [[nodiscard]] std::vector<std::string> watched(std::vector<std::string> files) const;

    ViewOptions options_;
    Console console_;
    Renderer* renderer_;
    std::string shader_message_;
    // The last picture.
    std::optional<Frame> frame_;
    FrameStats drawn_;
    float aspect_ = 1.0F;
    bool changed_ = true;

private:
    std::string text_;
    std::vector<ShownMessage> entries_;
    std::string note_;
    bool failed_ = false;
    std::atomic<bool> shaders_changed_{false};
};

} // namespace lsys::view
