// The frame of a message: source lines with a gutter of line numbers and marks under what is meant.
// Made by render_diagnostic.cpp for people; nothing else reads it.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <string>
#include <string_view>
#include <vector>

namespace lsys::rendering {

/// What switches colours on and off; all empty without colour.
struct Palette {
    std::string_view error;
    std::string_view warning;
    std::string_view note;
    std::string_view help;
    std::string_view gutter;
    std::string_view strong;
    std::string_view reset;
};
[[nodiscard]] const Palette& palette(bool colour);
[[nodiscard]] std::string_view colour_of(Severity severity, const Palette& colours);

/// A place that is marked in a frame.
struct Mark {
    SourceSpan span;
    char character = '^';
    std::string_view text; // stands after the marks; may be empty
    std::string_view colour;
};

/// Appends the lines of `primary`, marked. Of `others` it marks those that lie in its first line as
/// far as that is shown, and returns the rest.
[[nodiscard]] std::vector<Mark> append_frame(const Mark& primary,
                                             const std::vector<Mark>& others,
                                             const SourceFile& file,
                                             const Palette& colours,
                                             std::string& out);

/// Appends the lines as they would read after `fix`, with what is new marked.
void append_fix(const Fix& fix, const SourceMap& sources, const Palette& colours, std::string& out);

} // namespace lsys::rendering
