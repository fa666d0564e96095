// SPDX-License-Identifier: MIT
#include "viewer/app/source_pane.h"

#include "grammar/base/counted_text.h"
#include "grammar/base/utf8.h"
#include "runtime/program/arguments.h"
#include "runtime/program/files.h"
#include "viewer/app/recent_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace lsys::view {

namespace {

constexpr std::uint32_t kPageRows = 20;

/// Number of bytes of the beginning of `text` that fit into `columns`: up to the last blank that
/// fits or, without blanks, all that fit.
std::size_t fitting(std::string_view text, std::uint32_t columns) {
    std::size_t at = 0;
    std::size_t blank = 0;
    for (std::uint32_t used = 0; at < text.size();) {
        const CodePoint point = decode_utf8(text.substr(at));
        used += display_width(point.value);
        if (used > columns) {
            return blank != 0 ? blank : std::max<std::size_t>(at, point.length);
        }
        at += point.length;
        if (text[at - 1] == ' ') {
            blank = at;
        }
    }
    return at;
}

} // namespace

SourcePaneLook read_source_look(const std::string& folder) {
    constexpr std::uint64_t kMaxBytes = 100;
    SourcePaneLook look;
    const Result<std::string> text =
        folder.empty() ? Result<std::string>(std::string())
                       : read_bytes(folder + "/source", FileKind::Regular, {kMaxBytes}, nullptr);
    if (text) {
        const std::string& words = text.value();
        const std::size_t blank = std::min(words.find(' '), words.size());
        const Result<float> width =
            parse_number(words.substr(0, blank), kMinSourceWidth, kMaxSourceWidth);
        look.width = width ? width.value() : look.width;
        look.is_shown = words.substr(blank) == " shown\n";
    }
    return look;
}

void write_source_look(const std::string& folder,
                       const SourcePaneLook& look,
                       const Console& console) {
    if (!folder.empty()) {
        write_state(folder + "/source",
                    fmt::format("{} {}\n", look.width, look.is_shown ? "shown" : "hidden"),
                    console);
    }
}

std::vector<TextLine> wrapped(const TextLine& line, std::uint32_t columns) {
    std::vector<TextLine> lines(1);
    std::uint32_t left = columns;
    for (const TextRun& run : line) {
        for (std::string_view text = run.text; !text.empty();) {
            std::size_t bytes = fitting(text, left);
            const bool is_whole = bytes == text.size();
            if (!is_whole && left < columns && text[bytes - 1] != ' ') {
                bytes = 0; // the word fits on the next line
            }
            if (bytes != 0) {
                lines.back().push_back({run.colour, std::string(text.substr(0, bytes))});
            }
            text.remove_prefix(bytes);
            if (is_whole) {
                left -= std::min(left, text_width(lines.back().back().text));
            } else {
                lines.emplace_back();
                left = columns;
            }
        }
    }
    return lines;
}

std::string expanded(std::string_view text, std::uint32_t column) {
    if (text.find('\t') == std::string_view::npos) {
        return std::string(text);
    }
    std::string line;
    while (!text.empty()) {
        const CodePoint point = decode_utf8(text);
        if (text.front() == '\t') {
            const std::uint32_t width = kPaneTabStop - column % kPaneTabStop;
            line.append(width, ' ');
            column += width;
        } else {
            line += text.substr(0, point.length);
            column += display_width(point.value);
        }
        text.remove_prefix(point.length);
    }
    return line;
}

bool SourcePane::update(View& view, const std::function<void()>& wake) {
    if (!look.is_shown) {
        return false;
    }
    if (view.taken_request_count() != 0 &&
        (requested_file_ != view.loaded_file() || requested_load_ != view.taken_request_count())) {
        if (worker_ == nullptr) {
            worker_ = std::make_unique<SourceWorker>(make_source_text, wake);
        }
        requested_file_ = view.loaded_file();
        requested_load_ = view.taken_request_count();
        worker_->request({view.loaded_sources(), SteadyClock::now(), false});
    }
    bool has_new_content = false;
    if (worker_ != nullptr) {
        if (std::optional<std::shared_ptr<const SourceText>> text = worker_->take()) {
            take(std::move(*text), view);
            has_new_content = true;
        }
    }
    if (followed_pick_ != view.pick_count() && text_ != nullptr && !worker_->is_busy()) {
        followed_pick_ = view.pick_count();
        highlighted_ = {};
        if (view.picked().place && !view.failed()) {
            show(*view.picked().place);
            const ShownSource* const shown = source();
            if (shown != nullptr && shown->path == view.picked().place->file) {
                highlighted_ =
                    statement_at(*shown, view.picked().place->line, view.picked().place->column);
                view.console().detail(fmt::format("source: {}:{} to {}", shown->path,
                                                  highlighted_.first, highlighted_.last));
            }
        }
        has_new_content = true;
    }
    if (view.picked().lines.empty() && highlighted_.first != 0) {
        highlighted_ = {};
        has_new_content = true;
    }
    return has_new_content;
}

