// SPDX-License-Identifier: MIT
#include "runtime/cli/lsc.h"

#include "grammar/base/cancellation.h"
#include "runtime/base/deadline.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/cli/command_line.h"
#include "runtime/cli/commands.h"
#include "runtime/program/build_info.h"
#include "runtime/program/output_budget.h"
#include "runtime/program/process.h"
#include "runtime/program/run_files.h"
#include "runtime/program/time_limit.h"

#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <type_traits>
#include <variant>

namespace lsys::lsc {

namespace {

/// Runs the command whose options have been parsed, or prints the text or the usage error.
class Dispatch {
public:
    explicit Dispatch(const Io& io) : io_(io) {}

    ExitStatus operator()(const PrintText& text) const {
        const Console console(io_, {});
        const std::string build =
            text.with_build ? describe_build(io_.revision, common_libraries()) : std::string();
        return console.finish(report_result(console.write(text.text + build), console));
    }
    ExitStatus operator()(const UsageError& usage) const {
        const Console console(io_, {});
        console.error(usage.message);
        console.help(usage.help);
        return ExitStatus::Failure;
    }
    template <typename Command>
    ExitStatus operator()(const Command& command) const {
        RunFiles files;
        Io io = io_;
        io.files = &files;
        if constexpr (requires { command.run; }) {
            return run_within_limits(command, io);
        } else {
            const Console console(io, command.messages);
            return console.finish(run_command(command, console));
        }
    }

private:
    /// Runs a command. Parsing and compiling end when the run is interrupted.
    template <typename Command>
    static ExitStatus run_cancellable(const Command& command, const Console& console) {
        const CancellationScope scope(console.io().interrupted);
        try {
            return run_command(command, console);
        } catch (const CompilationCancelled&) {
            return ExitStatus::Interrupted;
        }
    }

    /// Runs a command within `--max-time` and `--max-output`.
    template <typename Command>
    ExitStatus run_within_limits(const Command& command, Io io) const {
        OutputBudget budget(command.run.max_output);
        io.output_budget = &budget;
        const std::string late = late_message(command.run.max_seconds);
        std::optional<Deadline> deadline;
        constexpr bool kIsServer = std::is_same_v<Command, ServeCommand>; // has its own deadline
        if (!kIsServer && std::isfinite(command.run.max_seconds)) {
            deadline.emplace(command.run.max_seconds, io_.interrupted, end_process(io_, late));
            io.interrupted = deadline->stop();
        }
        const Console console(io, command.messages);
        const ExitStatus status = console.finish(run_cancellable(command, console));
        if (deadline && deadline->has_passed()) {
            console.error(late);
            return ExitStatus::Limit;
        }
        return budget.is_exceeded() ? ExitStatus::Limit : status;
    }

    const Io& io_;
};

} // namespace

int run(std::span<const std::string> arguments, const Io& io) {
    const auto run_line = [&] {
        const ExitStatus status = std::visit(Dispatch{io}, parse_command_line(arguments));
        const bool interrupted =
            io.interrupted != nullptr && io.interrupted->load(std::memory_order_relaxed);
        io.err << (interrupted ? "lsc: interrupted\n" : "") << std::flush;
        return static_cast<int>(interrupted ? ExitStatus::Interrupted : status);
    };
    return catch_out_of_memory(run_line, [&] { return report_out_of_memory(io); });
}

} // namespace lsys::lsc
