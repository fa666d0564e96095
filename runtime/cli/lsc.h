// The `lsc` program as a function, so that tests run it in-process: same arguments, streams and
// exit status as the executable.
#pragma once

#include <atomic>
#include <iosfwd>
#include <span>
#include <string>

namespace lsys::lsc {

/// Where a run reads and writes. Standard output carries results only.
struct Io {
    std::istream& in;
    std::ostream& out;
    std::ostream& err;
    bool err_is_terminal = false; // colour and progress on `auto`
    /// Becomes true on Ctrl-C and other signals to end; the run then ends with 130 as soon as it
    /// can.
    const std::atomic<bool>* interrupted = nullptr;
    const char* program = "lsc"; // that speaks
};

/// Runs `lsc ARGUMENTS...` (without the program's name). Returns the exit status: 0 fine, 1 the
/// author's errors, 2 usage or environment, 3 a limit, 130 interrupted.
[[nodiscard]] int run(std::span<const std::string> arguments, const Io& io);

} // namespace lsys::lsc
