// SPDX-License-Identifier: MIT
#include "runtime/mpi/lsc_mpi.h"

#include "runtime/base/deadline.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/mpi/command_line.h"
#include "runtime/mpi/ranks.h"
#include "runtime/mpi/share_tiles.h"
#include "runtime/program/build_info.h"
#include "runtime/program/output_budget.h"
#include "runtime/program/process.h"
#include "runtime/program/time_limit.h"

#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

namespace lsys::mpi {

namespace {

/// Runs the parsed command. If there is a text or a usage error instead, prints it on rank 0 only.
class Dispatch {
public:
    Dispatch(Ranks& ranks, const Io& io) : ranks_(ranks), io_(io) {}

    ExitStatus operator()(const PrintText& text) const {
        if (!ranks_.leads()) {
            return ExitStatus::Ok;
        }
        const Console console(io_, {});
        const std::string build =
            text.with_build ? describe_build(io_.revision, common_libraries()) : std::string();
        return console.finish(report_result(console.write(text.text + build), console));
    }
    ExitStatus operator()(const UsageError& usage) const {
        if (ranks_.leads()) {
            const Console console(io_, {});
            console.error(usage.message);
            console.help(usage.help);
        }
        return ExitStatus::Failure;
    }
    ExitStatus operator()(lsc::TilesCommand& command) const {
        const std::uint32_t processors = Ranks::processors_per_rank();
        command.run.threads = command.run.threads == 0 ? processors : command.run.threads;
        OutputBudget budget(command.run.max_output);
        Io io = io_;
        io.output_budget = &budget;
        if (!ranks_.leads()) {
            return join_tiles(command, ranks_, io);
        }
        // Rank 0 keeps the time for all ranks. If it cannot stop them in time, its process ends,
        // and mpirun ends the others.
        const std::string late = late_message(command.run.max_seconds);
        std::optional<Deadline> deadline;
        if (std::isfinite(command.run.max_seconds)) {
            deadline.emplace(command.run.max_seconds, io.interrupted, end_process(io, late));
            io.interrupted = deadline->stop();
        }
        const Console console(io, command.messages);
        return console.finish(lead_tiles(command, ranks_, console, [&] {
            return deadline && deadline->has_passed() ? late : std::string();
        }));
    }

private:
    Ranks& ranks_;
    const Io& io_;
};

} // namespace

int run(std::span<const std::string> arguments, const Io& io) {
    Ranks ranks;
    const auto run_line = [&] {
        const std::vector<std::string> leading = ranks.leading_arguments(arguments);
        CommandLine parsed = parse_command_line(leading);
        const ExitStatus status = std::visit(Dispatch{ranks, io}, parsed);
        if (ranks.leads()) {
            io.err << (status == ExitStatus::Interrupted ? "lsc-mpi: interrupted\n" : "")
                   << std::flush;
        }
        return static_cast<int>(status);
    };
    return catch_out_of_memory(run_line, [&] {
        const int status = report_out_of_memory(io);
        ranks.abort(status); // the other ranks would wait for messages of this rank
        return status;
    });
}

} // namespace lsys::mpi
