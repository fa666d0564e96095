// What a run says: results to standard output, everything else to standard error, in the form the
// user asked for. The commands print through nothing else.
#pragma once

#include "grammar/diagnostic.h"
#include "grammar/result.h"
#include "grammar/source.h"
#include "runtime/cli/lsc.h"
#include "runtime/cli/options.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys::lsc {

/// Exit statuses, the worst last but for Interrupted, which overrides all.
enum class Status : std::uint8_t {
    Fine = 0,
    AuthorErrors = 1,
    Failure = 2,
    Limit = 3,
    Interrupted = 130
};
[[nodiscard]] Status worse(Status a, Status b);

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

    /// Sorts, applies --deny and -q, prints; AuthorErrors if there are errors, Limit if one of them
    /// is a limit.
    [[nodiscard]] Status show(Diagnostics& diagnostics, const SourceMap& sources) const;
    [[nodiscard]] RenderOptions render_options() const;

    /// Writes a result to standard output.
    [[nodiscard]] Result<Done> write(std::string_view text) const;
    /// Hands on what standard output still holds back.
    [[nodiscard]] Result<Done> flush() const;

    /// The exit status of a command that ended as `status`, once standard output has taken all of
    /// its results.
    [[nodiscard]] Status finish(Status status) const;

private:
    void say(std::string_view severity, std::string_view message) const;

    Io io_;
    MessageOptions options_;
};

} // namespace lsys::lsc
