// SPDX-License-Identifier: MIT
#include "grammar/rendering/impl/frame.h"

#include "grammar/rendering/impl/excerpt.h"

#include <algorithm>
#include <utility>

namespace lsys::rendering {

namespace {

/// Appends the gutter of a line; blank for number 0.
void append_gutter(std::uint32_t number, const Palette& colours, std::string& out) {
    constexpr std::size_t kWidth = 3;
    const std::string digits = number == 0 ? std::string() : std::to_string(number);
    out += colours.gutter;
    out.append(kWidth - std::min(kWidth, digits.size()), ' ');
    out += digits;
    out += " |";
    out += colours.reset;
}

void append_line(std::uint32_t number,
                 const std::string& text,
                 const Palette& colours,
                 std::string& out) {
    append_gutter(number, colours, out);
    if (!text.empty()) {
        out += ' ';
        out += text;
    }
    out += '\n';
}

struct Columns {
    std::uint32_t first = 0;
    std::uint32_t end = 0; // one past the last
};

/// The columns of bytes [begin, end) of the excerpt's line, at least one. For a combining character
/// the column of its base letter.
Columns columns_of(const Excerpt& excerpt, std::size_t begin, std::size_t end) {
    Columns columns{excerpt.column(begin), excerpt.column(end)};
    if (columns.end <= columns.first) {
        const bool combining = end > begin && columns.first > 0;
        columns.first -= combining ? 1U : 0U;
        columns.end = columns.first + 1;
    }
    return columns;
}

void append_marks(Columns columns, const Mark& mark, const Palette& colours, std::string& out) {
    append_gutter(0, colours, out);
    out.append(std::size_t{columns.first} + 1, ' ');
    out += mark.colour;
    out.append(columns.end - columns.first, mark.character);
    if (!mark.text.empty()) {
        out += ' ';
        append_visible(mark.text, out);
    }
    if (!mark.colour.empty()) {
        out += colours.reset;
    }
    out += '\n';
}

/// The span without trailing line ends, which cannot be marked.
SourceSpan trim_line_ends(SourceSpan span, std::string_view text) {
    while (span.end > span.begin && (text[span.end - 1] == '\n' || text[span.end - 1] == '\r')) {
        --span.end;
    }
    return span;
}

bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

} // namespace

const Palette& palette(bool colour) {
    static constexpr Palette kPlain{};
    static constexpr Palette kColoured{"\x1b[1;31m", "\x1b[1;33m", "\x1b[1;36m", "\x1b[1;32m",
                                       "\x1b[1;34m", "\x1b[1m",    "\x1b[0m"};
    return colour ? kColoured : kPlain;
}

std::string_view colour_of(Severity severity, const Palette& colours) {
    switch (severity) {
    case Severity::Error:
        return colours.error;
    case Severity::Warning:
        return colours.warning;
    case Severity::Note:
        return colours.note;
    }
    return colours.note;
}

std::vector<Mark> append_frame(const Mark& primary,
                               const std::vector<Mark>& others,
                               const SourceFile& file,
                               const Palette& colours,
                               std::string& out) {
    const SourceSpan span = trim_line_ends(primary.span, file.text());
    const std::uint32_t first = file.line_column(span.begin).line;
    const std::uint32_t last = file.line_column(span.end).line;
    std::vector<Mark> remaining;
    for (std::uint32_t number = first; number <= last; ++number) {
        if (number == first + 1 && last > first + 2) {
            append_line(0, "...", colours, out);
            number = last;
        }
        const std::string_view text = file.line_text(number);
        const std::size_t line_begin = file.line_begin(number);
        std::size_t begin = number == first ? span.begin - line_begin : 0;
        std::size_t end = number == last ? span.end - line_begin : text.size();
        if (number != first) {
            while (begin < end && is_blank(text[begin])) {
                ++begin;
            }
        }
        const Excerpt excerpt = make_excerpt({text, false, false}, number == first ? begin : end);
        append_line(number, excerpt.text, colours, out);
        if (number == last || begin < end) {
            Mark mark = primary;
            mark.text = number == last ? primary.text : std::string_view();
            append_marks(columns_of(excerpt, begin, end), mark, colours, out);
        }
        if (number != first) {
            continue;
        }
        for (const Mark& other : others) {
            const std::size_t shown_from = line_begin + excerpt.begin;
            const std::size_t shown_to = line_begin + excerpt.end;
            const bool inside = other.span.file == primary.span.file && first == last &&
                                other.span.begin >= shown_from && other.span.end <= shown_to;
            if (inside) {
                append_marks(
                    columns_of(excerpt, other.span.begin - line_begin, other.span.end - line_begin),
                    other, colours, out);
            } else {
                remaining.push_back(other);
            }
        }
    }
    return remaining;
}

// --- fixes

namespace {

constexpr std::size_t kMaxPreviewEdits = 64;
constexpr std::uint32_t kMaxPreviewLines = 6;
/// Bytes around and between edits that a preview reads; more than an excerpt shows.
constexpr std::size_t kReach = std::size_t{4} * kMaxColumns;

/// Adjoining lines as they read after some edits.
struct Preview {
    std::string text;
    // Ranges [first, last) of new bytes in `text`.
    std::vector<std::pair<std::size_t, std::size_t>> added;
    std::vector<char> characters; // `+` or `~` under each range of `added`
    bool more_before = false;
    bool more_after = false;
};

/// The first edits of a fix by position, at most kMaxPreviewEdits.
std::vector<const Edit*> first_edits(const Fix& fix) {
    std::vector<const Edit*> edits;
    edits.reserve(fix.edits.size());
    for (const Edit& edit : fix.edits) {
        edits.push_back(&edit);
    }
    const auto by_place = [](const Edit* a, const Edit* b) {
        return std::pair(a->span.file, a->span.begin) < std::pair(b->span.file, b->span.begin);
    };
    const std::size_t count = std::min(edits.size(), kMaxPreviewEdits);
    const auto middle = edits.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(edits.begin(), middle, edits.end(), by_place);
    edits.resize(count);
    return edits;
}

/// The lines of the edits [first, last), with these edits made.
Preview make_preview(const std::vector<const Edit*>& edits,
                     std::size_t first,
                     std::size_t last,
                     const SourceFile& file) {
    Preview preview;
    const std::string_view text = file.text();
    const SourceSpan first_span = edits[first]->span;
    const SourceSpan last_span = edits[last - 1]->span;
    std::size_t begin = file.line_begin(file.line_column(first_span.begin).line);
    if (first_span.begin - begin > kReach) {
        begin = first_span.begin - kReach;
        preview.more_before = true;
    }
    const std::uint32_t last_line = file.line_column(last_span.end).line;
    std::size_t end = file.line_begin(last_line) + file.line_text(last_line).size();
    end = std::max<std::size_t>(end, last_span.end);
    if (end - last_span.end > kReach) {
        end = last_span.end + kReach;
        preview.more_after = true;
    }
    std::size_t at = begin;
    for (std::size_t i = first; i < last; ++i) {
        const Edit& edit = *edits[i];
        preview.text += text.substr(at, edit.span.begin - at);
        const std::size_t from = preview.text.size();
        preview.text += edit.replacement;
        preview.added.emplace_back(from, preview.text.size());
        preview.characters.push_back(edit.span.begin == edit.span.end ? '+' : '~');
        at = edit.span.end;
    }
    preview.text += text.substr(at, end - at);
    return preview;
}

/// Appends the lines of a preview, the first as line `number`; returns the count of lines.
std::uint32_t append_preview(const Preview& preview,
                             std::uint32_t number,
                             const Palette& colours,
                             std::string& out) {
    std::uint32_t line_count = 0;
    std::size_t begin = 0;
    while (begin <= preview.text.size() && line_count < kMaxPreviewLines) {
        const std::size_t line_end = std::min(preview.text.find('\n', begin), preview.text.size());
        std::size_t end = line_end;
        if (end > begin && preview.text[end - 1] == '\r') {
            --end;
        }
        const bool is_first = begin == 0;
        const bool is_last = line_end == preview.text.size();
        const auto is_on_line = [&](std::size_t i) {
            return preview.added[i].first >= begin && preview.added[i].first <= line_end;
        };
        std::size_t focus = 0;
        for (std::size_t i = preview.added.size(); i-- > 0;) {
            focus = is_on_line(i) ? preview.added[i].first - begin : focus;
        }
        const Excerpt excerpt =
            make_excerpt({std::string_view(preview.text).substr(begin, end - begin),
                          is_first && preview.more_before, is_last && preview.more_after},
                         focus);
        append_line(number + line_count, excerpt.text, colours, out);
        std::string marks;
        for (std::size_t i = 0; i < preview.added.size(); ++i) {
            const std::size_t to = std::min(preview.added[i].second, end);
            if (is_on_line(i) && to > preview.added[i].first) {
                const Columns columns =
                    columns_of(excerpt, preview.added[i].first - begin, to - begin);
                marks.resize(std::max<std::size_t>(marks.size(), columns.end), ' ');
                std::fill(marks.begin() + columns.first, marks.begin() + columns.end,
                          preview.characters[i]);
            }
        }
        if (!marks.empty()) {
            append_gutter(0, colours, out);
            out += ' ';
            out += colours.help;
            out += marks;
            out += colours.reset;
            out += '\n';
        }
        ++line_count;
        begin = line_end + 1;
    }
    return line_count;
}

} // namespace

void append_fix(const Fix& fix,
                const SourceMap& sources,
                const Palette& colours,
                std::string& out) {
    const std::vector<const Edit*> edits = first_edits(fix);
    std::uint32_t shown = 0;
    std::size_t first = 0;
    while (first < edits.size() && shown < kMaxPreviewLines) {
        const SourceFile& file = sources.file(edits[first]->span.file);
        std::size_t last = first + 1;
        std::uint32_t last_line = file.line_column(edits[first]->span.end).line;
        const auto joins = [&](const Edit& next) {
            return next.span.file == edits[first]->span.file &&
                   file.line_column(next.span.begin).line == last_line;
        };
        bool cut = false;
        while (last < edits.size() && joins(*edits[last])) {
            // Edits further than kReach from the first lie outside the excerpt of a very long line.
            cut = cut || edits[last]->span.begin - edits[first]->span.begin > kReach;
            last_line = file.line_column(edits[last]->span.end).line;
            ++last;
        }
        std::size_t near = first + 1;
        while (near < last &&
               (!cut || edits[near]->span.begin - edits[first]->span.begin <= kReach)) {
            ++near;
        }
        shown += append_preview(make_preview(edits, first, near, file),
                                file.line_column(edits[first]->span.begin).line, colours, out);
        first = last;
    }
    if (first < edits.size() || edits.size() < fix.edits.size()) {
        append_line(0, "...", colours, out);
    }
}

} // namespace lsys::rendering
