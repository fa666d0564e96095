// SPDX-License-Identifier: MIT
#include "runtime/cli/lsc.h"

#include "grammar/base/cancellation.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/cli/command_line.h"
#include "runtime/cli/commands.h"
#include "runtime/program/build_info.h"
#include "runtime/program/limited_run.h"
#include "runtime/program/process.h"
#include "runtime/program/run_files.h"

#include <limits>
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
            RunOptions limits = command.run;
            if constexpr (std::is_same_v<Command, ServeCommand>) { // has a deadline of its own
                limits.max_seconds = std::numeric_limits<double>::infinity();
            }
            return run_within_limits(limits, command.messages, io, [&](const Console& console) {
                return run_cancellable(command, console);
            });
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
