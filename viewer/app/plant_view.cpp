// SPDX-License-Identifier: MIT
#include "viewer/app/plant_view.h"

#include "runtime/pipeline/stopwatch.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "viewer/app/daylight.h"
#include "viewer/scene/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace lsys::view {

namespace {

PlantSource source_of(const ViewOptions& options) {
    PlantSource source;
    source.definitions = options.grammar.definitions;
    source.definitions.insert(source.definitions.end(),
                              options.grammar.optional_definitions.begin(),
                              options.grammar.optional_definitions.end());
    source.set_values = options.grammar.settings;
    source.generations = options.grammar.generations;
    source.seed = options.seed;
    source.mesh = options.mesh;
    source.moves = options.grammar.moves;
    return source;
}

void set_source(const PlantSource& source, ViewOptions& options) {
    options.grammar.definitions = {};
    options.grammar.optional_definitions = source.definitions;
    options.grammar.settings = source.set_values;
    options.grammar.generations = source.generations;
    options.seed = source.seed;
    options.mesh = source.mesh;
    options.grammar.moves = source.moves;
}

PlantLook look_of(const ViewOptions& options) {
    PlantLook look;
    look.style = options.style;
    look.lines = options.lines;
    look.shadows = options.shadows;
    look.ground = options.ground;
    look.figure = options.figure;
    look.antialiasing = options.samples > 1;
    look.quality = options.quality;
    look.light = options.light;
    look.senses = options.senses;
    return look;
}

void set_look(const PlantLook& look, ViewOptions& options) {
    options.style = look.style;
    options.lines = look.lines;
    options.shadows = look.shadows;
    options.ground = look.ground;
    options.figure = look.figure;
    options.samples = look.antialiasing ? 4 : 1;
    options.quality = look.quality;
    options.light = look.light;
    options.senses = look.senses;
}

bool is_same(const Bending& a, const Bending& b) {
    return a.stiffness == b.stiffness && a.forces.gravity == b.forces.gravity &&
           a.forces.wind == b.forces.wind && a.forces.damping == b.forces.damping &&
           a.forces.load == b.forces.load;
}

/// Path of a file in the current folder that has the name of the grammar.
std::string default_output(const std::string& file) {
    return std::filesystem::path(file).stem().string() + ".glb";
}

PlantViewSettings first_plant_settings(const ViewOptions& options) {
    PlantViewSettings settings;
    settings.file = options.file;
    static_cast<PlantSource&>(settings) = source_of(options);
    static_cast<PlantLook&>(settings) = look_of(options);
    settings.simulates = options.gravity || options.wind;
    if (settings.simulates) {
        settings.bending.forces.gravity = options.gravity.value_or(0.0F);
    }
    settings.bending.forces.wind = options.wind.value_or(Wind{});
    settings.bending.forces.threads = options.run.threads;
    settings.output.file = default_output(options.file);
    return settings;
}

} // namespace

bool operator==(const PlantEdits& a, const PlantEdits& b) {
    return static_cast<const PlantSource&>(a) == b && static_cast<const PlantLook&>(a) == b &&
           a.simulates == b.simulates && is_same(a.bending, b.bending) &&
           a.file_steps == b.file_steps;
}

PlantView::PlantView(const ViewOptions& options,
                     const Console& console,
                     Renderer& renderer,
                     std::function<void()> wake)
    : View(options, console, renderer, std::move(wake)), settings(first_plant_settings(options)),
      saved_(settings), history_(settings), plays_next_(options.grow), loader_(wake_),
      watch_(FileWatch::Options{},
             [this](const std::vector<std::string>& files, SteadyClock::time_point changed_at) {
                 const auto shaders =
                     std::count_if(files.begin(), files.end(),
                                   [this](const std::string& each) { return is_shader(each); });
                 if (shaders != 0) {
                     request_shader_reload();
                     wake_();
                 }
                 if (static_cast<std::size_t>(shaders) != files.size()) {
                     loader_.repeat(changed_at);
                 }
             }) {
    files_ = {settings.file};
    watch_files();
}

ViewOptions PlantView::options_with_settings() const {
    ViewOptions wanted = options_;
    wanted.file = settings.file;
    set_source(settings, wanted);
    return wanted;
}

