#include "viewer/app/live_forest.h"

#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/stopwatch.h"
#include "runtime/program/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lsys::view {

namespace {

constexpr double kMilliseconds = 1e3;
// So long pictures of far trees are made between two looks at what the user does, s.
constexpr double kPortraitTime = 0.02;
// Trees whose branches are made for one picture, so that a camera that flies does not halt.
constexpr std::uint32_t kMostExpansions = 1000;
// A picture that takes longer is drawn coarser while something moves, and again when all has been
// at rest for a while, s.
constexpr double kSlowPicture = 0.12;
constexpr double kRest = 0.25;
constexpr std::uint64_t kFewestTriangles = 20'000;

ForestSettings first_settings(const ViewOptions& options) {
    ForestSettings settings;
    settings.shadows = options.shadows;
    settings.smooth = options.samples > 1;
    settings.wireframe = options.style == PlantStyle::Wireframe;
    settings.windy = options.wind.has_value();
    settings.wind = options.wind.value_or(Wind{{5.0F, 0.0F, 0.0F}, 0.5F});
    settings.most_triangles = options.most_triangles;
    return settings;
}

} // namespace

std::vector<CacheNumbers> cache_numbers(const Forest& forest) {
    std::vector<CacheNumbers> numbers;
    for (const ForestSpecies& species : forest.species) {
        for (const ForestStage& stage : species.stages) {
            CacheNumbers& each = numbers.emplace_back();
            each.species = species.name;
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

LiveForest::LiveForest(const ViewOptions& options,
                       const Console& console,
                       Renderer& renderer,
                       std::function<void()> wake)
    : LiveScreen(options, console, renderer), settings(first_settings(options)),
      wake_(std::move(wake)), painting_(renderer), frames_next_(options.camera.empty()),
      loader_(make_forest, wake_),
      watch_(FileWatch::Options{},
             [this](const std::vector<std::string>& files, SteadyClock::time_point since) {
                 files_changed(files, since);
             }) {
    files_ = options_.files;
    watch_files();
}

LiveForest::~LiveForest() {
    renderer_->show_lines({});
    renderer_->show_plant(Mesh{}); // what it shows goes with this
}

/// On a thread of the watch.
void LiveForest::files_changed(const std::vector<std::string>& files,
                               SteadyClock::time_point since) {
    const auto shaders = std::count_if(files.begin(), files.end(),
                                       [this](const std::string& each) { return is_shader(each); });
    if (shaders != 0) {
        ask_for_shaders();
        wake_();
    }
    if (static_cast<std::size_t>(shaders) == files.size()) {
        return;
    }
    if (files.size() == 1) {
        const std::lock_guard lock(saved_mutex_);
        const Result<std::string> text = read_file(files.front(), {kMaxSourceBytes}, console_);
        if (!saved_text_.empty() && text && text.value() == saved_text_) {
            return; // that is what is shown
        }
        saved_text_.clear();
    }
    loader_.repeat(since);
}

void LiveForest::watch_files() {
    watch_.watch(watched(files_));
}

std::uint32_t LiveForest::usual_years() const {
    return usual_years_;
}

std::uint32_t LiveForest::years() const {
    return settings.edits.years.value_or(usual_years_);
}

void LiveForest::set_years(std::uint32_t years) {
    settings.edits.years = years;
    settings.grows = false;
}

bool LiveForest::update() {
    bool has_news = false;
    if (reload_shaders()) {
        has_portraits_ = false;
        watch_files();
        has_news = true;
    }
    if (std::optional<ForestOutcome> outcome = loader_.take()) {
        take_outcome(std::move(*outcome));
        has_news = true;
    }
    if (!has_portraits_ && document_ != nullptr) {
        has_portraits_ = renderer_->make_portraits(kPortraitTime);
        changed_ = changed_ || has_portraits_;
    }
    grow();
    if (document_ != nullptr) {
        settings.camera = above_ground(settings.camera, *document_->grown.terrain);
    }
    show_outline();
    if (!asked_ || !asked_->is_same(settings.edits)) {
        ask();
    }
    return has_news;
}

void LiveForest::ask() {
    asked_ = settings.edits;
    // What is in error may lie in files that are not read again.
    loader_.request({options_, settings.edits, failed() ? nullptr : document_, SteadyClock::now()});
}

void LiveForest::take_outcome(ForestOutcome outcome) {
    if (outcome.request.options.files != options_.files) {
        return; // another one is on its way
    }
    const bool fine = outcome.document != nullptr;
    take_messages(outcome.messages, fine);
    if (fine) {
        files_ = outcome.files;
        swap(std::move(outcome));
    } else {
        settings.grows = false;
        for (const std::string& file : outcome.files) {
            if (std::find(files_.begin(), files_.end(), file) == files_.end()) {
                files_.push_back(file);
            }
        }
    }
    watch_files();
}

void LiveForest::swap(ForestOutcome outcome) {
    const SteadyClock::time_point start = SteadyClock::now();
    const std::shared_ptr<ForestDocument> before = document_;
    const std::shared_ptr<ForestDocument> document = std::move(outcome.document);
    const Camera overall = overview(*document, aspect_);
    if (Result<void> shown = renderer_->show_forest(document->model); !shown) {
        shader_message_ = shown.error().message;
        console_.error(shader_message_);
        return;
    }
    document_ = document;
    has_portraits_ = false;
    if (std::exchange(frames_next_, false)) {
        settings.camera = overall;
    }
    if (const std::string note = painting_.follow(document_); !note.empty()) {
        say(note);
    }
    const PlacementOptions& placement = document_->scene.placement;
    if (!outcome.request.edits.years) {
        usual_years_ = placement.method == PlacementMethod::Domination ? placement.years : 0;
    }
    settings.brush.species = static_cast<std::uint16_t>(
        std::min<std::size_t>(settings.brush.species, document_->scene.species.size() - 1));
    if (before == nullptr) {
        const PlacementSpecies& first = placement.species.front();
        settings.brush.least_scale = first.least_scale;
        settings.brush.greatest_scale = first.greatest_scale;
    }
    stats_.caches = cache_numbers(document_->grown.forest);
    stats_.upload_seconds = seconds_since(start);
    stats_.make_seconds = outcome.seconds;
    since_ = outcome.request.since;
    stats_.swap_seconds = seconds_since(since_);
    ++stats_.swaps;
    tells_shown_ = true;
    changed_ = true;
}

bool LiveForest::draw(std::uint32_t width, std::uint32_t height) {
    Frame frame;
    frame.camera = settings.camera;
    frame.width = width;
    frame.height = height;
    frame.shadows = settings.shadows;
    frame.samples = settings.smooth ? 4 : 1;
    frame.style = settings.wireframe ? PlantStyle::Wireframe : PlantStyle::Surface;
    frame.most_triangles = settings.most_triangles;
    frame.most_expansions = kMostExpansions;
    if (settings.windy) {
        frame.wind = settings.wind;
        frame.time = seconds_since(start_);
    }
    if (document_ != nullptr) {
        frame.light = forest_light(*document_);
    }
    const bool moves = settings.windy || settings.grows || has_worked_ ||
                       (frame_ && !(frame_->camera == frame.camera));
    if (moves) {
        last_motion_ = SteadyClock::now();
    } else if (is_slow_ && loader_.is_busy()) {
        return false; // the next forest would wait for a picture of this one
    }
    has_worked_ = false;
    is_coarse_ = is_slow_ && seconds_since(last_motion_) < kRest;
    if (is_coarse_) {
        frame.samples = 1;
        frame.most_triangles = std::min(frame.most_triangles, coarse_triangles_);
    }
    if (!draw_frame(frame)) {
        return false;
    }
    stats_.drawn = drawn_;
    changed_ = changed_ || renderer_->forest_stats().waiting_trees != 0;
    return true;
}

void LiveForest::shown(double draw_seconds) {
    stats_.draw_seconds = draw_seconds;
    if (!is_coarse_) {
        is_slow_ = draw_seconds > kSlowPicture;
    } else if (draw_seconds > kSlowPicture) {
        coarse_triangles_ = std::max(coarse_triangles_ / 2, kFewestTriangles);
    } else if (draw_seconds < 0.25 * kSlowPicture) {
        coarse_triangles_ = std::min(coarse_triangles_ * 2, settings.most_triangles);
    }
    if (!std::exchange(tells_shown_, false)) {
        return;
    }
    stats_.shown_seconds = seconds_since(since_);
    console_.detail(fmt::format(
        "loaded {}: {} trees of {} species, {:.0f} ms; changed after {:.0f} ms, seen {:.0f} ms "
        "after the change",
        file(), painting_.tree_count(), document_->scene.species.size(),
        kMilliseconds * stats_.make_seconds, kMilliseconds * stats_.swap_seconds,
        kMilliseconds * stats_.shown_seconds));
}

void LiveForest::grow() {
    const SteadyClock::time_point now = SteadyClock::now();
    if (!settings.grows || document_ == nullptr) {
        last_growth_ = now;
        return;
    }
    const double passed = std::chrono::duration<double>(now - last_growth_).count();
    const double years_passed = passed * static_cast<double>(settings.years_per_second);
    const bool is_made = asked_ && asked_->is_same(settings.edits) && !loader_.is_busy();
    if (!is_made || years_passed < 1.0) {
        return;
    }
    last_growth_ = now;
    // A picture that takes long leaves out years.
    constexpr double kMostYears = 1000.0;
    const auto next = years() + static_cast<std::uint32_t>(std::min(years_passed, kMostYears));
    settings.grows = next < usual_years_;
    settings.edits.years = std::min(next, usual_years_);
}

void LiveForest::play_or_pause() {
    if (usual_years_ == 0) {
        say("only a placement by domination grows");
        return;
    }
    settings.grows = !settings.grows;
    if (settings.grows && years() >= usual_years_) {
        settings.edits.years = 1;
    }
}

void LiveForest::open(const std::string& file) {
    options_.file = file;
    options_.overrides = {};
    options_.files = {file};
    settings.edits = {};
    settings.grows = false;
    frames_next_ = true;
    files_ = {file};
    asked_.reset();
    watch_files();
}

void LiveForest::reload() {
    loader_.repeat(SteadyClock::now());
    if (!options_.shaders.empty()) {
        ask_for_shaders();
    }
}

void LiveForest::frame_all() {
    settings.camera = framing(settings.camera, renderer_->bounds(), aspect_);
}

std::optional<glm::dvec3> LiveForest::ground_at(const glm::vec2& place) {
    const Camera& camera = settings.camera;
    return painting_.pick(
        {glm::dvec3(camera.eye), glm::dvec3(direction_at(camera, place.x, place.y))});
}

void LiveForest::point_at(const glm::vec2& place) {
    pointed_ = place;
}

void LiveForest::show_outline() {
    std::optional<glm::dvec3> place;
    if (settings.tool != PaintTool::None && document_ != nullptr) {
        if (!pointed_) {
            return; // it stays where it is
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

void LiveForest::work_at(const glm::vec2& place, bool begins, bool erases) {
    begins_stroke_ = begins_stroke_ || begins;
    if (const std::optional<glm::dvec3> ground = ground_at(place)) {
        painting_.go_over(*ground, std::exchange(begins_stroke_, false),
                          erases ? PaintTool::Eraser : settings.tool, settings.brush);
        has_stroke_ = true;
        has_worked_ = true;
        changed_ = true;
    }
}

std::string LiveForest::painted_text(const char* what) const {
    const auto trees = [](std::uint64_t count) {
        return fmt::format("{} {}", count, count == 1 ? "tree" : "trees");
    };
    const PaintCount& count = painting_.count();
    return fmt::format("{}{} came, {} went; {}", what, trees(count.came), count.went,
                       trees(painting_.tree_count()));
}

void LiveForest::end_stroke() {
    begins_stroke_ = false;
    if (std::exchange(has_stroke_, false)) {
        say(painted_text(""));
    }
}

void LiveForest::undo() {
    if (!painting_.can_undo()) {
        say("there is nothing to undo");
        return;
    }
    painting_.undo();
    changed_ = true;
    say(painted_text("undone: "));
}

void LiveForest::redo() {
    if (!painting_.can_redo()) {
        say("there is nothing to redo");
        return;
    }
    painting_.redo();
    changed_ = true;
    say(painted_text("done again: "));
}

void LiveForest::save() {
    if (!is_scene(file())) {
        say("this forest is of no scene file, so there is nothing to save it into");
        return;
    }
    const std::lock_guard lock(saved_mutex_);
    const Result<void> saved = painting_.save(file(), console_);
    if (!saved) {
        say(fmt::format("not saved: {}", saved.error().message));
        return;
    }
    saved_text_ = painting_.saved_text();
    const SceneOverrides& given = options_.overrides;
    const bool is_other_placement = settings.edits.changes_placement() || given.key ||
                                    given.method || given.count || given.size || given.spacing ||
                                    given.density || given.years || given.tile ||
                                    !given.density_map.empty();
    // Their numbers are all that the file has of them.
    const bool is_doubtful = is_other_placement && painting_.has_erased();
    say(fmt::format("saved {}{}", file(),
                    is_doubtful ? "; but trees were erased from another placement than the file's, "
                                  "where other trees may have their numbers"
                                : ""));
}

bool LiveForest::is_busy() const {
    return loader_.is_busy() || settings.grows || settings.windy || !has_portraits_ || is_coarse_;
}

} // namespace lsys::view
