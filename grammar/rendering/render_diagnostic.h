// Diagnostics as text: the frame for people, one line for editors, JSON lines for tools. The only
// place where lines, columns, tab stops and the width of characters matter.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <cstdint>
#include <string>

namespace lsys {

enum class MessageFormat : std::uint8_t {
    Human, // head line, source frame with carets, labels, notes, help
    Short, // file:line:col: severity: text [code]
    Json,  // one object a line
};

struct RenderOptions {
    MessageFormat format = MessageFormat::Human;
    bool colour = false;
    std::uint32_t max_shown = 50; // of one run; a last line says how many more there are
};

/// One diagnostic, with a line end.
void render(const Diagnostic& diagnostic,
            const SourceMap& sources,
            const RenderOptions& options,
            std::string& out);

/// All of them as they stand (sort them first), at most max_shown, then how many more.
void render_all(const Diagnostics& diagnostics,
                const SourceMap& sources,
                const RenderOptions& options,
                std::string& out);

} // namespace lsys