ViewOptions PlantView::picture_options(FilmKind kind) const {
    ViewOptions wanted = options_with_settings();
    wanted.files = {settings.file};
    if (kind == FilmKind::Growth) {
        wanted.grammar.generations = default_generations();
    }
    wanted.camera = to_text(settings.camera);
    wanted.gravity.reset();
    wanted.wind.reset();
    set_look(settings, wanted);
    return wanted;
}

std::uint32_t PlantView::default_generations() const {
    const std::uint32_t of_grammar =
        document_ == nullptr ? 0 : document_->grammar.bytecode.generations.value_or(0);
    return options_.grammar.generations.value_or(of_grammar);
}

std::uint32_t PlantView::generations() const {
    return settings.generations.value_or(default_generations());
}

bool PlantView::update() {
    bool has_new_content = false;
    if (reload_shaders()) {
        watch_files();
        has_new_content = true;
    }
    if (std::optional<LoadOutcome> outcome = loader_.take()) {
        take_outcome(std::move(*outcome));
        has_new_content = true;
    }
    has_new_content = take_picked() || has_new_content;
    grow();
    if (!settings.plays && !shows_growth_) {
        bend();
    } else if (!settings.plays && settings.simulates && !loader_.is_busy() && !failed()) {
        requested_.reset(); // moments of growth do not bend, so the plant itself is requested
    }
    has_new_content = check_standing() || has_new_content;
    if (exporter_ != nullptr) {
        if (const std::optional<std::string> outcome = exporter_->take()) {
            set_note(*outcome);
            has_new_content = true;
        }
    }
    if (shown_lines_ != settings.lines) {
        show_lines();
    }
    if (shown_senses_ != settings.senses || shown_moves_ != settings.moves) {
        show_senses();
    }
    if (!requested_ || requested_->file != settings.file ||
        static_cast<const PlantSource&>(*requested_) != settings) {
        requested_ = settings;
        loader_.request(options_with_settings(), SteadyClock::now());
    }
    return has_new_content;
}

void PlantView::take_outcome(LoadOutcome outcome) {
    if (outcome.options.file != settings.file) {
        return; // a newer request is running
    }
    const bool succeeded = outcome.document != nullptr;
    take_messages(outcome.messages, succeeded);
    if (succeeded) {
        files_ = outcome.files;
        swap(std::move(outcome));
    } else {
        // The user may correct the error in a file of the old or of the new plant, so both are
        // watched.
        for (const std::string& file : outcome.files) {
            if (std::find(files_.begin(), files_.end(), file) == files_.end()) {
                files_.push_back(file);
            }
        }
    }
    watch_files();
}

/// Drops the user's values of constants that the file no longer has.
void PlantView::drop_unknown_definitions() {
    if (!document_->grammar.program) {
        return;
    }
    const auto is_unknown = [&](const Definition& definition) {
        const std::vector<Constant>& constants = document_->grammar.program->constants;
        return std::none_of(constants.begin(), constants.end(), [&](const Constant& constant) {
            return document_->grammar.names.text(constant.name) == definition.name;
        });
    };
    if (std::erase_if(settings.definitions, is_unknown) != 0 && requested_) {
        requested_->definitions = settings.definitions; // the plant is the same
    }
    std::erase_if(history_.current().definitions, is_unknown);
    std::erase_if(saved_.definitions, is_unknown);
}

void PlantView::swap(LoadOutcome outcome) {
    const SteadyClock::time_point start = SteadyClock::now();
    document_ = outcome.document;
    forget_picked();
    drop_unknown_definitions();
    motion_.reset();
    bending_.reset();
    checked_bending_.reset();
    warns_of_fall_ = false;
    film_.reset(); // files that it uses may have changed
    shows_growth_ = false;
    grown_ = {};
    renderer_->show_plant(document_->mesh);
    widen_film_ground();
    show_lines();
    rest_bounds_ = renderer_->bounds();
    if (std::exchange(plays_next_, false)) {
        settings.plays = true;
    }
    if (std::exchange(frame_next_, false)) {
        // Discards the direction from which the previous plant was shown.
        const Camera from = with_parts(options_.camera, Camera{});
        settings.camera = with_parts(
            options_.camera,
            first_view(from, settings.figure ? with_figure(rest_bounds_) : rest_bounds_, aspect_));
    }
    settings.bending.forces.load = document_->grammar.bytecode.settings.load;
    if (std::exchange(is_new_file_, false)) {
        settings.bending.forces.damping = document_->grammar.bytecode.settings.damping;
    }
    history_.current().bending.forces.load = settings.bending.forces.load;
    history_.current().bending.forces.damping = settings.bending.forces.damping;
    stats_.upload_seconds = seconds_since(start);
    stats_.make_seconds = outcome.seconds;
    stats_.swap_seconds = seconds_since(outcome.changed_at);
    ++stats_.swaps;
    shown_outcome_ = std::move(outcome);
    show_senses();
    logs_next_frame_ = true;
    changed_ = true;
}

