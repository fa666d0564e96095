#include "runtime/cli/lsc.h"

#include "runtime/cli/command_line.h"
#include "runtime/cli/commands.h"

#include <new>
#include <ostream>
#include <stdexcept>
#include <variant>

namespace lsys::lsc {

namespace {

/// The command that each kind of options belongs to.
struct Dispatch {
    const Io& io;

    ExitStatus operator()(const PrintText& text) const {
        const Console console(io, {});
        Result<Done> written = console.write(text.text);
        if (written) {
            written = console.flush();
        }
        if (!written) {
            console.error(written.error().message);
            return ExitStatus::Failure;
        }
        return ExitStatus::Ok;
    }
    ExitStatus operator()(const UsageError& usage) const {
        const Console console(io, {});
        console.error(usage.message);
        console.help(usage.help);
        return ExitStatus::Failure;
    }
    ExitStatus operator()(const CheckCommand& command) const {
        return run_check(command, {io, command.messages});
    }
    ExitStatus operator()(const CompileCommand& command) const {
        return run_compile(command, {io, command.messages});
    }
    ExitStatus operator()(const DumpCommand& command) const {
        return run_dump(command, {io, command.messages});
    }
    ExitStatus operator()(const ExportCommand& command) const {
        return run_export(command, {io, command.messages});
    }
    ExitStatus operator()(const ForestCommand& command) const {
        return run_forest(command, {io, command.messages});
    }
    ExitStatus operator()(const ImportCommand& command) const {
        return run_import(command, {io, command.messages});
    }
    ExitStatus operator()(const StatsCommand& command) const {
        return run_stats(command, {io, command.messages});
    }
    ExitStatus operator()(const FormatCommand& command) const {
        return run_format(command, {io, command.messages});
    }
    ExitStatus operator()(const ExplainCommand& command) const {
        return run_explain(command, {io, command.messages});
    }
};

/// Without allocating: there is no memory.
int out_of_memory(const Io& io) {
    io.err << io.program << ": error: out of memory\n" << std::flush;
    return static_cast<int>(ExitStatus::Limit);
}

} // namespace

int run(std::span<const std::string> arguments, const Io& io) {
    try {
        const ExitStatus status = std::visit(Dispatch{io}, parse_command_line(arguments));
        const bool interrupted =
            io.interrupted != nullptr && io.interrupted->load(std::memory_order_relaxed);
        io.err << (interrupted ? "lsc: interrupted\n" : "") << std::flush;
        return static_cast<int>(interrupted ? ExitStatus::Interrupted : status);
    } catch (const std::bad_alloc&) {
        return out_of_memory(io);
    } catch (const std::length_error&) { // what a string or vector throws when it cannot be so long
        return out_of_memory(io);
    }
}

} // namespace lsys::lsc
