// SPDX-License-Identifier: MIT
#include "viewer/app/view.h"

#include "runtime/meshing/texture.h"
#include "runtime/program/files.h"
#include "runtime/program/run_files.h"
#include "viewer/app/picture_series.h"
#include "viewer/app/shader_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <ostream>
#include <utility>

namespace lsys::view {

View::View(const ViewOptions& options,
           const Console& console,
           Renderer& renderer,
           std::function<void()> wake)
    : options_(options), console_(console), renderer_(&renderer), wake_(std::move(wake)) {}

namespace {

/// One entry for each diagnostic and for each other message.
std::vector<ShownMessage> entries_of(const Messages& messages) {
    std::vector<ShownMessage> entries;
    for (const Message& message : messages.all()) {
        if (message.kind == Message::Kind::Error) {
            entries.push_back({Severity::Error, "error: " + message.text, {}});
        } else if (message.kind == Message::Kind::Info || message.kind == Message::Kind::Help) {
            entries.push_back({Severity::Note, message.text, {}});
        }
        const SourceMap none;
        const SourceMap& sources = message.sources ? *message.sources : none;
        for (const Diagnostic& diagnostic : message.diagnostics.all()) {
            ShownMessage& entry = entries.emplace_back();
            entry.severity = diagnostic.severity;
            if (diagnostic.span.file != kNoFile) {
                const SourceFile& file = sources.file(diagnostic.span.file);
                const LineColumn place = file.line_column(diagnostic.span.begin);
                entry.place = FilePosition{file.path(), place.line, place.column};
            }
            render(diagnostic, sources, {MessageFormat::Short}, entry.head);
            render(diagnostic, sources, {MessageFormat::Human}, entry.text);
            entry.head.erase(entry.head.find_last_not_of('\n') + 1);
            // The first line of the text is equal to the head, so it is removed.
            entry.text.erase(0, entry.text.find('\n') + 1);
            constexpr std::size_t kMaxEntries = 50; // as many messages as on a terminal
            if (entries.size() >= kMaxEntries) {
                return entries;
            }
        }
    }
    return entries;
}

} // namespace

void View::take_messages(const Messages& messages, bool succeeded) {
    MessageOptions plain = options_.messages;
    plain.colour = ColourMode::Never;
    std::string text = messages_text(messages, plain, "lsview");
    if (text != text_) {
        text_ = std::move(text);
        entries_ = entries_of(messages);
        console_.io().err << text_ << std::flush;
    }
    failed_ = !succeeded;
    messages_ = std::make_shared<Messages>(messages);
    loaded_file_ = path();
    ++taken_request_count_;
}

LoadedSources View::common_sources() const {
    LoadedSources loaded;
    loaded.file = loaded_file_;
    loaded.messages = messages_;
    loaded.run = options_.run;
    loaded.is_forest = is_forest();
    return loaded;
}

std::string View::all_messages() const {
    std::string all = text_ + shader_message_;
    for (const std::string& error : renderer_->errors()) {
        all += error;
    }
    return all;
}

bool View::reload_shaders() {
    if (!shaders_changed_.exchange(false)) {
        return false;
    }
    const Result<void> loaded = renderer_->reload(shaders_of(options_.shaders, console_));
    shader_message_ =
        loaded ? std::string() : shader_error(options_.shaders, loaded.error()).message;
    if (loaded) {
        console_.detail("loaded the shaders");
    } else {
        console_.error(shader_message_);
    }
    changed_ = true;
    return true;
}

bool View::is_shader(const std::string& file) const {
    return !options_.shaders.empty() && std::filesystem::path(file).extension() == ".glsl";
}

std::vector<std::string> View::with_shader_files(std::vector<std::string> files) const {
    const std::vector<std::string> shaders = shader_files(options_.shaders);
    files.insert(files.end(), shaders.begin(), shaders.end());
    return files;
}

void View::use_quality(Quality quality) {
    if (std::exchange(quality_, quality) == quality) {
        return;
    }
    if (const Result<void> done = renderer_->set_quality(quality); !done) {
        set_note(done.error().message);
    }
    changed_ = true;
}

bool View::draw_frame(Frame frame) {
    aspect_ = static_cast<float>(frame.width) / static_cast<float>(frame.height);
    frame.temporal =
        frame.temporal && (options_.temporal == Temporal::On ||
                           (options_.temporal == Temporal::Auto && renderer_->prefers_temporal()));
    if (!changed_ && frame_ == frame) {
        return false;
    }
    changed_ = false;
    drawn_ = renderer_->draw(frame, {0, 0, frame.width, frame.height});
    frame_ = frame;
    return true;
}

void View::pick(const PicturePixel& pixel) {
    if (!frame_ || pixel.x >= frame_->width || pixel.y >= frame_->height) {
        return;
    }
    const Result<Picked> picked = renderer_->pick(*frame_, pixel.x, frame_->height - 1 - pixel.y);
    if (!picked) {
        set_note(picked.error().message);
        return;
    }
    forget_picked();
    if (picked.value().kind == PickedKind::Nothing) {
        return;
    }
    PickRequest request = request_for(picked.value());
    if (!request.describe) {
        return;
    }
    request.run = options_.run;
    request.changed_at = SteadyClock::now();
    trace_function_ = request.trace;
    if (picker_ == nullptr) {
        picker_ = std::make_unique<PickWorker>(run_pick, wake_);
    }
    wants_picked_ = true;
    picker_->request(std::move(request));
}

void View::forget_picked() {
    picked_ = {};
    wants_picked_ = false;
    forget_trace();
}

bool View::take_picked() {
    const bool has_trace = take_trace();
    if (picker_ == nullptr) {
        return has_trace;
    }
    std::optional<Description> outcome = picker_->take();
    if (!outcome || !wants_picked_) {
        return has_trace;
    }
    picked_ = std::move(*outcome);
    ++pick_count_;
    for (const std::string& line : picked_.lines) {
        console_.detail(fmt::format("picked: {}", line));
    }
    if (!picked_.hint.empty()) {
        console_.detail(fmt::format("picked: {}", picked_.hint));
    }
    trace(trace_scope_);
    return true;
}

void View::trace(TraceScope scope) {
    if (!picked_.module || !trace_function_) {
        return;
    }
    trace_scope_ = scope;
    traced_.clear();
    wants_trace_ = true;
    if (tracer_ == nullptr) {
        tracer_ = std::make_unique<TraceWorker>(run_trace, wake_);
    }
    tracer_->request(
        {trace_function_, *picked_.module, scope, options_.run, SteadyClock::now(), false});
}

void View::forget_trace() {
    traced_.clear();
    wants_trace_ = false;
}

bool View::take_trace() {
    if (tracer_ == nullptr) {
        return false;
    }
    const std::optional<std::string> text = tracer_->take();
    if (!text || !wants_trace_) {
        return false;
    }
    traced_ = styled_lines(*text);
    for (const TextLine& line : traced_) {
        console_.detail(fmt::format("traced: {}", plain_text(line)));
    }
    return true;
}

void View::write_screenshot() {
    if (!frame_) {
        return;
    }
    const std::string stem = std::filesystem::path(path()).stem().string();
    const std::string name = unused_picture_name({}, stem) + ".png";
    Texture picture;
    picture.width = frame_->width;
    picture.height = frame_->height;
    renderer_->read(picture.texels);
    const Result<void> written = write_file(name, encode_png(picture), console_);
    set_note(written ? fmt::format("wrote {}", name) : written.error().message);
}

void View::write_picture(const PictureSettings& settings) {
    if (!frame_) {
        return;
    }
    Frame frame = *frame_;
    frame.width = settings.width == 0 ? frame.width : settings.width;
    frame.height = settings.height == 0 ? frame.height : settings.height;
    frame.samples = settings.samples;
    frame.temporal = false;
    frame.max_expansions = ~0U;
    frame.max_triangles = options_.max_triangles;
    frame.transparent = settings.transparent && !is_forest();
    frame.ground = frame.ground && !frame.transparent;
    static_cast<void>(renderer_->bake_impostors(std::numeric_limits<double>::infinity()));
    FrameStats stats;
    double read_milliseconds = 0.0;
    const std::string bytes = encode_png(draw_picture(frame, *renderer_, stats, read_milliseconds));
    RunFiles files;
    note_read(&files, files_);
    Io io = console_.io();
    io.files = &files;
    const Result<void> written =
        bytes.empty() ? Error{"not enough memory for the picture"}
                      : write_file(settings.path(), bytes, Console(io, console_.options()));
    set_note(written ? fmt::format("wrote {}", settings.path()) : written.error().message);
    changed_ = true;
}

void View::set_note(const std::string& note) {
    note_ = note;
    note_since_ = SteadyClock::now();
    console_.info(note);
}

bool View::drop_old_note(SteadyClock::time_point now) {
    if (note_.empty() || now - note_since_ < kNoteTime) {
        return false;
    }
    note_.clear();
    return true;
}

} // namespace lsys::view