void PlantView::show_lines() {
    shown_lines_ = settings.lines;
    const PlantDocument* const plant = document();
    if (plant == nullptr) {
        return;
    }
    if (shows_growth_) {
        renderer_->show_lines(make_lines(grown_.skeleton, shown_lines_));
        changed_ = true;
        return;
    }
    const bool is_bent = motion_ != nullptr && !bent_.skeleton.segments.empty();
    const Skeleton& skeleton = is_bent ? bent_.skeleton : plant->plant.skeleton;
    renderer_->show_lines(make_lines(skeleton, shown_lines_));
    changed_ = true;
}

void PlantView::watch_files() {
    watch_.watch(with_shader_files(files_));
}

void PlantView::start_growth() {
    if (generations() >= default_generations() && !shows_growth_) {
        settings.generations = 0;
    }
    if (!shows_growth_ || std::floor(growth_position_) != static_cast<double>(generations())) {
        growth_position_ = static_cast<double>(generations());
    }
    last_growth_ = SteadyClock::now();
    motion_.reset();
    bending_.reset();
    if (film_ == nullptr) {
        film_ = std::make_unique<PlantFilm>(wake_);
    }
}

/// Keeps the ground disc as wide as for the largest plant that the growth has shown so far, so that
/// it does not shrink and grow with the plant.
void PlantView::widen_film_ground() {
    if (renderer_->bounds().empty) {
        return;
    }
    const glm::vec4 disc = ground_disc_of(renderer_->bounds());
    if (disc.w > film_ground_.w) {
        film_ground_ = disc;
    }
}

/// Shows the moment that the growth thread has made (PlantFilm).
void PlantView::take_moment() {
    std::optional<FilmMoment> film_moment = film_->take();
    if (!film_moment) {
        return;
    }
    if (film_moment->failed) {
        take_messages(film_moment->messages, false);
        settings.plays = false;
        return;
    }
    grown_ = std::move(*film_moment);
    shows_growth_ = true;
    ++stats_.moments;
    renderer_->show_plant(grown_.mesh);
    widen_film_ground();
    show_lines();
    show_senses();
    changed_ = true;
    if (grown_.moment.generation >= default_generations()) {
        settings.plays = false;
        requested_.reset(); // request the plant itself, which has the messages
    }
}

/// Requests the next moment of growth. Plants whose moments take long grow in slow motion.
void PlantView::grow() {
    if (!settings.plays || document_ == nullptr) {
        if (film_ != nullptr) {
            static_cast<void>(film_->take()); // drops a moment of a growth that was paused
        }
        return;
    }
    if (film_ == nullptr) {
        start_growth();
    }
    take_moment();
    if (!settings.plays || film_->is_busy()) {
        return;
    }
    constexpr double kMaxStep = 0.25; // s
    const SteadyClock::time_point now = SteadyClock::now();
    const double passed =
        std::min(std::chrono::duration<double>(now - last_growth_).count(), kMaxStep);
    last_growth_ = now;
    const auto end = static_cast<double>(default_generations());
    if (shows_growth_) {
        growth_position_ = std::min(
            growth_position_ + passed * static_cast<double>(settings.generations_per_second), end);
    }
    const auto generation = static_cast<std::uint32_t>(growth_position_);
    ViewOptions options = options_with_settings();
    options.grammar.generations = default_generations();
    film_->request(options, {generation, growth_position_ - std::floor(growth_position_)});
    settings.generations = generation;
    if (requested_) {
        // The growth thread makes this generation, so the loader must not make it, too.
        requested_->generations = generation;
    }
}

void PlantView::record_edits() {
    if (!settings.plays && !grabbed_) {
        history_.record(settings);
    }
}

void PlantView::undo() {
    record_edits();
    if (!history_.can_undo()) {
        set_note("Nothing to undo");
        return;
    }
    settings.plays = false;
    static_cast<PlantEdits&>(settings) = history_.undo();
    follow_file_steps();
}

