// SPDX-License-Identifier: MIT
// Results of a command line that runs no command. Not part of option_parsers.h, because that header
// includes CLI11, which takes seconds to compile and which code that uses options does not need.
#pragma once

#include <string>

namespace lsys {

/// Text to print instead of running a command: --help, --version.
struct PrintText {
    std::string text;
    bool with_build = false; // print describe_build() too
};

/// A mistake in a command line.
struct UsageError {
    std::string message;
    std::string help;
};

} // namespace lsys