void SourcePane::take(std::shared_ptr<const SourceText> text, View& view) {
    const ShownSource* const before = source();
    const std::string path = before == nullptr ? std::string() : before->path;
    const bool is_same_view = std::exchange(shown_file_, requested_file_) == requested_file_;
    const std::string_view old_text = before == nullptr ? std::string_view() : before->file->text();
    const std::size_t index = is_same_view ? text->find(path).value_or(0) : 0;
    const bool is_same_text = is_same_view && index < text->files.size() &&
                              text->files[index].path == path &&
                              text->files[index].file->text() == old_text;
    const std::shared_ptr<const SourceText> kept = std::exchange(text_, std::move(text));
    file_index_ = index;
    columns_ = 0;
    if (!is_same_text) {
        highlighted_ = {};
    }
    if (!is_same_view) {
        anchor_ = 0;
        selected_ = 0;
        target_ = 1;
    }
    const ShownSource* const shown = source();
    const std::uint32_t lines = shown == nullptr ? 0 : shown->file->line_count();
    anchor_ = std::min(anchor_, lines);
    selected_ = std::min(selected_, lines);
    std::size_t count = 0;
    std::string first_error;
    for (std::size_t i = 0; i < text_->files.size(); ++i) {
        for (const SourceMessage& message : text_->files[i].messages) {
            ++count;
            if (message.severity == Severity::Error && first_error.empty()) {
                first_error = fmt::format("{}:{}:{}: {}", text_->files[i].path, message.line,
                                          message.column, plain_text(message.text.front()));
                if (first_error != first_error_) { // this error has not been shown before
                    file_index_ = i;
                    target_ = message.line;
                }
            }
        }
    }
    first_error_ = std::move(first_error);
    view.console().detail(fmt::format("source: {}, {}", counted(text_->files.size(), "file"),
                                      counted(count, "message")));
}

const ShownSource* SourcePane::source() const {
    return text_ != nullptr && file_index_ < text_->files.size() ? &text_->files[file_index_]
                                                                 : nullptr;
}

void SourcePane::select_file(std::size_t file) {
    if (file == file_index_) {
        return;
    }
    file_index_ = file;
    columns_ = 0;
    anchor_ = 0;
    selected_ = 0;
    highlighted_ = {};
    target_ = 1;
}

void SourcePane::select_line(std::uint32_t line, bool extends) {
    const ShownSource* const shown = source();
    if (shown == nullptr) {
        return;
    }
    selected_ = std::clamp(line, 1U, shown->file->line_count());
    if (!extends || anchor_ == 0) {
        anchor_ = selected_;
    }
}

LineRange SourcePane::selected() const {
    return {std::min(anchor_, selected_), std::max(anchor_, selected_)};
}

void SourcePane::show(const FilePosition& place) {
    const std::optional<std::size_t> file =
        text_ == nullptr ? std::nullopt : text_->find(place.file);
    if (!file) {
        return;
    }
    select_file(*file);
    select_line(place.line, false);
    target_ = selected_;
}

void SourcePane::go_to_message(int step, View& view) {
    using Place = std::pair<std::size_t, std::uint32_t>; // file and line
    std::vector<Place> places;
    for (std::size_t i = 0; text_ != nullptr && i < text_->files.size(); ++i) {
        for (const SourceMessage& message : text_->files[i].messages) {
            if (places.empty() || places.back() != Place{i, message.line}) {
                places.emplace_back(i, message.line);
            }
        }
    }
    if (places.empty()) {
        view.set_note(text_ == nullptr ? "The source is being read"
                                       : "There are no messages in the source");
        return;
    }
    const Place here{file_index_, selected_};
    const auto next = step > 0 ? std::upper_bound(places.begin(), places.end(), here)
                               : std::lower_bound(places.begin(), places.end(), here);
    const Place to = step > 0 ? (next == places.end() ? places.front() : *next)
                              : (next == places.begin() ? places.back() : *std::prev(next));
    show({text_->files[to.first].path, to.second, 1});
}

bool SourcePane::press(const KeyPress& press) {
    const ShownSource* const shown = source();
    if (shown == nullptr || press.control || press.alt) {
        return false;
    }
    const std::uint32_t now = std::max(selected_, 1U);
    const std::uint32_t last = shown->file->line_count();
    std::uint32_t to = now;
    switch (press.key) {
    case Key::Up:
        to = selected_ == 0 ? 1 : now - 1;
        break;
    case Key::Down:
        to = selected_ == 0 ? 1 : now + 1;
        break;
    case Key::PageUp:
        to = now - std::min(now - 1, kPageRows);
        break;
    case Key::PageDown:
        to = now + kPageRows;
        break;
    case Key::Home:
        to = 1;
        break;
    case Key::End:
        to = last;
        break;
    default:
        return false;
    }
    select_line(std::clamp(to, 1U, last), press.shift);
    target_ = selected_;
    return true;
}