void PlantView::redo() {
    record_edits();
    if (!history_.can_redo()) {
        set_note("Nothing to redo");
        return;
    }
    settings.plays = false;
    static_cast<PlantEdits&>(settings) = history_.redo();
    follow_file_steps();
}

/// Undoes or repeats changes of files until they agree with PlantEdits::file_steps.
void PlantView::follow_file_steps() {
    if (settings.file_steps == file_edits_.position()) {
        return;
    }
    const bool repeats = settings.file_steps > file_edits_.position();
    const Result<void> done = file_edits_.go_to(settings.file_steps, console_);
    set_note(
        done
            ? fmt::format("{} the fix of {}", repeats ? "repeated" : "took back", settings.file)
            : fmt::format("not {}: {}", repeats ? "repeated" : "taken back", done.error().message));
}

LoadedSources PlantView::loaded_sources() const {
    LoadedSources loaded = common_sources();
    loaded.options = options_with_settings().grammar;
    if (!failed() && document_ != nullptr && shown_outcome_.options.file == loaded.file) {
        loaded.sources = document_->grammar.sources;
    }
    return loaded;
}

void PlantView::change_files(std::vector<FileChange> changes, const std::string& what) {
    record_edits();
    if (const Result<void> written = file_edits_.apply(std::move(changes), console_); !written) {
        set_note(fmt::format("not written: {}", written.error().message));
        return;
    }
    settings.file_steps = file_edits_.position();
    record_edits();
    set_note(what);
}

void PlantView::play_or_pause() {
    settings.plays = !settings.plays;
    if (settings.plays) {
        start_growth();
    }
}

bool PlantView::has_changed_values() const {
    return !settings.definitions.empty() || !settings.set_values.empty() || settings.seed;
}

bool PlantView::is_unsaved() const {
    return has_changed_values() &&
           (settings.definitions != saved_.definitions ||
            settings.set_values != saved_.set_values || settings.seed != saved_.seed);
}

/// The bytes of the file with the values `values`. Error: the plant that is shown is not that of
/// the file on disk.
Result<std::string> PlantView::text_with_values(const StatementValues& values) const {
    const Grammar& grammar = document_->grammar;
    const std::string& file = settings.file;
    if (grammar.is_module_file) {
        return Error{fmt::format("`{}` is compiled; write to its grammar", file)};
    }
    if (!grammar.translation.empty()) {
        return Error{fmt::format("`{}` is not a .lsys file; `lsc import --set` makes one", file)};
    }
    Result<std::string> bytes = read_file(file, {kMaxSourceBytes}, console_);
    if (!bytes) {
        return bytes;
    }
    const SourceFile shown = SourceFile(file, bytes.value());
    const SourceFile& read = grammar.sources->file(FileId{0});
    if (shown.text() != read.text() || shown.has_byte_order_mark() != read.has_byte_order_mark()) {
        return Error{fmt::format("`{}` has changed on disk since it was read", file)};
    }
    const Project project{make_file_host(nullptr, options_.run.files),
                          options_.run.limits,
                          options_.run.threads,
                          {},
                          options_.run.environments,
                          options_.run.files};
    return with_values(file, bytes.value(), values, make_loader(project, project.limits.max_bytes));
}

void PlantView::save() {
    if (!has_changed_values()) {
        set_note("no value differs from the file");
        return;
    }
    if (document_ == nullptr || failed()) {
        set_note("not written: there is no plant with these values");
        return;
    }
    StatementValues values;
    values.definitions = settings.definitions;
    values.settings = settings.set_values;
    if (settings.seed) { // the user's seed overrides a `--set seed`
        std::erase_if(values.settings, [](const SettingText& one) { return one.key == "seed"; });
        values.settings.push_back({"seed", fmt::format("{}", *settings.seed)});
    }
    std::vector<std::string> names;
    for (const Definition& definition : values.definitions) {
        names.push_back(definition.name);
    }
    for (const SettingText& setting : values.settings) {
        names.push_back(setting.key);
    }
    const Result<std::string> text = text_with_values(values);
    const bool is_up_to_date = requested_ &&
                               static_cast<const PlantSource&>(*requested_) == settings &&
                               !loader_.is_busy();
    const Result<void> written =
        !text           ? Result<void>(text.error())
        : is_up_to_date ? write_file(settings.file, text.value(), console_)
                        : Result<void>(Error{"the plant with these values is not made yet"});
    if (!written) {
        set_note(fmt::format("not written: {}", written.error().message));
        return;
    }
    settings.definitions.clear();
    settings.set_values.clear();
    settings.seed.reset();
    saved_ = settings;
    set_note(fmt::format("wrote {} to {}", fmt::join(names, ", "), settings.file));
}

