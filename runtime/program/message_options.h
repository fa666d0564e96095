// How a program shows its messages.
#pragma once

#include "grammar/rendering/render_diagnostic.h"

#include <cstdint>

namespace lsys {

enum class ColourMode : std::uint8_t { Auto, Always, Never };

/// How messages are shown; every command has these.
struct MessageOptions {
    MessageFormat format = MessageFormat::Human;
    ColourMode colour = ColourMode::Auto;
    bool deny_warnings = false;
    bool quiet = false;   // errors only, no progress
    bool verbose = false; // what is done, and how large it is
};

} // namespace lsys
