#include "viewer/app/live_view.h"

#include "runtime/cli/files.h"
#include "runtime/cli/stopwatch.h"
#include "runtime/texture.h"
#include "viewer/app/shader_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <utility>

namespace lsys::view {

namespace {

constexpr double kMilliseconds = 1e3;

bool operator==(const Definition& a, const Definition& b) {
    return a.name == b.name && a.value == b.value;
}

/// They are made into the same plant.
bool make_the_same(const LiveSettings& a, const LiveSettings& b) {
    return a.file == b.file && a.generations == b.generations && a.seed == b.seed &&
           a.mesh == b.mesh &&
           std::equal(a.definitions.begin(), a.definitions.end(), b.definitions.begin(),
                      b.definitions.end(),
                      [](const Definition& one, const Definition& other) { return one == other; });
}

bool is_same(const Bending& a, const Bending& b) {
    return a.stiffness == b.stiffness && a.forces.gravity == b.forces.gravity &&
           a.forces.wind == b.forces.wind && a.forces.damping == b.forces.damping;
}

LiveSettings first_settings(const ViewOptions& options) {
    LiveSettings settings;
    settings.file = options.file;
    settings.definitions = options.grammar.definitions;
    settings.generations = options.grammar.generations;
    settings.seed = options.seed;
    settings.mesh = options.mesh;
    settings.style = options.style;
    settings.lines = options.lines;
    settings.shadows = options.shadows;
    settings.ground = options.ground;
    settings.smooth = options.samples > 1;
    settings.bends = options.gravity || options.wind;
    if (settings.bends) {
        settings.bending.forces.gravity = options.gravity.value_or(0.0F);
    }
    settings.bending.forces.wind = options.wind.value_or(Wind{});
    settings.bending.forces.threads = options.threads;
    return settings;
}

} // namespace

LiveView::LiveView(const ViewOptions& options,
                   const lsc::Console& console,
                   Renderer& renderer,
                   std::function<void()> wake)
    : settings(first_settings(options)), options_(options), console_(console), renderer_(&renderer),
      wake_(std::move(wake)), frames_next_(options.camera.empty()), loader_(wake_),
      watch_(FileWatch::Options{},
             [this](const std::vector<std::string>& files, SteadyClock::time_point since) {
                 const auto is_shader = [this](const std::string& file) {
                     return !options_.shaders.empty() &&
                            std::filesystem::path(file).extension() == ".glsl";
                 };
                 if (std::any_of(files.begin(), files.end(), is_shader)) {
                     shaders_changed_ = true;
                     wake_();
                 }
                 if (!std::all_of(files.begin(), files.end(), is_shader)) {
                     loader_.repeat(since);
                 }
             }) {
    files_ = {settings.file};
    watch_files();
}

ViewOptions LiveView::wanted() const {
    ViewOptions wanted = options_;
    wanted.file = settings.file;
    wanted.grammar.definitions = settings.definitions;
    wanted.grammar.generations = settings.generations;
    wanted.seed = settings.seed;
    wanted.mesh = settings.mesh;
    return wanted;
}

std::uint32_t LiveView::usual_generations() const {
    const auto& bytecode = document_ == nullptr ? std::nullopt : document_->grammar.bytecode;
    const std::uint32_t own = bytecode ? bytecode->generations.value_or(0) : 0;
    return options_.file == settings.file ? options_.grammar.generations.value_or(own) : own;
}

std::uint32_t LiveView::generations() const {
    return settings.generations.value_or(usual_generations());
}

bool LiveView::update() {
    bool has_news = false;
    if (shaders_changed_.exchange(false)) {
        reload_shaders();
        has_news = true;
    }
    if (std::optional<LoadOutcome> outcome = loader_.take()) {
        take_outcome(std::move(*outcome));
        has_news = true;
    }
    grow();
    bend();
    if (shown_lines_ != settings.lines) {
        show_lines();
    }
    if (!asked_ || !make_the_same(*asked_, settings)) {
        asked_ = settings;
        loader_.request(wanted(), SteadyClock::now());
    }
    return has_news;
}

void LiveView::take_outcome(LoadOutcome outcome) {
    if (outcome.options.file != settings.file) {
        return; // another one is on its way
    }
    const bool fine = outcome.status == lsc::Status::Fine;
    if (!fine && drop_unknown_definitions(*outcome.document)) {
        return;
    }
    if (outcome.messages != messages_) {
        messages_ = outcome.messages;
        console_.io().err << messages_ << std::flush;
    }
    failed_ = !fine;
    if (fine) {
        files_ = outcome.files;
        swap(std::move(outcome));
    } else {
        // What is mended may lie in any file of before or now.
        for (const std::string& file : outcome.files) {
            if (std::find(files_.begin(), files_.end(), file) == files_.end()) {
                files_.push_back(file);
            }
        }
    }
    watch_files();
}

/// A constant that was set here and is no longer in the file.
bool LiveView::drop_unknown_definitions(const PlantDocument& document) {
    if (!document.grammar.program) {
        return false;
    }
    const auto is_unknown = [&](const Definition& definition) {
        const std::vector<Constant>& constants = document.grammar.program->constants;
        const std::vector<Definition>& given = options_.grammar.definitions;
        return std::none_of(constants.begin(), constants.end(),
                            [&](const Constant& constant) {
                                return document.grammar.names.text(constant.name) ==
                                       definition.name;
                            }) &&
               std::none_of(given.begin(), given.end(),
                            [&](const Definition& one) { return one.name == definition.name; });
    };
    return std::erase_if(settings.definitions, is_unknown) != 0;
}

void LiveView::swap(LoadOutcome outcome) {
    const SteadyClock::time_point start = SteadyClock::now();
    document_ = outcome.document;
    motion_.reset();
    bending_.reset();
    renderer_->show_plant(document_->mesh);
    show_lines();
    if (std::exchange(frames_next_, false)) {
        settings.camera = first_view(settings.camera, renderer_->bounds(), aspect_);
    }
    if (std::exchange(is_new_file_, false)) {
        settings.bending.forces.damping = document_->grammar.bytecode->settings.damping;
    }
    stats_.upload_seconds = lsc::seconds_since(start);
    stats_.make_seconds = outcome.seconds;
    stats_.swap_seconds = lsc::seconds_since(outcome.since);
    ++stats_.swaps;
    shown_outcome_ = std::move(outcome);
    tells_shown_ = true;
    changed_ = true;
}

void LiveView::show_lines() {
    shown_lines_ = settings.lines;
    const PlantDocument* const plant = document();
    if (plant == nullptr) {
        return;
    }
    const bool is_bent = motion_ != nullptr && !bent_.skeleton.segments.empty();
    const Skeleton& skeleton = is_bent ? bent_.skeleton : plant->plant.skeleton;
    renderer_->show_lines(make_lines(skeleton, shown_lines_));
    changed_ = true;
}

void LiveView::reload_shaders() {
    const Result<Done> loaded = renderer_->reload(shaders_of(options_.shaders, console_));
    shader_message_ = loaded ? std::string() : loaded.error().message;
    if (loaded) {
        console_.detail("loaded the shaders");
    } else {
        console_.error(shader_message_);
    }
    changed_ = true;
    watch_files();
}

void LiveView::watch_files() {
    std::vector<std::string> files = files_;
    const std::vector<std::string> shaders = shader_files(options_.shaders);
    files.insert(files.end(), shaders.begin(), shaders.end());
    watch_.watch(files);
}

void LiveView::grow() {
    const SteadyClock::time_point now = SteadyClock::now();
    if (!settings.grows || document_ == nullptr) {
        last_growth_ = now;
        return;
    }
    const double interval = 1.0 / static_cast<double>(settings.generations_per_second);
    const bool is_made = asked_ && make_the_same(*asked_, settings) && !loader_.is_busy();
    if (!is_made || std::chrono::duration<double>(now - last_growth_).count() < interval) {
        return;
    }
    last_growth_ = now;
    const std::uint32_t end = usual_generations();
    const std::uint32_t next = failed_ ? end : generations() + 1;
    settings.grows = next < end;
    settings.generations = std::min(next, end);
}

void LiveView::play_or_pause() {
    settings.grows = !settings.grows;
    if (settings.grows && generations() >= usual_generations()) {
        settings.generations = 0;
    }
}

void LiveView::bend() {
    if (document_ == nullptr || (!settings.bends && motion_ == nullptr)) {
        return;
    }
    if (!settings.bends) {
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
        mesh.threads = options_.threads;
        mesh.max_bytes = options_.max_bytes;
        motion_ = std::make_unique<PlantMotion>(document_, settings.bending, mesh, wake_);
        bending_ = settings.bending;
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

bool LiveView::draw(std::uint32_t width, std::uint32_t height) {
    Frame frame;
    frame.camera = settings.camera;
    frame.width = width;
    frame.height = height;
    frame.shadows = settings.shadows;
    frame.ground = settings.ground;
    frame.samples = settings.smooth ? 4 : 1;
    frame.style = settings.style;
    aspect_ = static_cast<float>(width) / static_cast<float>(height);
    if (!changed_ && frame_ == frame) {
        return false;
    }
    stats_.drawn = renderer_->draw(frame, {0, 0, width, height});
    frame_ = frame;
    changed_ = false;
    return true;
}

void LiveView::shown(double draw_seconds) {
    stats_.draw_seconds = draw_seconds;
    if (!std::exchange(tells_shown_, false)) {
        return;
    }
    stats_.shown_seconds = lsc::seconds_since(shown_outcome_.since);
    console_.detail(
        fmt::format("loaded {}: {} modules, {} segments, {} triangles, {:.0f} ms; seen "
                    "{:.0f} ms after the change",
                    shown_outcome_.options.file, document_->plant.modules,
                    document_->plant.skeleton.segments.size(), document_->mesh.indices.size() / 3,
                    kMilliseconds * stats_.make_seconds, kMilliseconds * stats_.shown_seconds));
}

void LiveView::open(const std::string& file) {
    settings.file = file;
    settings.definitions.clear();
    settings.generations.reset();
    settings.seed.reset();
    settings.grows = false;
    frames_next_ = true;
    is_new_file_ = true;
    files_ = {file};
    asked_.reset();
    watch_files();
}

void LiveView::reload() {
    loader_.repeat(SteadyClock::now());
    if (!options_.shaders.empty()) {
        shaders_changed_ = true;
    }
}

void LiveView::frame_all() {
    settings.camera = framing(settings.camera, renderer_->bounds(), aspect_);
}

void LiveView::write_screenshot() {
    if (!frame_) {
        return;
    }
    const std::string stem = std::filesystem::path(settings.file).stem().string();
    std::string name;
    std::error_code error;
    for (std::uint32_t number = 1; name.empty() || std::filesystem::exists(name, error); ++number) {
        name = fmt::format("{}-{}.png", stem, number);
    }
    Texture picture;
    picture.width = frame_->width;
    picture.height = frame_->height;
    renderer_->read(picture.texels);
    const Result<Done> written = lsc::write_file(name, encode_png(picture), console_);
    say(written ? fmt::format("wrote {}", name) : written.error().message);
}

void LiveView::say(const std::string& note) {
    note_ = note;
    console_.info(note);
}

bool LiveView::is_busy() const {
    return loader_.is_busy() || settings.grows || motion_ != nullptr;
}

} // namespace lsys::view
