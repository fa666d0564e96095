// SPDX-License-Identifier: MIT
// ForestView: the state of a window that shows a forest; usable without a window. Watches the
// scene, its grammars and the files that these include. Forests are made on another thread and
// replace the shown forest between two frames.
#pragma once

#include "viewer/app/edit_history.h"
#include "viewer/app/file_watch.h"
#include "viewer/app/forest_film.h"
#include "viewer/app/forest_loader.h"
#include "viewer/app/forest_painting.h"
#include "viewer/app/forest_senses.h"
#include "viewer/app/forest_streamer.h"
#include "viewer/app/view.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

inline constexpr float kMaxBrush = 500.0F; // m, radius

/// Settings of the user that undo() takes back.
struct ForestEdits {
    SceneOverrides edits; // applied after options of the command line; a change makes a new forest

    bool shadows = true;
    bool figure = false; // show a person of 1.8 m where the camera looks
    bool antialiasing = true;
    Quality quality = Quality::Auto;
    bool wireframe = false;
    BranchColours colours = BranchColours::Natural;
    bool windy = false; // wind is on
    Wind wind;
    std::optional<double> visibility;        // km; empty: default_visibility()
    SceneLight light;                        // values that replace the scene's
    std::uint64_t max_triangles = 1'500'000; // max triangles of branches in a picture
    SenseLook senses;

    friend bool operator==(const ForestEdits&, const ForestEdits&) = default;
};

/// Settings of the user.
struct ForestViewSettings : ForestEdits {
    Camera camera;
    bool plays = false; // growth
    float years_per_second = 5.0F;

    PaintTool tool = PaintTool::None;
    Brush brush;
};

/// Statistics of one instance cache: the cache of a species at one stage.
struct CacheStats {
    std::string species;
    std::uint32_t generations = 0; // of the stage
    std::uint32_t heroes = 0;
    std::uint64_t keys = 0;     // pairs of a branch id and an age
    std::uint64_t branches = 0; // recorded branches, including whole plants
    std::uint64_t hits = 0;     // hits, misses and dropped: sums over the InstanceSlot of all keys
    std::uint64_t misses = 0;
    std::uint64_t dropped = 0;
    std::uint64_t bytes = 0; // InstanceCache::byte_count()
};

/// Statistics of the forest that is shown.
struct ForestViewStats {
    double make_seconds = 0.0;   // all work of the loader
    double upload_seconds = 0.0; // time of the swap
    double swap_seconds = 0.0;   // from the change of a file to the swap
    double shown_seconds = 0.0;  // from the change to the first picture on screen
    double draw_seconds = 0.0;   // time to draw the last picture
    FrameStats drawn;            // of the last picture
    std::uint64_t swaps = 0;     // count of forests shown
    std::uint64_t moments = 0;   // count of moments of growth shown
    std::vector<CacheStats> caches;
};

class ForestView final : public View {
public:
    /// `wake` is called on any thread when update() has work.
    ForestView(const ViewOptions& options,
               const Console& console,
               Renderer& renderer,
               std::function<void()> wake);
    ~ForestView() override;

    ForestViewSettings settings;

    bool update() override;
    bool draw(std::uint32_t width, std::uint32_t height) override;
    void picture_shown(double draw_seconds) override;
    [[nodiscard]] bool is_busy() const override;
    [[nodiscard]] std::optional<MakingState> making() const override;
    void cancel_making() override;
    void record_edits() override;
    void undo() override;
    void redo() override;
    void reload() override;
    void frame_all() override;
    void show_from(StandardView view) override;
    [[nodiscard]] const std::string& path() const override { return options_.file; }
    [[nodiscard]] Camera& camera() override { return settings.camera; }
    [[nodiscard]] bool is_unsaved() const override;

    [[nodiscard]] ViewOptions picture_options(FilmKind kind) const override;
    [[nodiscard]] bool is_forest() const override { return true; }
    [[nodiscard]] bool has_growth() const override { return default_years() != 0; }
    [[nodiscard]] LoadedSources loaded_sources() const override;

