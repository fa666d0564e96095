// SPDX-License-Identifier: MIT
// The frame of a message: source lines with line numbers and marks under the spans. Used by
// render_diagnostic.cpp.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <string>
#include <string_view>
#include <vector>

namespace lsys::rendering {

/// Escape sequences that switch colours; all empty without colour.
struct Palette {
    std::string_view error;
    std::string_view warning;
    std::string_view note;
    std::string_view help;
    std::string_view gutter; // line numbers and the bar after them
    std::string_view strong; // text in bold
    std::string_view reset;
};
/// `colour`: false for a palette of empty texts.
[[nodiscard]] const Palette& palette(bool colour);
[[nodiscard]] std::string_view colour_of(Severity severity, const Palette& colours);

/// A marked place of a frame.
struct Mark {
    SourceSpan span;
    char character = '^';
    std::string_view text; // text to print after the marks; may be empty
    std::string_view colour;
};

/// Appends the source lines of `primary` with its marks. If `primary` lies in one line, also
/// appends the marks of `others` in the shown part of that line. Returns the marks not shown.
[[nodiscard]] std::vector<Mark> append_frame(const Mark& primary,
                                             const std::vector<Mark>& others,
                                             const SourceFile& file,
                                             const Palette& colours,
                                             std::string& out);

/// Appends the lines that `fix` changes as they read afterwards, with marks under the new text.
void append_fix(const Fix& fix, const SourceMap& sources, const Palette& colours, std::string& out);

} // namespace lsys::rendering