FilePosition SourcePane::place_to_open(const View& view) const {
    const ShownSource* const shown = source();
    if (look.is_shown && shown != nullptr && selected_ != 0) {
        FilePosition place{shown->path, selected_, 1};
        for (const SourceMessage& message : shown->messages) {
            if (message.line == selected_) {
                place.column = message.column;
                break;
            }
        }
        return place;
    }
    if (view.picked().place) {
        return *view.picked().place;
    }
    for (const ShownMessage& message : view.entries()) {
        if (message.place) {
            return *message.place;
        }
    }
    return {view.path(), 1, 1};
}

std::string SourcePane::selected_text() const {
    std::string text;
    const ShownSource* const shown = source();
    const LineRange lines = selected();
    for (std::uint32_t i = std::max(lines.first, 1U);
         shown != nullptr && lines.first != 0 && i <= lines.last; ++i) {
        text += shown->file->line_text(i);
        text += '\n';
    }
    return text;
}

std::optional<std::uint32_t> SourcePane::take_target() {
    return std::exchange(target_, std::nullopt);
}

void SourcePane::lay_out(std::uint32_t columns) {
    if (columns == columns_) {
        return;
    }
    columns_ = columns;
    rows_.clear();
    texts_.clear();
    const ShownSource* const shown = source();
    if (shown == nullptr) {
        return;
    }
    const auto add_text = [&](SourceRow row, TextLine text) {
        row.index = static_cast<std::uint32_t>(texts_.size());
        texts_.push_back(std::move(text));
        rows_.push_back(row);
    };
    std::uint32_t next = 0; // index of the next message
    const std::uint32_t lines = shown->file->line_count();
    rows_.reserve(lines);
    for (std::uint32_t line = 1; line <= lines; ++line) {
        rows_.push_back({SourceRow::Kind::Line, line, 0, 0});
        for (; next < shown->messages.size() && shown->messages[next].line == line; ++next) {
            const SourceMessage& message = shown->messages[next];
            const std::string_view text_before =
                shown->file->line_text(line).substr(0, message.begin);
            const std::uint32_t begin = text_width(expanded(text_before, 0));
            const bool fits =
                begin + (message.end - message.begin) + 2 + text_width(message.label) <= columns;
            rows_.push_back({SourceRow::Kind::Marks, line, next, fits ? 1U : 0U});
            if (!fits && !message.label.empty()) {
                const TextColour colour = message.text.front().front().colour;
                for (TextLine& part : wrapped({{colour, message.label}}, columns)) {
                    add_text({SourceRow::Kind::Text, line, next, 0}, std::move(part));
                }
            }
            for (const TextLine& text : message.text) {
                for (TextLine& part : wrapped(text, columns)) {
                    add_text({SourceRow::Kind::Text, line, next, 0}, std::move(part));
                }
            }
            for (std::uint32_t i = 0; i < message.fixes.size(); ++i) {
                rows_.push_back({SourceRow::Kind::Fix, line, next, i});
                for (const TextLine& text : message.fixes[i].preview) {
                    add_text({SourceRow::Kind::Preview, line, next, 0}, text);
                }
            }
        }
    }
}

void SourcePane::apply(const SourceFix& fix, PlantView& view) const {
    std::vector<FileChange> changes;
    std::string where;
    for (const auto& [path, edits] : fix.edits) {
        const std::optional<std::size_t> file = text_->find(path);
        if (!file) {
            view.set_note(fmt::format("not written: `{}` is not shown", path));
            return;
        }
        const SourceFile& source = *text_->files[*file].file;
        if (where.empty()) {
            where = fmt::format("{}:{}", path, source.line_column(edits.front().span.begin).line);
        }
        changes.push_back({path, file_bytes(source), edited_bytes(source, edits)});
    }
    view.change_files(std::move(changes), fmt::format("fixed {}: {}", where, fix.title));
}

const SourceFix* SourcePane::fix_here() const {
    const ShownSource* const shown = source();
    const SourceFix* best = nullptr;
    for (std::size_t i = 0; shown != nullptr && i < shown->messages.size(); ++i) {
        for (const SourceFix& fix : shown->messages[i].fixes) {
            if (shown->messages[i].line == selected_ && fix.refusal.empty() &&
                (best == nullptr || (fix.is_certain && !best->is_certain))) {
                best = &fix;
            }
        }
    }
    return best;
}

void SourcePane::apply_here(View& view, PlantView* plant) const {
    const SourceFix* const fix = look.is_shown ? fix_here() : nullptr;
    if (plant == nullptr) {
        view.set_note("Open the grammar alone to apply its fixes");
    } else if (fix == nullptr) {
        view.set_note("The selected line has no fix: F8 goes to the next message");
    } else {
        apply(*fix, *plant);
    }
}

void SourcePane::apply_all(PlantView& view) const {
    std::vector<FileChange> changes;
    for (const auto& [path, bytes] : text_->fixed) {
        const std::optional<std::size_t> file = text_->find(path);
        if (!file) {
            view.set_note(fmt::format("not written: `{}` is not shown", path));
            return;
        }
        changes.push_back({path, file_bytes(*text_->files[*file].file), bytes});
    }
    view.change_files(std::move(changes), fmt::format("applied {} fix{}", text_->fix_count,
                                                      text_->fix_count == 1 ? "" : "es"));
}

} // namespace lsys::view
