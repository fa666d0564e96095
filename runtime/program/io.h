// Streams and state of the process around a program, so that tests run programs in-process.
#pragma once

#include <atomic>
#include <iosfwd>

namespace lsys {

/// Where a run reads and writes. Standard output carries results only.
struct Io {
    std::istream& in;
    std::ostream& out;
    std::ostream& err;
    bool err_is_terminal = false; // colour and progress on `auto`
    /// Becomes true on Ctrl-C; the run then ends with 130 as soon as it can.
    const std::atomic<bool>* interrupted = nullptr;
    const char* program = "lsc"; // the name that its messages begin with
};

} // namespace lsys
