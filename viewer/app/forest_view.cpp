// SPDX-License-Identifier: MIT
#include "viewer/app/forest_view.h"

#include "runtime/forest/surroundings.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/program/files.h"
#include "runtime/scene/season.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsys::view {

namespace {

// Time in s for baking of impostors between two events of the window.
constexpr double kBakeTime = 0.02;
// Max number of trees expanded into branches per picture, so that a flying camera does not stutter.
constexpr std::uint32_t kMaxExpansions = 1000;
// Max number of trees of a streamed forest that a picture shows for the first time, so that a
// flying camera does not stutter.
constexpr std::uint64_t kMaxNewTrees = 16'384;
// Time in s to draw a picture above which pictures have reduced quality while the camera moves.
constexpr double kSlowPicture = 0.12;
// Time in s without motion after which the picture is drawn again at full quality.
constexpr double kRest = 0.25;
constexpr std::uint64_t kMinTriangles = 20'000; // min of max_coarse_triangles_

ForestViewSettings first_forest_settings(const ViewOptions& options) {
    ForestViewSettings settings;
    settings.shadows = options.shadows;
    settings.figure = options.figure;
    settings.antialiasing = options.samples > 1;
    settings.quality = options.quality;
    settings.wireframe = options.style == PlantStyle::Wireframe;
    settings.colours = options.colours;
    settings.windy = options.wind.has_value();
    settings.wind = options.wind.value_or(Wind{{5.0F, 0.0F, 0.0F}, 0.5F});
    settings.max_triangles = options.max_triangles;
    settings.visibility = options.visibility;
    settings.light = options.light;
    settings.senses = options.senses;
    return settings;
}

} // namespace

std::vector<CacheStats> cache_stats(const Forest& forest) {
    std::vector<CacheStats> numbers;
    for (const ForestSpecies& species : forest.species) {
        for (std::size_t i = 0; i < species.stages.size(); ++i) {
            const ForestStage& stage = species.stages[i];
            CacheStats& each = numbers.emplace_back();
            each.species = species.name;
            if (species.senses_surroundings) {
                each.species += fmt::format(" ({})", kSurroundingsNames[i % kSurroundings]);
            }
            each.generations = stage.generations;
            each.heroes = stage.cache.heroes;
            each.keys = stage.cache.slots.size();
            each.branches = stage.cache.instances.size();
            each.bytes = stage.cache.byte_count();
            for (const InstanceSlot& slot : stage.cache.slots) {
                each.hits += slot.hits;
                each.misses += slot.misses;
                each.dropped += slot.dropped;
            }
        }
    }
    return numbers;
}

ForestView::ForestView(const ViewOptions& options,
                       const Console& console,
                       Renderer& renderer,
                       std::function<void()> wake)
    : View(options, console, renderer, std::move(wake)), settings(first_forest_settings(options)),
      painting_(renderer), plays_next_(options.grow), history_(settings),
      loader_(
          [this](const ForestRequest& request, const std::atomic<bool>& cancelled) {
              return make_forest(request, cancelled, progress_);
          },
          wake_),
      watch_(FileWatch::Options{},
             [this](const std::vector<std::string>& files, SteadyClock::time_point changed_at) {
                 files_changed(files, changed_at);
             }) {
    files_ = options_.files;
    watch_files();
    renderer_->colour_branches(shown_colours_);
    renderer_->show_senses({}); // removes what another view has drawn
}

ForestView::~ForestView() {
    streamer_.reset();
    renderer_->show_lines({});
    renderer_->show_senses({});
    renderer_->show_plant(Mesh{}); // replaces the forest, which document_ owns
}

/// Called on the file watch's thread.
void ForestView::files_changed(const std::vector<std::string>& files,
                               SteadyClock::time_point changed_at) {
    const auto shaders = std::count_if(files.begin(), files.end(),
                                       [this](const std::string& each) { return is_shader(each); });
    if (shaders != 0) {
        request_shader_reload();
        wake_();
    }
    if (static_cast<std::size_t>(shaders) == files.size()) {
        return;
    }
    if (files.size() == 1) {
        const std::lock_guard lock(saved_mutex_);
        const Result<std::string> text = read_file(files.front(), {kMaxSourceBytes}, console_);
        if (!saved_text_.empty() && text && text.value() == saved_text_) {
            return; // save() has written this change
        }
        saved_text_.clear();
    }
    loader_.repeat(changed_at);
}

