// SPDX-License-Identifier: MIT
// PlantView: the state of a window that shows a plant; usable without a window. Watches files.
// Plants are made on other threads and replace the shown plant between two frames. Every call needs
// a current OpenGL context.
#pragma once

#include "runtime/pipeline/value_edits.h"
#include "viewer/app/edit_history.h"
#include "viewer/app/file_edits.h"
#include "viewer/app/file_watch.h"
#include "viewer/app/plant_export.h"
#include "viewer/app/plant_film.h"
#include "viewer/app/plant_loader.h"
#include "viewer/app/plant_motion.h"
#include "viewer/app/sense_view.h"
#include "viewer/app/view.h"
#include "viewer/gl/renderer.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys::view {

/// Values from which the plant of a file is made; a change makes a new plant.
struct PlantSource {
    std::vector<Definition> definitions;      // replace constants of the grammar
    std::vector<SettingText> set_values;      // replace `#set` statements of the grammar
    std::optional<std::uint32_t> generations; // unset: default_generations()
    std::optional<std::uint64_t> seed;        // unset: the value of #set seed
    MeshOptions mesh;
    std::vector<EnvironmentMove> moves; // displacements of obstacles; save() does not write them

    friend bool operator==(const PlantSource&, const PlantSource&) = default;
};

/// Settings that decide how a plant is drawn.
struct PlantLook {
    PlantStyle style = PlantStyle::Surface;
    LineKind lines = LineKind::None;
    bool shadows = true;
    bool ground = true;
    bool dims = true;    // surfaces fade while lines are drawn
    bool figure = false; // a person of 1.8 m beside the plant
    bool antialiasing = true;
    Quality quality = Quality::Auto;
    SceneLight light; // values that replace the default daylight
    SenseLook senses;

    friend bool operator==(const PlantLook&, const PlantLook&) = default;
};

/// Settings of the user that undo() takes back.
struct PlantEdits : PlantSource, PlantLook {
    bool simulates = false; // gravity and wind move the plant
    Bending bending;
    std::size_t file_steps = 0; // number of applied changes of files, FileEdits::position()

    friend bool operator==(const PlantEdits& a, const PlantEdits& b);
};

/// Settings of the user.
struct PlantViewSettings : PlantEdits {
    std::string file;
    Camera camera;
    bool plays = false; // growth
    float generations_per_second = 2.0F;

    ExportSettings output;
};

/// Statistics of the plant that is shown.
struct PlantViewStats {
    double upload_seconds = 0.0; // time of the swap
    double make_seconds = 0.0;   // all work of the loader
    double swap_seconds = 0.0;   // from the change of a file to the swap
    double shown_seconds = 0.0;  // from the change to the first picture on screen
    double draw_seconds = 0.0;   // time to draw the last picture
    double bend_seconds = 0.0;   // time to make the last moment of the simulation
    double bend_time = 0.0;      // s, simulated time
    std::uint64_t moments = 0;   // count of moments of growth shown
    FrameStats drawn;            // of the last picture
    std::uint64_t swaps = 0;     // count of plants shown
};

class PlantView final : public View {
public:
    /// `wake` is called on any thread when update() has work.
    PlantView(const ViewOptions& options,
              const Console& console,
              Renderer& renderer,
              std::function<void()> wake);

    PlantViewSettings settings;

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
    [[nodiscard]] const std::string& path() const override { return settings.file; }
    [[nodiscard]] Camera& camera() override { return settings.camera; }

    [[nodiscard]] ViewOptions picture_options(FilmKind kind) const override;
    [[nodiscard]] bool has_growth() const override { return default_generations() != 0; }
    [[nodiscard]] LoadedSources loaded_sources() const override;

    /// Opens another file, and moves the camera so that it shows the whole plant.
    void open(const std::string& file);
    /// Plays or pauses growth. If all generations are shown, growth begins again at the axiom.
    void play_or_pause();
    /// Whether constants, settings or the seed differ from the values in the file.
    [[nodiscard]] bool has_changed_values() const;
    /// Whether constants, settings or the seed have changed since the file was opened or written.
    [[nodiscard]] bool is_unsaved() const override;
    /// Writes changed constants, settings and the seed to the .lsys file, leaves the other bytes of
    /// the file unchanged, and reports the result in a note. Refuses another dialect, a compiled
    /// grammar, a file that has changed on disk since it was read, values that are set in included
    /// files, and values that the shown plant does not have yet.
    void save() override;
    /// Writes changed files of the grammar, all or none, and reports `what` in a note; undo()
    /// restores the old files. Refuses files that have changed on disk.
    void change_files(std::vector<FileChange> changes, const std::string& what);
    /// Writes the plant that is shown, at rest, to settings.output.file on another thread, and
    /// reports the result in a note. Refuses while a moment between generations is shown.
    void export_shown();

