// SPDX-License-Identifier: MIT
// ShellProgram: a shell command that runs as a child process and answers each line of text with a
// line.
#pragma once

#include "runtime/platform/file.h"

#include <atomic>
#include <cstdint>
#include <string>

namespace lsys::platform {

class ShellProgram {
public:
    ShellProgram() = default;
    /// Ends the program and the processes of its process group.
    ~ShellProgram();
    ShellProgram(const ShellProgram&) = delete;
    ShellProgram& operator=(const ShellProgram&) = delete;

    /// Runs `command` by /bin/sh, in a process group of its own. Returns ENOSYS on systems that
    /// cannot. Call it at most once.
    [[nodiscard]] Reason start(const std::string& command);

    enum class Reply : std::uint8_t {
        Line,      // a line, without its end
        Ended,     // the program has ended or has closed its standard output; see exit_text()
        TimedOut,  // no line within `seconds`
        TooLong,   // a line of more than `max_bytes`
        Cancelled, // `cancelled` became true
        Failed,    // an error of the system
    };
    /// Writes `line` and a line break to the standard input of the program and waits for a line of
    /// its standard output. After any reply but Line the program is ended.
    [[nodiscard]] Reply ask(const std::string& line,
                            double seconds,
                            std::uint64_t max_bytes,
                            const std::atomic<bool>* cancelled,
                            std::string& answer);

    /// Closes the program's standard input, waits up to half a second for its end, and kills it.
    void finish();

    /// How the program has ended: "exit status 3" or "signal 9"; after Reply::Ended. Empty if it
    /// only closed its output.
    [[nodiscard]] const std::string& exit_text() const { return exit_text_; }
    /// The last characters that the program wrote to its standard error.
    [[nodiscard]] const std::string& messages() const { return messages_; }

private:
    struct Exchange; // a question and its answer so far

    void end(); // kills the program
    /// Writes a part of the question; returns false after an error.
    [[nodiscard]] bool write_some(Exchange& exchange);
    [[nodiscard]] bool read_some(Exchange& exchange); // false at the end of the output
    void read_messages();                             // of standard error
    void wait_for_exit();                             // for at most half a second

    int process_ = 0;       // 0: none
    int input_ = -1;        // our end of the program's standard input, a file descriptor
    int output_ = -1;       // our end of the program's standard output
    int error_ = -1;        // our end of the program's standard error
    std::string read_;      // bytes of standard output that ask() has not returned yet
    std::string messages_;  // the last characters of standard error
    std::string exit_text_; // how the program has ended; empty while it runs
};

/// Ends all running ShellPrograms. Callable in a signal handler.
void end_shell_programs() noexcept;

} // namespace lsys::platform
