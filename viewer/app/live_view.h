// LiveView: what a window shows, without the window. Settings go in, as from sliders; files are
// watched, plants are made on other threads and exchanged between two pictures. A context has to
// be current whenever it is called.
#pragma once

#include "runtime/cli/console.h"
#include "viewer/app/file_watch.h"
#include "viewer/app/options.h"
#include "viewer/app/plant_loader.h"
#include "viewer/app/plant_motion.h"
#include "viewer/renderer.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

/// What a user can change while the plant is shown.
struct LiveSettings {
    // What the plant is made of: another one is made when these change.
    std::string file;
    std::vector<Definition> definitions; // instead of constants of the grammar
    std::optional<std::uint32_t> generations;
    std::optional<std::uint64_t> seed;
    MeshOptions mesh;

    // How it is shown.
    Camera camera;
    PlantStyle style = PlantStyle::Surface;
    LineKind lines = LineKind::None;
    bool shadows = true;
    bool ground = true;
    bool smooth = true; // edges, by several samples of a pixel

    bool bends = false;
    Bending bending;

    bool grows = false;
    float generations_per_second = 2.0F;
};

/// Of the plant that is shown.
struct LiveStats {
    double upload_seconds = 0.0;
    double make_seconds = 0.0;  // of all that the loader does
    double swap_seconds = 0.0;  // from the change to the exchange
    double shown_seconds = 0.0; // from the change until it was seen
    double draw_seconds = 0.0;  // of the last picture
    double bend_seconds = 0.0;  // of its last moment
    double bend_time = 0.0;     // s, of the physics
    FrameStats drawn;
    std::uint64_t swaps = 0;
};

class LiveView {
public:
    /// `wake` is called on any thread when update() has something to do.
    LiveView(const ViewOptions& options,
             const lsc::Console& console,
             Renderer& renderer,
             std::function<void()> wake);

    LiveSettings settings;

    /// Between two pictures: takes what was made, asks for what the settings want. Returns whether
    /// there is something else to say.
    bool update();
    /// Draws, unless the last picture would be the same. Returns whether it did.
    bool draw(std::uint32_t width, std::uint32_t height);
    /// Copies the last picture to this part of the window whose context is current.
    void present(const PixelArea& area) { renderer_->present(area); }
    /// The last picture is seen; it took so long to draw.
    void shown(double draw_seconds);

    /// Shows another file, all in view.
    void open(const std::string& file);
    /// Reads all files again.
    void reload();
    /// All is in view.
    void frame_all();
    /// Begins at the axiom if all is grown.
    void play_or_pause();
    /// Writes the last picture under a name that is free; says so.
    void write_screenshot();

    /// Something is being made, grows or moves: update() is to be called soon.
    [[nodiscard]] bool is_busy() const;
    /// The last plant without errors; none: there was none yet.
    [[nodiscard]] const PlantDocument* document() const { return document_.get(); }
    [[nodiscard]] const LiveStats& stats() const { return stats_; }
    /// What `lsc` says of what was asked for last.
    [[nodiscard]] const std::string& messages() const { return messages_; }
    /// It could not be shown.
    [[nodiscard]] bool failed() const { return failed_; }
    [[nodiscard]] const std::string& shader_message() const { return shader_message_; }
    /// What was done last, as "wrote plant-1.png".
    [[nodiscard]] const std::string& note() const { return note_; }
    [[nodiscard]] const Renderer& renderer() const { return *renderer_; }
    /// How far the plant grows if nothing else is asked for.
    [[nodiscard]] std::uint32_t usual_generations() const;
    [[nodiscard]] std::uint32_t generations() const;

private:
    void take_outcome(LoadOutcome outcome);
    void swap(LoadOutcome outcome);
    void show_lines();
    void reload_shaders();
    void watch_files();
    void grow();
    void bend();
    bool drop_unknown_definitions(const PlantDocument& document);
    [[nodiscard]] ViewOptions wanted() const;
    void say(const std::string& note);

    ViewOptions options_;
    lsc::Console console_;
    Renderer* renderer_;
    std::function<void()> wake_;

    std::shared_ptr<const PlantDocument> document_;
    LoadOutcome shown_outcome_;
    std::vector<std::string> files_;
    std::string messages_;
    std::string shader_message_;
    std::string note_;
    bool failed_ = false;
    bool frames_next_ = false; // the next plant's view
    bool is_new_file_ = true;  // whose own damping counts
    bool tells_shown_ = false;
    LiveStats stats_;

    std::optional<LiveSettings> asked_; // of the last request
    LineKind shown_lines_ = LineKind::None;
    SteadyClock::time_point last_growth_;
    BentPlant bent_;
    std::optional<Bending> bending_; // of motion_
    float aspect_ = 1.0F;

    // The last picture.
    std::optional<Frame> frame_;
    bool changed_ = true;

    std::atomic<bool> shaders_changed_{false};
    std::unique_ptr<PlantMotion> motion_;
    PlantLoader loader_;
    FileWatch watch_; // goes first: it calls the loader
};

} // namespace lsys::view