void PlantView::bend() {
    if (document_ == nullptr || (!settings.simulates && motion_ == nullptr)) {
        return;
    }
    if (!settings.simulates) {
        motion_.reset();
        bending_.reset();
        bent_ = {};
        renderer_->show_plant(document_->mesh);
        show_lines();
        return;
    }
    if (motion_ == nullptr) {
        bent_ = {};
        MeshOptions mesh = settings.mesh;
        mesh.threads = options_.run.threads;
        mesh.max_bytes = options_.run.limits.max_bytes;
        motion_ = std::make_unique<PlantMotion>(document_, settings.bending, mesh, wake_);
        bending_ = settings.bending;
        bent_mesh_options_ = settings.mesh;
    } else if (!is_same(*bending_, settings.bending)) {
        motion_->set(settings.bending);
        bending_ = settings.bending;
    }
    if (motion_->take(bent_)) {
        renderer_->show_plant(bent_.mesh);
        stats_.bend_seconds = bent_.seconds;
        stats_.bend_time = bent_.time;
        changed_ = true;
        if (shown_lines_ != LineKind::None) {
            show_lines();
        }
    }
}

/// Adds a warning if the simulated plant falls under its weight. Returns whether messages changed.
bool PlantView::check_standing() {
    const bool wants = settings.simulates && document_ != nullptr && !failed() &&
                       motion_ != nullptr && settings.bending.forces.gravity > 0.0F;
    if (!wants) {
        checked_bending_.reset();
        if (!std::exchange(warns_of_fall_, false) || document_ == nullptr || failed()) {
            return false;
        }
        take_messages(shown_outcome_.messages, true);
        return true;
    }
    if (!checked_bending_ || checked_bending_->stiffness != settings.bending.stiffness ||
        checked_bending_->forces.gravity != settings.bending.forces.gravity ||
        checked_bending_->forces.load != settings.bending.forces.load) {
        if (standing_checker_ == nullptr) {
            standing_checker_ = std::make_unique<StandingChecker>(check_plant_stands, wake_);
        }
        checked_bending_ = settings.bending;
        standing_checker_->request({document_, settings.bending, SteadyClock::now(), false});
    }
    std::optional<StandingOutcome> outcome = standing_checker_->take();
    if (!outcome || outcome->document != document_) {
        return false;
    }
    Messages messages = shown_outcome_.messages;
    warns_of_fall_ = !outcome->warning.all().empty();
    messages.add(std::move(outcome->warning), document_->grammar.sources);
    take_messages(messages, true);
    return true;
}

PickRequest PlantView::request_for(const Picked& picked) const {
    if (document_ == nullptr || picked.kind != PickedKind::Plant) {
        return {};
    }
    const bool is_bent = motion_ != nullptr && !bent_.skeleton.segments.empty();
    PickedTriangle triangle;
    triangle.triangle = picked.triangle;
    triangle.place = picked.place;
    triangle.mesh = shown_outcome_.options.mesh;
    ViewOptions options = shown_outcome_.options;
    std::shared_ptr<const Skeleton> pose;
    if (shows_growth_) {
        pose = std::make_shared<Skeleton>(grown_.skeleton);
        triangle.mesh = grown_.mesh_options;
        triangle.moment = grown_.moment;
        options = options_with_settings();
        options.grammar.generations = default_generations();
    } else if (is_bent) {
        pose = std::make_shared<Skeleton>(bent_.skeleton);
        triangle.mesh = bent_mesh_options_;
    } else {
        pose = std::shared_ptr<const Skeleton>(document_, &document_->plant.skeleton);
    }
    triangle.pose = pose.get();
    PickRequest request;
    request.describe = [triangle, pose, options, document = document_](const Project& project) {
        return view::describe(triangle, *document, options, project);
    };
    request.trace = [options, document = document_](const PickedModule& module, TraceScope scope,
                                                    const Project& project) {
        return trace_picked(module, scope, true, *document, options, project);
    };
    return request;
}