LoadedSources ForestView::loaded_sources() const {
    LoadedSources loaded = common_sources();
    loaded.files = files_;
    return loaded;
}

void ForestView::watch_files() {
    watch_.watch(with_shader_files(files_));
}

std::uint32_t ForestView::default_years() const {
    return default_years_;
}

std::uint32_t ForestView::years() const {
    return settings.edits.years.value_or(unedited_years_);
}

void ForestView::set_years(std::uint32_t years) {
    settings.edits.years = years;
    settings.plays = false;
    if (grown_) {
        grown_.reset();
        requested_.reset(); // else it equals the edits, and update() requests nothing
    }
}

bool ForestView::update() {
    bool has_new_content = false;
    if (reload_shaders()) {
        has_all_impostors_ = false;
        watch_files();
        has_new_content = true;
    }
    if (std::optional<ForestOutcome> outcome = loader_.take()) {
        take_outcome(std::move(*outcome));
        has_new_content = true;
    }
    has_new_content = take_picked() || has_new_content;
    show_colours();
    if (!has_all_impostors_ && document_ != nullptr) {
        const bool had_stand_ins = renderer_->has_stand_ins();
        has_all_impostors_ = renderer_->bake_impostors(kBakeTime);
        changed_ = changed_ || has_all_impostors_ || renderer_->has_stand_ins() != had_stand_ins;
    }
    grow();
    if (document_ != nullptr) {
        settings.camera = above_ground(settings.camera, *document_->grown.terrain);
    }
    show_outline();
    show_senses();
    if (requested_ != settings.edits) {
        request_load();
    }
    return has_new_content;
}

void ForestView::show_colours() {
    if (document_ == nullptr || settings.colours == shown_colours_) {
        return;
    }
    shown_colours_ = settings.colours;
    legend_ = legend_of(document_->model, shown_colours_);
    renderer_->colour_branches(shown_colours_);
    has_all_impostors_ = false;
    changed_ = true;
}

PickRequest ForestView::request_for(const Picked& picked) const {
    if (document_ == nullptr) {
        return {};
    }
    PickRequest request;
    std::vector<std::uint32_t> trees_of_form;
    if (picked.kind == PickedKind::Branch) {
        trees_of_form = renderer_->trees_of(picked.form);
    }
    request.describe = [picked, trees_of_form = std::move(trees_of_form), document = document_,
                        file = document_->files.front()](const Project& project) {
        return view::describe(picked, trees_of_form, *document, file, project);
    };
    return request;
}

ViewOptions ForestView::picture_options(FilmKind kind) const {
    ViewOptions wanted = options_;
    wanted.edits = settings.edits;
    if (kind == FilmKind::Growth) {
        wanted.edits.years.reset();
    }
    wanted.camera = to_text(settings.camera);
    wanted.shadows = settings.shadows;
    wanted.figure = settings.figure;
    wanted.style = settings.wireframe ? PlantStyle::Wireframe : PlantStyle::Surface;
    wanted.colours = settings.colours;
    wanted.light = settings.light;
    wanted.senses = settings.senses;
    wanted.max_triangles = settings.max_triangles;
    if (settings.visibility) {
        wanted.visibility = static_cast<float>(*settings.visibility);
    }
    if (settings.windy) {
        wanted.wind = settings.wind;
    }
    return wanted;
}

void ForestView::request_load() {
    requested_ = settings.edits;
    // After an error, read all files again: the cause may lie in any of them.
    const bool is_known = !failed() && document_ != nullptr && document_->files.front() == path();
    loader_.request({options_, settings.edits, is_known ? document_ : nullptr, SteadyClock::now()});
}

void ForestView::take_outcome(ForestOutcome outcome) {
    if (outcome.request.options.files != options_.files) {
        return; // a newer request is running
    }
    const bool succeeded = outcome.document != nullptr;
    take_messages(outcome.messages, succeeded);
    if (succeeded) {
        files_ = outcome.files;
        swap(std::move(outcome));
    } else {
        settings.plays = false;
        for (const std::string& file : outcome.files) {
            if (std::find(files_.begin(), files_.end(), file) == files_.end()) {
                files_.push_back(file);
            }
        }
    }
    watch_files();
}

