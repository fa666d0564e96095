// PlantView: what a window shows, without the window. Settings go in, as from sliders; files are
// watched, plants are made on other threads and exchanged between two pictures. A context has to
// be current whenever it is called.
#pragma once

#include "viewer/app/file_watch.h"
#include "viewer/app/plant_loader.h"
#include "viewer/app/plant_motion.h"
#include "viewer/app/view.h"
#include "viewer/gl/renderer.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

/// What a user can change while the plant is shown.
struct PlantViewSettings {
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
struct PlantViewStats {
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

class PlantView final : public View {
public:
    /// `wake` is called on any thread when update() has something to do.
    PlantView(const ViewOptions& options,
              const Console& console,
              Renderer& renderer,
              std::function<void()> wake);

    PlantViewSettings settings;

    bool update() override;
    bool draw(std::uint32_t width, std::uint32_t height) override;
    void shown(double draw_seconds) override;
    [[nodiscard]] bool is_busy() const override;
    void reload() override;
    void frame_all() override;
    [[nodiscard]] const std::string& file() const override { return settings.file; }
    [[nodiscard]] Camera& camera() override { return settings.camera; }

    /// Shows another file, all in view.
    void open(const std::string& file);
    /// Begins at the axiom if all is grown.
    void play_or_pause();

    /// The last plant without errors; none: there was none yet.
    [[nodiscard]] const PlantDocument* document() const { return document_.get(); }
    [[nodiscard]] const PlantViewStats& stats() const { return stats_; }
    /// How far the plant grows if nothing else is asked for.
    [[nodiscard]] std::uint32_t usual_generations() const;
    [[nodiscard]] std::uint32_t generations() const;

private:
    void take_outcome(LoadOutcome outcome);
    void swap(LoadOutcome outcome);
    void show_lines();
    void watch_files();
    void grow();
    void bend();
    void drop_unknown_definitions();
    [[nodiscard]] ViewOptions wanted() const;

    std::function<void()> wake_;

    std::shared_ptr<const PlantDocument> document_;
    LoadOutcome shown_outcome_;
    std::vector<std::string> files_;
    bool frames_next_ = false; // the next plant's view
    bool is_new_file_ = true;  // whose own damping counts
    bool tells_shown_ = false;
    PlantViewStats stats_;

    std::optional<PlantViewSettings> asked_; // of the last request
    LineKind shown_lines_ = LineKind::None;
    SteadyClock::time_point last_growth_;
    BentPlant bent_;
    std::optional<Bending> bending_; // of motion_
    std::unique_ptr<PlantMotion> motion_;
    PlantLoader loader_;
    FileWatch watch_; // goes first: it calls the loader
};

} // namespace lsys::view