    /// Opens another scene, and moves the camera so that it shows the whole forest.
    void open(const std::string& file);
    /// Plays or pauses growth. If all years are shown, growth begins again at the first year.
    void play_or_pause();
    void set_years(std::uint32_t years);
    /// Number of years to show: that of the user, else the default.
    [[nodiscard]] std::uint32_t years() const;
    /// Number of years that the scene grows, without edits of the user. For trees placed by stages,
    /// the number of stages; 0: the scene does not grow.
    [[nodiscard]] std::uint32_t default_years() const;

    /// Moves the tool to `place` in the last picture: to the right and up from its centre, in half
    /// picture heights.
    void hover(const glm::vec2& place);
    /// Applies the tool at `place`, in the units of hover(). `begins`: a stroke begins here.
    /// `erases`: the eraser is used in place of the chosen tool.
    void apply_tool(const glm::vec2& place, bool begins, bool erases);
    /// Ends a stroke and reports its changes.
    void end_stroke();
    /// Saves painted trees and the season in the file of the scene that is shown, and reports the
    /// result in a note. If a scene with errors was opened since, its file is not written.
    void save() override;

    /// Grabs the obstacle of a tree at a place of the picture, in the units of hover(). Returns
    /// false if there is none, or if a tool is chosen.
    [[nodiscard]] bool grab_obstacle(const glm::vec2& place);
    /// Moves the grabbed obstacle to another place of the picture, parallel to the picture: an edit
    /// of SpeciesOverrides::moves, with which the plants of the species grow again.
    void drag_obstacle(const glm::vec2& place);
    void release_obstacle() { grabbed_.reset(); }
    [[nodiscard]] bool has_grabbed() const { return grabbed_.has_value(); }

    /// The moment of growth shown; empty: the forest of a whole year is shown.
    [[nodiscard]] const std::optional<GrowthMoment>& grown() const { return grown_; }
    /// The last forest that was made without errors; null: none yet.
    [[nodiscard]] const ForestDocument* document() const { return document_.get(); }
    [[nodiscard]] const ForestViewStats& stats() const { return stats_; }
    /// Statistics of a streamed forest; nullopt for other forests.
    [[nodiscard]] std::optional<StreamStats> stream_stats() const;
    [[nodiscard]] const ForestPainting& painting() const { return painting_; }
    /// Whether the last picture had reduced quality because of motion.
    [[nodiscard]] bool is_coarse() const { return is_coarse_; }
    /// The colours of the branches and their meanings; empty while branches have natural colours.
    [[nodiscard]] const std::vector<LegendEntry>& legend() const { return legend_; }
    /// Whether all impostors are baked.
    [[nodiscard]] bool has_all_impostors() const { return has_all_impostors_; }

protected:
    [[nodiscard]] PickRequest request_for(const Picked& picked) const override;

private:
    /// An obstacle that the mouse moves.
    struct GrabbedObstacle {
        std::string species;
        std::string name;            // of its environment
        Tree tree;                   // the tree whose obstacle it is
        std::array<float, 3> move{}; // SpeciesOverrides::moves when it was grabbed, m
        double depth = 0.0;          // m along the view, from the eye to the grabbed point
        glm::dvec3 place{};          // m, the grabbed point relative to the eye
    };
    /// The state of the drawing of senses.
    struct ShownSenses {
        SenseLook look;
        SpeciesMoves moves;
        /// Counts of swaps, moments, trees and undo steps: if they are equal, no tree has changed.
        std::array<std::uint64_t, 4> content{};
        glm::dvec3 place{}; // target of the camera

        friend bool operator==(const ShownSenses&, const ShownSenses&) = default;
    };
    /// One step of undo() changes either settings or painted strokes.
    enum class StepKind : std::uint8_t { Settings, Painting };