void ForestView::swap(ForestOutcome outcome) {
    const SteadyClock::time_point start = SteadyClock::now();
    const std::shared_ptr<ForestDocument> before = document_;
    const std::shared_ptr<ForestDocument> document = std::move(outcome.document);
    const Camera first_camera = first_view(*document, aspect_);
    streamer_.reset();
    if (Result<void> shown = renderer_->show_forest(document->model); !shown) {
        shader_message_ = shown.error().message;
        console_.error(shader_message_);
        return;
    }
    document_ = document;
    shown_options_ = outcome.request.options;
    shown_edits_ = outcome.request.edits;
    if (document_->squares != nullptr) {
        streamer_ = std::make_unique<ForestStreamer>(
            *document_, options_.stream_bytes, streaming_threads(options_.run.threads), wake_);
    }
    grown_.reset();
    forget_picked();
    legend_ = legend_of(document_->model, shown_colours_);
    const bool opens_other_scene =
        before == nullptr || before->files.front() != document->files.front();
    if (opens_other_scene) {
        painting_.clear();
        steps_.clear();
        undone_.clear();
        history_ = EditHistory<ForestEdits>(settings);
    }
    has_all_impostors_ = false;
    if (std::exchange(frame_next_, false)) {
        settings.camera = with_parts(options_.camera, first_camera);
    }
    if (const std::string note = painting_.set_document(document_); !note.empty()) {
        set_note(note);
    }
    is_other_placement_ = outcome.request.edits.changes_placement() ||
                          outcome.request.options.overrides.changes_placement();
    const PlacementOptions& placement = document_->scene.placement;
    const bool dominates = placement.method == PlacementMethod::Domination;
    if (!dominates || !outcome.request.edits.years) {
        default_years_ = last_year(document_->scene);
    }
    if (!outcome.request.edits.years) {
        unedited_years_ = dominates ? placement.years : placement.stages_passed;
    }
    if (std::exchange(plays_next_, false)) {
        play_or_pause();
    }
    settings.brush.species = static_cast<std::uint16_t>(
        std::min<std::size_t>(settings.brush.species, document_->scene.species.size() - 1));
    if (opens_other_scene) {
        const PlacementSpecies& first = placement.species.front();
        settings.brush.min_scale = first.min_scale;
        settings.brush.max_scale = first.max_scale;
    }
    stats_.caches = cache_stats(document_->grown.forest);
    stats_.upload_seconds = seconds_since(start);
    stats_.make_seconds = outcome.seconds;
    changed_at_ = outcome.request.changed_at;
    stats_.swap_seconds = seconds_since(changed_at_);
    ++stats_.swaps;
    logs_next_frame_ = true;
    changed_ = true;
}

std::optional<StreamStats> ForestView::stream_stats() const {
    return streamer_ == nullptr ? std::nullopt : std::optional(streamer_->stats());
}

void ForestView::stream(Frame& frame) {
    if (streamer_ == nullptr) {
        return;
    }
    const StreamStep step = streamer_->step(frame.camera, frame.height, kMaxNewTrees);
    is_streaming_ = !step.is_ready;
    frame.tree_range = step.range;
    if (!step.changes.empty()) {
        renderer_->change_squares(step.changes);
        changed_ = true;
    }
}

bool ForestView::refuses_painting() {
    if (streamer_ != nullptr) {
        set_note("a forest that is streamed cannot be painted: its trees are not all held");
    }
    return streamer_ != nullptr;
}

bool ForestView::draw(std::uint32_t width, std::uint32_t height) {
    use_quality(settings.quality);
    Frame frame;
    frame.camera = settings.camera;
    frame.width = width;
    frame.height = height;
    frame.shadows = settings.shadows;
    frame.samples = settings.antialiasing ? 4 : 1;
    frame.temporal = settings.antialiasing;
    frame.style = settings.wireframe ? PlantStyle::Wireframe : PlantStyle::Surface;
    frame.max_triangles = settings.max_triangles;
    frame.max_expansions = kMaxExpansions;
    if (settings.windy) {
        frame.wind = settings.wind;
        frame.time = seconds_since(start_);
    }
    if (document_ != nullptr) {
        frame.light = forest_light(*document_, settings.visibility, settings.light);
        if (settings.figure) {
            frame.figure = figure_at(*document_, settings.camera);
        }
    }
    const bool moves = settings.windy || settings.plays || grown_ || used_tool_ ||
                       (frame_ && !(frame_->camera == frame.camera));
    if (moves) {
        last_motion_ = SteadyClock::now();
    } else if (is_slow_ && loader_.is_busy()) {
        return false; // draw the next forest instead
    }
    used_tool_ = false;
    stream(frame);
    is_coarse_ = is_slow_ && seconds_since(last_motion_) < kRest;
    if (is_coarse_) {
        frame.samples = 1;
        frame.max_triangles = std::min(frame.max_triangles, max_coarse_triangles_);
    }
    if (!draw_frame(frame)) {
        return false;
    }
    stats_.drawn = drawn_;
    changed_ = changed_ || renderer_->forest_stats().waiting_trees != 0;
    return true;
}

