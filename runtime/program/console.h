// SPDX-License-Identifier: MIT
// Console: prints results to standard output, and messages to standard error in the format of the
// options. The public library collects messages instead.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/outcome.h"
#include "grammar/base/result.h"
#include "grammar/base/source.h"
#include "runtime/program/exit_status.h"
#include "runtime/program/io.h"
#include "runtime/program/message_options.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace lsys {

class Console {
public:
    Console(const Io& io, const MessageOptions& options);
    /// Collects all messages in `collected`, which outlives the console, and prints none.
    Console(const Io& io, const MessageOptions& options, Messages& collected);

    [[nodiscard]] const Io& io() const { return io_; }
    [[nodiscard]] const MessageOptions& options() const { return options_; }
    /// Whether the user has requested the end of the program.
    [[nodiscard]] bool interrupted() const;
    /// Whether a progress bar may be drawn.
    [[nodiscard]] bool shows_progress() const;

    /// Prints `lsc: error: message`, or a JSON object.
    void error(std::string_view message) const;
    /// Prints `lsc: help: message` after an error. In JSON prints nothing.
    void help(std::string_view message) const;
    /// Prints a note, for example about written files, unless --quiet.
    void info(std::string_view message) const;
    /// Prints a line such as `file:line:col: ...` to standard error, without the name of the
    /// program before it, unless --quiet.
    void line(std::string_view text) const;
    /// Prints lines of JSON to standard error, unless --quiet.
    void records(std::string_view lines) const;
    /// Prints a note about the progress of the work, only with --verbose.
    void detail(std::string_view message) const;

    /// Prints the messages of a step.
    void show(const Messages& messages) const;
    /// Prints the messages of a step and moves its value to `value`; returns its exit status.
    template <typename T>
    [[nodiscard]] ExitStatus take(Outcome<T> outcome, T& value) const {
        show(outcome.messages());
        if (!outcome) {
            return status_of(outcome.stop());
        }
        value = std::move(outcome.value());
        return ExitStatus::Ok;
    }
    /// Overload for a step without a value.
    [[nodiscard]] ExitStatus take(const Outcome<void>& outcome) const {
        show(outcome.messages());
        return outcome ? ExitStatus::Ok : status_of(outcome.stop());
    }
    /// Prints one diagnostic without a place; returns `status`.
    [[nodiscard]] ExitStatus show(Diagnostic diagnostic, ExitStatus status) const;
    /// Sorts the diagnostics, applies the levels, and prints them, with --quiet only errors.
    /// Returns AuthorErrors if there are errors, Limit if one of them is a limit, else Ok.
    [[nodiscard]] ExitStatus show(Diagnostics& diagnostics, const SourceMap& sources) const;
    [[nodiscard]] RenderOptions render_options() const;

    /// Counts bytes to be written against Io::output_budget. An Error if they exceed it.
    [[nodiscard]] Result<void> take_output(std::size_t bytes) const;
    /// Writes a result to standard output.
    [[nodiscard]] Result<void> write(std::string_view text) const;
    /// Flushes standard output.
    [[nodiscard]] Result<void> flush() const;

    /// Flushes standard output at the end of a command. Returns the exit status for a command that
    /// ended with `status`.
    [[nodiscard]] ExitStatus finish(ExitStatus status) const;

private:
    void print(const Diagnostics& diagnostics, const SourceMap& sources) const;
    void print_message(std::string_view severity, std::string_view message) const;

    Io io_;
    MessageOptions options_;
    Messages* collected_ = nullptr; // null: messages are printed
};

/// The text that a Console of the program `program` prints for the messages, in colour with
/// ColourMode::Always only.
[[nodiscard]] std::string
messages_text(const Messages& messages, const MessageOptions& options, const char* program);

/// Prints `error`; returns Failure, or Limit for ErrorKind::Limit.
[[nodiscard]] ExitStatus report_error(const Error& error, const Console& console);
/// Prints the error of `result`, if it has one; returns its exit status.
[[nodiscard]] ExitStatus report_result(const Result<void>& result, const Console& console);

} // namespace lsys
