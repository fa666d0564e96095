// SPDX-License-Identifier: MIT
// Streams and state of the process, passed to programs so that tests run them in-process.
#pragma once

#include <atomic>
#include <iosfwd>

namespace lsys {

class OutputBudget;
class RunFiles;

/// The streams of a run. Standard output is for results only.
struct Io {
    std::istream& in;
    std::ostream& out;
    std::ostream& err;
    bool err_is_terminal = false; // enables colour and progress
    /// Becomes true after SIGINT, SIGTERM or SIGHUP; the run then ends with status 130. May be
    /// null.
    const std::atomic<bool>* interrupted = nullptr;
    const char* program = "lsc"; // prefix of messages
    /// The commit of the sources, for `--version --verbose`. Set by main(): libraries and tests
    /// that contained it would be linked anew for each commit.
    const char* revision = "unknown";
    /// The limit of `--max-output`; null: none.
    OutputBudget* output_budget = nullptr;
    /// The files of the run: outputs replace none of them. Null: they may.
    RunFiles* files = nullptr;
    /// Prints a line and ends the process at once with status 3; temporary files are removed. Null
    /// in tests, where it would end them.
    void (*end_at_limit)(const char* line) = nullptr;
};

} // namespace lsys