void ForestView::picture_shown(double draw_seconds) {
    stats_.draw_seconds = draw_seconds;
    if (!is_coarse_) {
        is_slow_ = draw_seconds > kSlowPicture;
    } else if (draw_seconds > kSlowPicture) {
        max_coarse_triangles_ = std::max(max_coarse_triangles_ / 2, kMinTriangles);
    } else if (draw_seconds < 0.25 * kSlowPicture) {
        max_coarse_triangles_ = std::min(max_coarse_triangles_ * 2, settings.max_triangles);
    }
    if (!std::exchange(logs_next_frame_, false)) {
        return;
    }
    stats_.shown_seconds = seconds_since(changed_at_);
    console_.detail(fmt::format(
        "loaded {}: {} trees of {} species, {:.0f} ms; reload {:.0f} ms, first frame {:.0f} ms",
        path(), tree_count(*document_), document_->scene.species.size(),
        kMillisecondsPerSecond * stats_.make_seconds, kMillisecondsPerSecond * stats_.swap_seconds,
        kMillisecondsPerSecond * stats_.shown_seconds));
}

bool ForestView::plays_smoothly() const {
    // Only domination has moments between years. Painting identifies trees by their numbers in a
    // whole year, so a painted forest is shown at whole years only.
    return !painting_.is_painted() && document_ != nullptr &&
           document_->scene.placement.method == PlacementMethod::Domination;
}

/// Shows the trees made by the growth thread (ForestFilm).
void ForestView::take_moment() {
    std::optional<ForestFilmMoment> film_moment = film_->take();
    if (!film_moment || film_moment->document != document_) {
        return;
    }
    if (film_moment->failed) {
        take_messages(film_moment->messages, false);
        settings.plays = false;
        grown_.reset();
        return;
    }
    document_->grown.forest.trees = std::move(film_moment->trees);
    grown_ = film_moment->moment;
    ++stats_.moments;
    renderer_->update_trees();
    static_cast<void>(painting_.set_document(document_));
    has_all_impostors_ = false;
    changed_ = true;
}

/// Ends playing and shows the forest of a whole year.
void ForestView::end_growth(std::uint32_t years) {
    settings.plays = false;
    grown_.reset();
    settings.edits.years = years;
    requested_.reset();
}

/// Requests the next moment of growth. A pause takes effect at the next whole year.
void ForestView::grow() {
    const SteadyClock::time_point now = SteadyClock::now();
    if ((!settings.plays && !grown_) || document_ == nullptr) {
        last_growth_ = now;
        if (film_ != nullptr) {
            static_cast<void>(film_->take()); // drops a moment of a growth that has ended
        }
        return;
    }
    if (!plays_smoothly()) {
        if (grown_) {
            end_growth(years());
            settings.plays = true;
        }
        grow_by_years();
        return;
    }
    if (film_ == nullptr) {
        film_ = std::make_unique<ForestFilm>(wake_);
    }
    take_moment();
    const bool is_up_to_date = requested_ == settings.edits && !loader_.is_busy();
    if (!is_up_to_date || failed() || film_->is_busy()) {
        last_growth_ = now;
        return;
    }
    constexpr double kMaxStep = 0.25; // s
    const double passed =
        std::min(std::chrono::duration<double>(now - last_growth_).count(), kMaxStep);
    last_growth_ = now;
    if (!grown_) {
        growth_position_ = static_cast<double>(years());
    }
    const double end =
        settings.plays ? static_cast<double>(default_years_) : std::ceil(growth_position_);
    if (grown_ && growth_position_ >= end) {
        end_growth(static_cast<std::uint32_t>(end));
        return;
    }
    growth_position_ =
        std::min(growth_position_ + passed * static_cast<double>(settings.years_per_second), end);
    const auto year = static_cast<std::uint32_t>(growth_position_);
    film_->request({document_,
                    default_years_,
                    options_.run,
                    {year, growth_position_ - std::floor(growth_position_)},
                    now,
                    false});
    settings.edits.years = year;
    requested_->years = year; // so that the loader does not make this year, too
}

