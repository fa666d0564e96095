// ForestView: what a window shows of a forest, without the window. The scene, its grammars and what
// they include are watched; forests are made on another thread and exchanged between two pictures.
#pragma once

#include "viewer/app/file_watch.h"
#include "viewer/app/forest_loader.h"
#include "viewer/app/forest_painting.h"
#include "viewer/app/view.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

inline constexpr float kMaxBrush = 500.0F; // m, its radius

/// What a user can change while the forest is shown.
struct ForestViewSettings {
    SceneOverrides edits; // after those of the command line; a change makes another forest

    Camera camera;
    bool shadows = true;
    bool smooth = true; // edges, by several samples of a pixel
    bool wireframe = false;
    bool windy = false; // it moves
    Wind wind;
    std::uint64_t max_triangles = 1'500'000;

    bool grows = false;
    float years_per_second = 5.0F;

    PaintTool tool = PaintTool::None;
    Brush brush;
};

/// Of what the heroes of one species with one number of generations are made of.
struct CacheNumbers {
    std::string species;
    std::uint32_t generations = 0;
    std::uint32_t heroes = 0;
    std::uint64_t keys = 0;
    std::uint64_t branches = 0; // that are kept
    std::uint64_t hits = 0;
    std::uint64_t misses = 0;
    std::uint64_t dropped = 0;
    std::uint64_t bytes = 0;
};

/// Of the forest that is shown.
struct ForestViewStats {
    double make_seconds = 0.0;   // of all that the loader does
    double upload_seconds = 0.0; // of the exchange
    double swap_seconds = 0.0;   // from the change to the exchange
    double shown_seconds = 0.0;  // from the change until it was seen
    double draw_seconds = 0.0;   // of the last picture
    FrameStats drawn;
    std::uint64_t swaps = 0;
    std::vector<CacheNumbers> caches;
};

class ForestView final : public View {
public:
    /// `wake` is called on any thread when update() has something to do.
    ForestView(const ViewOptions& options,
               const Console& console,
               Renderer& renderer,
               std::function<void()> wake);
    ~ForestView() override;

    ForestViewSettings settings;

    bool update() override;
    bool draw(std::uint32_t width, std::uint32_t height) override;
    void shown(double draw_seconds) override;
    [[nodiscard]] bool is_busy() const override;
    void reload() override;
    void frame_all() override;
    [[nodiscard]] const std::string& file() const override { return options_.file; }
    [[nodiscard]] Camera& camera() override { return settings.camera; }
    [[nodiscard]] bool is_unsaved() const override { return painting_.is_unsaved(); }

    /// Shows another scene, all in view.
    void open(const std::string& file);
    /// Begins at the first year if all has grown.
    void play_or_pause();
    void set_years(std::uint32_t years);
    [[nodiscard]] std::uint32_t years() const;
    /// How long the forest grows if nothing else is asked for; 0: it does not.
    [[nodiscard]] std::uint32_t usual_years() const;

    /// The tool is at a place of the last picture: from its middle, 1 is half its height, to the
    /// right and up.
    void point_at(const glm::vec2& place);
    /// It works there; `begins`: a stroke. An eraser whatever the tool is, if `erases`.
    void work_at(const glm::vec2& place, bool begins, bool erases);
    /// Says what the stroke has done, if there was one.
    void end_stroke();
    void undo();
    void redo();
    /// What was painted goes into the scene file; says so.
    void save();

    /// The last forest without errors; none: there was none yet.
    [[nodiscard]] const ForestDocument* document() const { return document_.get(); }
    [[nodiscard]] const ForestViewStats& stats() const { return stats_; }
    [[nodiscard]] const ForestPainting& painting() const { return painting_; }
    /// The last picture is of fewer triangles and samples than asked for, because something moves.
    [[nodiscard]] bool is_coarse() const { return is_coarse_; }
    /// Whether pictures of far trees are still being made.
    [[nodiscard]] bool has_impostors() const { return has_impostors_; }

private:
    void take_outcome(ForestOutcome outcome);
    void swap(ForestOutcome outcome);
    void show_outline();
    [[nodiscard]] std::string painted_text(const char* what) const;
    void watch_files();
    void grow();
    void ask();
    void files_changed(const std::vector<std::string>& files, SteadyClock::time_point since);
    [[nodiscard]] std::optional<glm::dvec3> ground_at(const glm::vec2& place);

    std::function<void()> wake_;
    std::shared_ptr<ForestDocument> document_;
    ForestPainting painting_;
    std::vector<std::string> files_;
    bool frames_next_ = false; // the next forest's view
    bool tells_shown_ = false;
    bool has_impostors_ = true;
    std::optional<SceneOverrides> asked_;
    std::uint32_t usual_years_ = 0;
    SteadyClock::time_point since_; // of the forest that is shown
    SteadyClock::time_point last_growth_;
    SteadyClock::time_point start_ = SteadyClock::now(); // of the wind
    std::optional<glm::vec2> pointed_;
    bool has_outline_ = false;
    bool begins_stroke_ = false; // where the mouse meets the ground next
    bool has_stroke_ = false;
    bool has_worked_ = false; // a tool, since the last picture
    bool is_slow_ = false;    // the last picture of all that was asked for
    bool is_coarse_ = false;
    std::uint64_t coarse_triangles_ = 200'000;
    SteadyClock::time_point last_motion_;
    ForestViewStats stats_;

    std::mutex saved_mutex_;
    std::string saved_text_; // as this view has written the scene itself
    ForestLoader loader_;
    FileWatch watch_; // goes first: it calls the loader
};

/// How a cache was filled, for each species and stage.
[[nodiscard]] std::vector<CacheNumbers> cache_numbers(const Forest& forest);

} // namespace lsys::view