bool PlantView::draw(std::uint32_t width, std::uint32_t height) {
    use_quality(settings.quality);
    Frame frame;
    frame.camera = settings.camera;
    frame.width = width;
    frame.height = height;
    frame.shadows = settings.shadows;
    frame.ground = settings.ground;
    frame.samples = settings.antialiasing ? 4 : 1;
    frame.temporal = settings.antialiasing;
    frame.style = settings.style;
    frame.dims =
        settings.dims && settings.lines != LineKind::None && settings.style == PlantStyle::Surface;
    frame.light = daylight_of(settings.light, Light{});
    if (shows_growth_) {
        frame.ground_disc = film_ground_;
    }
    if (settings.figure) {
        frame.figure = figure_beside(rest_bounds_);
    }
    if (!draw_frame(frame)) {
        return false;
    }
    stats_.drawn = drawn_;
    return true;
}

void PlantView::picture_shown(double draw_seconds) {
    stats_.draw_seconds = draw_seconds;
    if (!std::exchange(logs_next_frame_, false)) {
        return;
    }
    stats_.shown_seconds = seconds_since(shown_outcome_.changed_at);
    console_.detail(fmt::format(
        "loaded {}: {} modules, {} segments, {} triangles, {:.0f} ms; first frame {:.0f} ms",
        shown_outcome_.options.file, document_->plant.modules,
        document_->plant.skeleton.segments.size(), document_->mesh.indices.size() / 3,
        kMillisecondsPerSecond * stats_.make_seconds,
        kMillisecondsPerSecond * stats_.shown_seconds));
}

void PlantView::open(const std::string& file) {
    use_other_file(options_, file);
    settings.file = file;
    settings.output.file = default_output(file);
    PlantSource source;
    source.mesh = settings.mesh;
    static_cast<PlantSource&>(settings) = std::move(source);
    saved_ = settings;
    settings.figure = false;
    settings.plays = false;
    grabbed_.reset();
    film_.reset();
    film_ground_ = glm::vec4(0.0F);
    frame_next_ = true;
    is_new_file_ = true;
    files_ = {file};
    requested_.reset();
    settings.file_steps = 0;
    file_edits_.clear();
    history_ = EditHistory<PlantEdits>(settings);
    watch_files();
}

void PlantView::reload() {
    loader_.repeat(SteadyClock::now());
    if (!options_.shaders.empty()) {
        request_shader_reload();
    }
}

void PlantView::frame_all() {
    settings.camera =
        framing(settings.camera,
                settings.figure ? with_figure(renderer_->bounds()) : renderer_->bounds(), aspect_);
}

void PlantView::export_shown() {
    if (document_ == nullptr || shows_growth_) {
        set_note(document_ == nullptr
                     ? "No plant to export yet"
                     : "Stop the growth at a whole generation to export the plant");
        return;
    }
    if (exporter_ == nullptr) {
        exporter_ = std::make_unique<PlantExporter>(export_plant, wake_);
    }
    exported_file_ = settings.output.file;
    exporter_->request(
        {document_, shown_outcome_.options, settings.output, files_, SteadyClock::now(), false});
}

std::optional<MakingState> PlantView::making() const {
    if (exporter_ != nullptr && exporter_->has_run_for(kProgressDelay)) {
        return MakingState{"Writing " + exported_file_, std::nullopt};
    }
    return loader_.has_run_for(kProgressDelay) ? std::optional(loader_.progress().state())
                                               : std::nullopt;
}

void PlantView::cancel_making() {
    if (exporter_ != nullptr && exporter_->running_time()) {
        exporter_->cancel();
        set_note("Cancelled: no file is written");
        return;
    }
    loader_.cancel();
    if (document_ == nullptr) {
        set_note("Cancelled: no plant is shown");
        return;
    }
    const ViewOptions& shown = shown_outcome_.options;
    if (settings.file != shown.file) {
        use_other_file(options_, shown.file);
        settings.file = shown.file;
        files_ = shown_outcome_.files;
        frame_next_ = false;
        is_new_file_ = false;
        watch_files();
    }
    static_cast<PlantSource&>(settings) = source_of(shown);
    requested_ = settings;
    set_note("Cancelled: the last plant is shown");
}

bool PlantView::is_busy() const {
    return loader_.is_busy() || settings.plays || motion_ != nullptr || is_picking() ||
           (exporter_ != nullptr && exporter_->is_busy()) ||
           (checked_bending_ && standing_checker_->is_busy());
}

} // namespace lsys::view
