// SPDX-License-Identifier: MIT
// Diagnostics as text: frames for people, lines for editors, JSON for tools. Computes lines and
// columns from the byte offsets of the diagnostics.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

enum class MessageFormat : std::uint8_t {
    Human, // head line, source frame with carets, labels, notes, help
    Short, // file:line:col: severity: text [code]
    Json,  // one object per line
};

struct RenderOptions {
    MessageFormat format = MessageFormat::Human;
    bool colour = false;          // write escape sequences for colours
    std::uint32_t max_shown = 50; // a last line counts the others; JSON has all stored diagnostics
    const char* program = "lsc";  // replaces the path of a diagnostic without a file
};

/// Appends one diagnostic with a line end.
void render(const Diagnostic& diagnostic,
            const SourceMap& sources,
            const RenderOptions& options,
            std::string& out);

/// Appends the frame of a message without its head line: the line of the first label, with marks
/// and texts under all labels that lie in it.
void render_frame(const std::vector<Label>& labels,
                  const SourceMap& sources,
                  bool colour,
                  std::string& out);

/// Appends at most max_shown diagnostics (in JSON all) in the order of the list, which should be
/// sorted, and the number of the others. Errors are chosen before warnings, and warnings before
/// notes.
void render_all(const Diagnostics& diagnostics,
                const SourceMap& sources,
                const RenderOptions& options,
                std::string& out);

} // namespace lsys
