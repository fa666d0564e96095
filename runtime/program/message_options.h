// SPDX-License-Identifier: MIT
// The options that decide how messages are printed.
#pragma once

#include "grammar/base/message_levels.h"
#include "grammar/rendering/render_diagnostic.h"

#include <cstdint>

namespace lsys {

enum class ColourMode : std::uint8_t { Auto, Always, Never };

/// Options of every command for its messages.
struct MessageOptions {
    MessageFormat format = MessageFormat::Human;
    ColourMode colour = ColourMode::Auto;
    MessageLevels levels;
    bool quiet = false;   // print errors only, and no progress
    bool verbose = false; // also print steps of the work and their sizes

    friend bool operator==(const MessageOptions&, const MessageOptions&) = default;
};

} // namespace lsys