void ForestView::grow_by_years() {
    const SteadyClock::time_point now = SteadyClock::now();
    const double passed = std::chrono::duration<double>(now - last_growth_).count();
    const double years_passed = passed * static_cast<double>(settings.years_per_second);
    const bool is_up_to_date = requested_ == settings.edits && !loader_.is_busy();
    if (!is_up_to_date || years_passed < 1.0) {
        return;
    }
    last_growth_ = now;
    // If pictures are slow, growth skips years.
    constexpr double kMaxYears = 1000.0;
    const auto next = years() + static_cast<std::uint32_t>(std::min(years_passed, kMaxYears));
    settings.plays = next < default_years_;
    settings.edits.years = std::min(next, default_years_);
}

void ForestView::play_or_pause() {
    if (streamer_ != nullptr) {
        set_note("a forest that is streamed does not grow");
        return;
    }
    if (default_years_ == 0) {
        set_note("only a forest placed by domination, or with stages of trees, can grow");
        return;
    }
    settings.plays = !settings.plays;
    if (settings.plays && years() >= default_years_) {
        settings.edits.years = 0;
    }
}

void ForestView::open(const std::string& file) {
    use_other_file(options_, file);
    settings.edits = {};
    settings.visibility.reset();
    settings.light = {};
    settings.figure = false;
    settings.plays = false;
    grown_.reset();
    grabbed_.reset();
    frame_next_ = true;
    files_ = {file};
    requested_.reset();
    watch_files();
}

void ForestView::reload() {
    loader_.repeat(SteadyClock::now());
    if (!options_.shaders.empty()) {
        request_shader_reload();
    }
}

void ForestView::frame_all() {
    settings.camera = streamer_ != nullptr ? first_view(*document_, aspect_)
                                           : framing(settings.camera, renderer_->bounds(), aspect_);
}

void ForestView::show_from(StandardView view) {
    if (streamer_ == nullptr) {
        View::show_from(view);
    } else {
        settings.camera = seen_from(view, settings.camera); // no view can show the whole forest
    }
}

std::optional<glm::dvec3> ForestView::ground_at(const glm::vec2& place) {
    const Camera& camera = settings.camera;
    return painting_.pick(
        {glm::dvec3(camera.eye), glm::dvec3(direction_at(camera, place.x, place.y))});
}

void ForestView::hover(const glm::vec2& place) {
    pointed_ = place;
}

void ForestView::show_outline() {
    std::optional<glm::dvec3> place;
    if (settings.tool != PaintTool::None && document_ != nullptr && streamer_ == nullptr) {
        if (!pointed_) {
            return; // the old outline stays
        }
        place = ground_at(*pointed_);
    }
    pointed_.reset();
    if (place) {
        const float radius = settings.tool == PaintTool::OneTree ? 0.0F : settings.brush.radius;
        renderer_->show_lines(
            painting_.outline(*place, radius, settings.tool == PaintTool::Eraser));
        changed_ = true;
    } else if (has_outline_) {
        renderer_->show_lines({});
        changed_ = true;
    }
    has_outline_ = place.has_value();
}

void ForestView::apply_tool(const glm::vec2& place, bool begins, bool erases) {
    if (refuses_painting()) {
        return;
    }
    begins_stroke_ = begins_stroke_ || begins;
    if (grown_) {
        end_growth(years());
        set_note("growth stops at a whole year for painting");
        return;
    }
    if (const std::optional<glm::dvec3> ground = ground_at(place)) {
        painting_.move_tool(*ground, std::exchange(begins_stroke_, false),
                            erases ? PaintTool::Eraser : settings.tool, settings.brush);
        has_stroke_ = true;
        used_tool_ = true;
        changed_ = true;
    }
}

