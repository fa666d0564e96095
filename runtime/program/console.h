// Console: writes results to standard output and messages to standard error, in the form the user
// asked for. Programs print through nothing else.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/outcome.h"
#include "grammar/base/result.h"
#include "grammar/base/source.h"
#include "runtime/program/exit_status.h"
#include "runtime/program/io.h"
#include "runtime/program/message_options.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace lsys {

class Console {
public:
    Console(const Io& io, const MessageOptions& options);

    [[nodiscard]] const Io& io() const { return io_; }
    [[nodiscard]] const MessageOptions& options() const { return options_; }
    [[nodiscard]] bool interrupted() const;
    /// A progress bar may be drawn.
    [[nodiscard]] bool shows_progress() const;

    /// `lsc: error: message`; a JSON object where messages are JSON.
    void error(std::string_view message) const;
    /// `lsc: help: message`, after an error. Nothing in JSON.
    void help(std::string_view message) const;
    /// What has been done to the user's files; not if quiet.
    void info(std::string_view message) const;
    /// A line of its own, `file:line:col: ...`; not if quiet.
    void line(std::string_view text) const;
    /// What is going on; only if verbose.
    void detail(std::string_view message) const;

    /// Prints the messages of a step.
    void show(const Messages& messages) const;
    /// Prints the messages of a step and moves its value, if there is one, to `value`.
    template <typename T>
    [[nodiscard]] ExitStatus take(Outcome<T> outcome, T& value) const {
        show(outcome.messages());
        if (!outcome) {
            return status_of(outcome.stop());
        }
        value = std::move(outcome.value());
        return ExitStatus::Ok;
    }
    /// Prints one diagnostic without a place; returns `status`.
    [[nodiscard]] ExitStatus show(Diagnostic diagnostic, ExitStatus status) const;
    ///    /// Sorts, applies --deny and -q, prints; AuthorErrors if there are errors, Limit if one
    ///    of them
    /// is a limit.
    [[nodiscard]] ExitStatus show(Diagnostics& diagnostics, const SourceMap& sources) const;
    [[nodiscard]] RenderOptions render_options() const;

    /// Writes a result to standard output.
    [[nodiscard]] Result<void> write(std::string_view text) const;
    /// Hands on what standard output still holds back.
    [[nodiscard]] Result<void> flush() const;

    /// The exit status of a command that ended as `status`, once standard output has taken all of
    /// its results.
    [[nodiscard]] ExitStatus finish(ExitStatus status) const;

private:
    void print(const Diagnostics& diagnostics, const SourceMap& sources) const;
    void say(std::string_view severity, std::string_view message) const;

    Io io_;
    MessageOptions options_;
};

/// What a Console of `program` prints of the messages, without colour.
[[nodiscard]] std::string
messages_text(const Messages& messages, const MessageOptions& options, const char* program);

////// Prints an error of the environment; returns Failure, or Limit where memory is missing.
[[nodiscard]] ExitStatus report_error(const Error& error, const Console& console);

} // namespace lsys
