// SPDX-License-Identifier: MIT
// Words of L3D: a `(` directly after a command begins the text of its parameter, up to the first
// `)`. So a command is executed when the next module, or this `)`, is read.
#pragma once

#include "runtime/turtle/impl/actions.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace lsys {

/// Meaning of a module of a word of L3D.
enum class TextStep : std::uint8_t {
    Text,      // belongs to the parameter of the pending command
    Parameter, // ends the parameter, which parameter() returns: the pending command is complete
    Command,   // a command, before which a pending one is executed
};

/// The last command read. Both turtles derive a struct from it, with more members.
struct TextCommand {
    static constexpr std::size_t kMaxLength = 1023; // characters of `text`
    bool is_set = false;                            // a command is pending
    bool in_parameter = false;                      // its `(` has been read, the `)` has not
    std::string text;                               // of the parameter

    /// Reads the next module.
    [[nodiscard]] TextStep take(const Action& action);
    /// The number at the start of the text, after blanks and a sign; 0 if there is none. No value
    /// if the number is 1, `is_compatible` is true, and 1 means the default of `command` in L3D.
    [[nodiscard]] std::optional<float> parameter(TurtleOperation command, bool is_compatible) const;
};

} // namespace lsys
