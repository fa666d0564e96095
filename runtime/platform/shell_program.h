// SPDX-License-Identifier: MIT
// ShellProgram: a command line of the shell that runs beside this process and answers lines of text.
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

    /// Runs `command` by /bin/sh, in a process group of its own. Returns ENOSYS on systems without
    /// it. Called at most once.
    [[nodiscard]] Reason start(const std::string& command);

    enum class Reply : std::uint8_t {
        Line,      // a line, without its end
        Ended,     // the program has ended or has closed its standard output; see exit_text()
        TimedOut,  // no line within the time
        TooLong,   // a line of more than the max bytes
        Cancelled, // by the flag
        Failed,    // an error of the system
    };
    /// Writes `line` and a line break to the standard input of the program and waits for a line of
    /// its standard output. After any reply but Line the program is ended.
    [[nodiscard]] Reply ask(const std::string& line,
                            double seconds,
                            std::uint64_t max_bytes,
                            const std::atomic<bool>* cancelled,
                            std::string& answer);

    /// Closes the standard input of the program, which has half a second to end, and ends it.
    void finish();

    /// How the program has ended: "exit status 3" or "signal 9"; after Reply::Ended.
    [[nodiscard]] const std::string& exit_text() const { return exit_text_; }
    /// The last characters of its standard error.
    [[nodiscard]] const std::string& messages() const { return messages_; }

private:
    struct Exchange;

    void end();
    [[nodiscard]] bool write_some(Exchange& exchange);
    [[nodiscard]] bool read_some(Exchange& exchange);
    void read_messages();
    void wait_for_exit();

    int process_ = 0;  // 0: none
    int input_ = -1;   // descriptor of our end of its standard input
    int output_ = -1;  // of its standard output
    int error_ = -1;   // of its standard error
    std::string read_; // of its standard output, not yet returned
    std::string messages_;
    std::string exit_text_;
};

/// Ends all programs that run, from a signal handler.
void end_shell_programs() noexcept;

} // namespace lsys::platform