    /// The last plant that was made without errors; null: none yet.
    [[nodiscard]] const PlantDocument* document() const { return document_.get(); }
    [[nodiscard]] const PlantViewStats& stats() const { return stats_; }
    /// Number of generations that the command line or the grammar sets, without the user's
    /// settings.
    [[nodiscard]] std::uint32_t default_generations() const;
    /// Number of generations to show: that of the user, else the default.
    [[nodiscard]] std::uint32_t generations() const;
    /// What the plant that is shown has sensed; null if it senses nothing.
    [[nodiscard]] const SensedPlant* sensed() const;
    /// Grabs the obstacle at a place of the picture, given in half picture heights to the right and
    /// up from the centre. Returns whether there is an obstacle.
    [[nodiscard]] bool grab_obstacle(const glm::vec2& place);
    /// Moves the grabbed obstacle to another place of the picture. The point at which it was
    /// grabbed moves in the plane that faces the camera.
    void drag_obstacle(const glm::vec2& place);
    void release_obstacle() { grabbed_.reset(); }
    [[nodiscard]] bool has_grabbed() const { return grabbed_.has_value(); }
    /// The moment of growth that is shown in place of document(); null if document() is shown.
    [[nodiscard]] const FilmMoment* grown() const { return shows_growth_ ? &grown_ : nullptr; }

protected:
    [[nodiscard]] PickRequest request_for(const Picked& picked) const override;

private:
    /// An obstacle that the mouse moves.
    struct GrabbedObstacle {
        std::string name;            // of its environment
        std::array<float, 3> move{}; // its displacement when it was grabbed, m
        double depth = 0.0;          // m, distance of the grabbed point along the view
        glm::dvec3 place{};          // the grabbed point, relative to the eye, m
    };

    void take_outcome(LoadOutcome outcome); // drops an outcome of another file
    void swap(LoadOutcome outcome);         // shows the new plant in place of the old one
    void show_lines();
    void show_senses();
    /// Displacements of environments since the shown plant grew.
    [[nodiscard]] std::vector<EnvironmentMove> new_moves() const;
    void watch_files();
    void start_growth();      // from the generation shown
    void grow();              // requests the next moment of growth
    void take_moment();       // shows the moment that film_ has made
    void widen_film_ground(); // widens film_ground_ for the moment shown; never narrows it
    /// Starts, changes or stops the simulation, and shows its latest moment.
    void bend();
    /// Adds a warning if the simulated plant falls under its weight. Returns whether messages
    /// changed.
    [[nodiscard]] bool check_standing();
    void drop_unknown_definitions(); // drops values of constants that the file lacks
    /// Undoes or repeats changes of files until they agree with PlantEdits::file_steps.
    void follow_file_steps();
    [[nodiscard]] ViewOptions options_with_settings() const; // options_ with the values of settings
    /// The bytes of the file with these values. Error: the plant shown is not that of the file on
    /// disk.
    [[nodiscard]] Result<std::string> text_with_values(const StatementValues& values) const;

    std::shared_ptr<const PlantDocument> document_;
    LoadOutcome shown_outcome_;    // of the request whose plant is shown
    PlantSource saved_;            // values when the file was opened or last saved
    bool frame_next_ = true;       // the next swap moves the camera to show the plant
    bool is_new_file_ = true;      // at the next swap, take the damping of the grammar
    bool logs_next_frame_ = false; // logs the times of the first picture of this plant
    PlantViewStats stats_;
    Bounds rest_bounds_; // bounds of document_ at rest

    std::optional<PlantViewSettings> requested_; // settings of the last request
    EditHistory<PlantEdits> history_;
    FileEdits file_edits_;
    LineKind shown_lines_ = LineKind::None;
    SenseLook shown_senses_;
    std::vector<EnvironmentMove> shown_moves_; // the shown PlantSource::moves
    std::optional<GrabbedObstacle> grabbed_;   // while the mouse holds an obstacle
    SteadyClock::time_point last_growth_;      // time of the last step of growth
    double growth_position_ = 0.0;             // generations
    bool plays_next_ = false;                  // growth starts to play at the next swap
    bool shows_growth_ = false;                // `grown_` is shown
    FilmMoment grown_;                         // moment of growth, if shows_growth_
    glm::vec4 film_ground_{0.0F};              // Frame::ground_disc while growth is shown
    std::unique_ptr<PlantFilm> film_;          // made when growth is first played
    BentPlant bent_;                           // latest moment of motion_
    MeshOptions bent_mesh_options_;            // options with which bent_ was meshed
    std::optional<Bending> bending_;           // settings of motion_
    std::unique_ptr<PlantMotion> motion_;      // null: nothing is simulated
    /// The last input of the worker that checks whether the plant stands.
    std::optional<Bending> checked_bending_;
    bool warns_of_fall_ = false;                        // the messages warn that the plant falls
    std::unique_ptr<StandingChecker> standing_checker_; // made by the first simulation
    std::unique_ptr<PlantExporter> exporter_;           // made by the first export
    std::string exported_file_;                         // file of the last export
    PlantLoader loader_;
    FileWatch watch_; // last member: it calls the loader
};

} // namespace lsys::view
