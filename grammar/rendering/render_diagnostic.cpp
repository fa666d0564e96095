// SPDX-License-Identifier: MIT
#include "grammar/rendering/render_diagnostic.h"

#include "grammar/base/counted_text.h"
#include "grammar/rendering/impl/excerpt.h"
#include "grammar/rendering/impl/frame.h"
#include "grammar/rendering/impl/json.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace lsys {

namespace {

/// Maximum number of labels in a frame; JSON has them all.
constexpr std::size_t kMaxLabels = 8;

void append_place(SourceSpan span, const SourceMap& sources, std::string& out) {
    const SourceFile& file = sources.file(span.file);
    const LineColumn place = file.line_column(span.begin);
    rendering::append_visible(file.path(), out);
    out += ':';
    out += std::to_string(place.line);
    out += ':';
    out += std::to_string(place.column);
}

void append_head(const Diagnostic& diagnostic,
                 const SourceMap& sources,
                 const RenderOptions& options,
                 std::string& out) {
    const rendering::Palette& colours = rendering::palette(options.colour);
    out += colours.strong;
    if (diagnostic.span.file == kNoFile) {
        out += options.program;
    } else {
        append_place(diagnostic.span, sources, out);
    }
    out += ": ";
    out += colours.reset;
    out += rendering::colour_of(diagnostic.severity, colours);
    out += severity_name(diagnostic.severity);
    out += ": ";
    out += colours.reset;
    out += colours.strong;
    rendering::append_visible(diagnostic.message, out);
    out += colours.reset;
    out += " [";
    out += info(diagnostic.code).name;
    out += "]\n";
}

/// Appends `note: text` in the colour of the kind, without a line end.
void append_remark(std::string_view kind,
                   std::string_view colour,
                   std::string_view text,
                   const rendering::Palette& colours,
                   std::string& out) {
    out += colour;
    out += kind;
    out += ": ";
    out += colours.reset;
    rendering::append_visible(text, out);
}

void append_labels(const std::vector<rendering::Mark>& marks,
                   const SourceMap& sources,
                   const rendering::Palette& colours,
                   std::string& out) {
    for (const rendering::Mark& mark : marks) {
        append_remark("note", colours.note, mark.text, colours, out);
        if (mark.span.file == kNoFile) {
            out += '\n';
            continue;
        }
        out += mark.text.empty() ? "" : ": ";
        append_place(mark.span, sources, out);
        out += '\n';
        rendering::Mark unlabelled = mark;
        unlabelled.text = {};
        static_cast<void>(
            rendering::append_frame(unlabelled, {}, sources.file(mark.span.file), colours, out));
    }
}

void append_human(const Diagnostic& diagnostic,
                  const SourceMap& sources,
                  const RenderOptions& options,
                  std::string& out) {
    const rendering::Palette& colours = rendering::palette(options.colour);
    append_head(diagnostic, sources, options, out);
    std::vector<rendering::Mark> marks;
    for (const Label& label : diagnostic.labels) {
        if (marks.size() < kMaxLabels) {
            marks.push_back({label.span, '-', label.text, colours.note});
        }
    }
    if (diagnostic.span.file != kNoFile) {
        const rendering::Mark primary{diagnostic.span, '^', diagnostic.label,
                                      rendering::colour_of(diagnostic.severity, colours)};
        marks = rendering::append_frame(primary, marks, sources.file(diagnostic.span.file), colours,
                                        out);
    }
    append_labels(marks, sources, colours, out);
    if (diagnostic.labels.size() > kMaxLabels) {
        append_remark("note", colours.note,
                      "and " + counted(diagnostic.labels.size() - kMaxLabels, "more place"),
                      colours, out);
        out += '\n';
    }
    for (const std::string& note : diagnostic.notes) {
        append_remark("note", colours.note, note, colours, out);
        out += '\n';
    }
    for (const std::string& help : diagnostic.help) {
        append_remark("help", colours.help, help, colours, out);
        out += '\n';
    }
    for (const Fix& fix : diagnostic.fixes) {
        append_remark("help", colours.help, fix.title, colours, out);
        out += '\n';
        rendering::append_fix(fix, sources, colours, out);
    }
}

/// The counts of omitted diagnostics as text: `1 more error, 2 more warnings`.
std::string describe_omitted(const std::array<std::uint64_t, 3>& counts) {
    std::string text;
    for (const Severity severity : {Severity::Error, Severity::Warning, Severity::Note}) {
        const std::uint64_t count = counts[static_cast<std::size_t>(severity)];
        if (count == 0) {
            continue;
        }
        text += text.empty() ? "" : ", ";
        text += std::to_string(count);
        text += " more ";
        text += severity_name(severity);
        text += count == 1 ? "" : "s";
    }
    return text;
}

/// Indices of at most `room` diagnostics to print, ascending. Errors are chosen before warnings,
/// and warnings before notes.
std::vector<std::size_t> choose_shown(const std::vector<Diagnostic>& all, std::size_t room) {
    std::vector<std::size_t> shown;
    for (const Severity severity : {Severity::Error, Severity::Warning, Severity::Note}) {
        for (std::size_t i = 0; i < all.size() && shown.size() < room; ++i) {
            if (all[i].severity == severity) {
                shown.push_back(i);
            }
        }
    }
    std::sort(shown.begin(), shown.end());
    return shown;
}

} // namespace

void render(const Diagnostic& diagnostic,
            const SourceMap& sources,
            const RenderOptions& options,
            std::string& out) {
    switch (options.format) {
    case MessageFormat::Human:
        append_human(diagnostic, sources, options, out);
        break;
    case MessageFormat::Short:
        append_head(diagnostic, sources, options, out);
        break;
    case MessageFormat::Json:
        rendering::append_json(diagnostic, sources, out);
        break;
    }
}

void render_frame(const std::vector<Label>& labels,
                  const SourceMap& sources,
                  bool colour,
                  std::string& out) {
    if (labels.empty()) {
        return;
    }
    const rendering::Palette& colours = rendering::palette(colour);
    std::vector<rendering::Mark> marks;
    for (const Label& label : labels) {
        marks.push_back({label.span, marks.empty() ? '^' : '-', label.text, colours.note});
    }
    const rendering::Mark primary = marks.front();
    marks.erase(marks.begin());
    static_cast<void>(
        rendering::append_frame(primary, marks, sources.file(primary.span.file), colours, out));
}

void render_all(const Diagnostics& diagnostics,
                const SourceMap& sources,
                const RenderOptions& options,
                std::string& out) {
    std::array<std::uint64_t, 3> rest{diagnostics.count(Severity::Note),
                                      diagnostics.count(Severity::Warning),
                                      diagnostics.count(Severity::Error)};
    const std::size_t room =
        options.format == MessageFormat::Json ? diagnostics.all().size() : options.max_shown;
    for (const std::size_t index : choose_shown(diagnostics.all(), room)) {
        const Diagnostic& diagnostic = diagnostics.all()[index];
        render(diagnostic, sources, options, out);
        --rest[static_cast<std::size_t>(diagnostic.severity)];
    }
    if (rest == std::array<std::uint64_t, 3>{}) {
        return;
    }
    if (options.format == MessageFormat::Json) {
        rendering::append_json_omitted(rest[2], rest[1], rest[0], out);
    } else {
        out += options.program;
        out += ": " + describe_omitted(rest) + '\n';
    }
}

} // namespace lsys
