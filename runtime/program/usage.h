// Results of a command line that runs no command. Apart from option_parsers.h, because CLI11 takes
// seconds to parse and readers of options need none of it.
#pragma once

#include <string>

namespace lsys {

/// Text to print instead of running a command: --help, --version.
struct PrintText {
    std::string text;
};

/// A mistake in a command line.
struct UsageError {
    std::string message;
    std::string help;
};

} // namespace lsys