std::string ForestView::painted_text(const char* what) const {
    const auto trees = [](std::uint64_t count) {
        return fmt::format("{} {}", count, count == 1 ? "tree" : "trees");
    };
    const PaintCount& count = painting_.count();
    return fmt::format("{}added {}, removed {}; {}", what, trees(count.added), count.removed,
                       trees(painting_.tree_count()));
}

void ForestView::end_stroke() {
    begins_stroke_ = false;
    if (std::exchange(has_stroke_, false)) {
        add_step(StepKind::Painting);
        set_note(painted_text(""));
    }
}

void ForestView::add_step(StepKind kind) {
    steps_.push_back(kind);
    undone_.clear();
}

void ForestView::record_edits() {
    if (!settings.plays && !grabbed_ && history_.record(settings)) {
        add_step(StepKind::Settings);
    }
}

bool ForestView::move_step(std::vector<StepKind>& from, std::vector<StepKind>& to, bool redoes) {
    if (from.empty()) {
        return false;
    }
    const StepKind kind = from.back();
    from.pop_back();
    to.push_back(kind);
    if (kind == StepKind::Settings) {
        settings.plays = false;
        static_cast<ForestEdits&>(settings) = redoes ? history_.redo() : history_.undo();
        return true;
    }
    redoes ? painting_.redo() : painting_.undo();
    changed_ = true;
    set_note(painted_text(redoes ? "redo: " : "undo: "));
    return true;
}

void ForestView::undo() {
    record_edits();
    if (!move_step(steps_, undone_, false)) {
        set_note("Nothing to undo");
    }
}

void ForestView::redo() {
    record_edits();
    if (!move_step(undone_, steps_, true)) {
        set_note("Nothing to redo");
    }
}

bool ForestView::is_unsaved() const {
    return painting_.is_unsaved() ||
           (settings.edits.season && document_ != nullptr && is_scene(document_->files.front()));
}

/// Precondition: settings.edits.season is set.
Result<void> ForestView::save_season(const std::string& scene) {
    const Result<std::string> before = read_file(scene, {kMaxSourceBytes}, console_);
    if (!before) {
        return before.error();
    }
    Result<std::string> text = with_season(before.value(), *settings.edits.season);
    if (!text) {
        return text.error();
    }
    if (Result<void> written = write_file(scene, text.value(), console_); !written) {
        return written;
    }
    saved_text_ = std::move(text.value());
    settings.edits.season.reset();
    options_.overrides.season.reset(); // the file has the value
    return {};
}

void ForestView::save() {
    if (!settings.edits.season && refuses_painting()) {
        return;
    }
    if (document_ == nullptr) {
        set_note("no forest to save yet");
        return;
    }
    // path() may be another scene, which is still loading or has errors.
    const std::string& scene = document_->files.front();
    if (!is_scene(scene)) {
        set_note("this forest has no scene file to save to");
        return;
    }
    const std::lock_guard lock(saved_mutex_);
    Result<void> saved = painting_.save(scene, console_);
    if (saved) {
        saved_text_ = painting_.saved_text();
    }
    if (saved && settings.edits.season) {
        saved = save_season(scene);
    }
    if (!saved) {
        set_note(fmt::format("not saved: {}", saved.error().message));
        return;
    }
    // The scene file identifies erased trees by number only.
    const bool is_doubtful = is_other_placement_ && painting_.has_erased();
    set_note(fmt::format("saved {}{}", scene,
                         is_doubtful ? "; but erased trees are saved by number, and the placement "
                                       "in the file may give these numbers to other trees"
                                     : ""));
}

std::optional<MakingState> ForestView::making() const {
    return loader_.has_run_for(kProgressDelay) ? std::optional(progress_.state()) : std::nullopt;
}

void ForestView::cancel_making() {
    loader_.cancel();
    if (document_ == nullptr) {
        set_note("Cancelled: no forest is shown");
        return;
    }
    if (document_->files.front() != options_.file) {
        options_ = shown_options_;
        files_ = document_->files;
        frame_next_ = false;
        watch_files();
    }
    settings.edits = shown_edits_;
    requested_ = settings.edits;
    set_note("Cancelled: the last forest is shown");
}

bool ForestView::is_busy() const {
    return loader_.is_busy() || settings.plays || grown_ || settings.windy || !has_all_impostors_ ||
           is_coarse_ || is_picking() || is_streaming_;
}

} // namespace lsys::view