    void add_step(StepKind kind); // a new step of undo()
    /// Undoes or repeats a step: moves the last step of `from` to `to`.
    bool move_step(std::vector<StepKind>& from, std::vector<StepKind>& to, bool redoes);
    void take_outcome(ForestOutcome outcome); // drops an outcome of another scene
    void swap(ForestOutcome outcome);         // shows the new forest in place of the old one
    void show_outline();                      // draws the outline of the tool at pointed_
    void show_senses();
    /// Displacements of environments since the shown forest grew.
    [[nodiscard]] SpeciesMoves new_moves() const;
    /// Shows and hides squares of a streamed forest for the camera of a frame.
    void stream(Frame& frame);
    /// Returns whether the forest is streamed. If so, shows a note that a streamed forest cannot be
    /// painted.
    bool refuses_painting();
    [[nodiscard]] Result<void> save_season(const std::string& scene); // settings.edits.season
    void show_colours(); // colours branches again if the setting has changed
    /// For notes: `what`, then counts of painted trees.
    [[nodiscard]] std::string painted_text(const char* what) const;
    void watch_files();
    void grow(); // requests the next moment of growth
    /// Whether growth can show moments between years.
    [[nodiscard]] bool plays_smoothly() const;
    void grow_by_years(); // growth without moments between years
    void take_moment();   // shows the trees that film_ has made
    /// Ends growth and shows the forest after `years` years.
    void end_growth(std::uint32_t years);
    void request_load(); // sends the settings to loader_
    /// Called on the thread of watch_.
    void files_changed(const std::vector<std::string>& files, SteadyClock::time_point changed_at);
    /// The ground below a place of the picture, in the units of hover().
    [[nodiscard]] std::optional<glm::dvec3> ground_at(const glm::vec2& place);

    std::shared_ptr<ForestDocument> document_;
    std::unique_ptr<ForestStreamer> streamer_; // streamer of document_; null: it is not streamed
    bool is_streaming_ = false;                // the last picture lacked some wanted squares
    ForestPainting painting_;
    bool frame_next_ = true;       // the next swap moves the camera to show the forest
    bool plays_next_ = false;      // growth starts to play at the next swap
    bool logs_next_frame_ = false; // logs the times of the first picture of this forest
    bool has_all_impostors_ = true;
    BranchColours shown_colours_ = BranchColours::Natural;
    std::vector<LegendEntry> legend_;
    std::optional<SceneOverrides> requested_; // edits of the last request to the loader
    EditHistory<ForestEdits> history_;
    std::vector<StepKind> steps_;         // oldest first
    std::vector<StepKind> undone_;        // the step that was undone first comes first
    std::uint32_t default_years_ = 0;     // default_years()
    std::uint32_t unedited_years_ = 0;    // years() while the user has not set the years
    bool is_other_placement_ = false;     // the placement differs from that of the scene file
    SteadyClock::time_point changed_at_;  // time of the change that led to the forest shown
    SteadyClock::time_point last_growth_; // time of the last step of growth
    double growth_position_ = 0.0;        // years
    std::optional<GrowthMoment> grown_;
    std::unique_ptr<ForestFilm> film_;                   // made when growth is first played
    SteadyClock::time_point start_ = SteadyClock::now(); // time 0 of the wind
    std::optional<glm::vec2> pointed_;        // last place of hover(), until update() shows it
    bool has_outline_ = false;                // the outline of the tool is shown
    std::optional<ShownSenses> shown_senses_; // empty: none are shown
    std::vector<Tree> sensing_trees_;         // trees whose senses are drawn
    std::optional<GrabbedObstacle> grabbed_;  // while the mouse holds an obstacle
    bool begins_stroke_ = false;              // begin a stroke at the next point on the ground
    bool has_stroke_ = false;                 // a stroke has begun and not ended
    bool used_tool_ = false;                  // a tool was applied since the last picture
    bool is_slow_ = false; // the last picture at full quality took longer than kSlowPicture
    bool is_coarse_ = false;
    std::uint64_t max_coarse_triangles_ = 200'000; // max triangles while is_coarse_
    SteadyClock::time_point last_motion_;          // when the picture last changed by motion
    ForestViewStats stats_;

    std::mutex saved_mutex_;     // guards saved_text_
    std::string saved_text_;     // text of the scene file as this view last wrote it
    ViewOptions shown_options_;  // options with which document_ was made
    SceneOverrides shown_edits_; // edits with which document_ was made
    MakingProgress progress_;
    ForestLoader loader_;
    FileWatch watch_; // last member: it calls the loader
};

/// Statistics of all caches, by species and stage.
[[nodiscard]] std::vector<CacheStats> cache_stats(const Forest& forest);

} // namespace lsys::view
