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
class Dispatch {
public:
    explicit Dispatch(const Io& io) : io_(io) {}

    Status operator()(const PrintText& text) const {
        const Console console(io_, {});
        const Result<Done> written = console.write(text.text);
        if (!written) {
            console.error(written.error().message);
            return Status::Failure;
        }
        return console.finish(Status::Fine);
    }
    Status operator()(const UsageError& usage) const {
        const Console console(io_, {});
        console.error(usage.message);
        console.help(usage.help);
        return Status::Failure;
    }
    Status operator()(const CheckCommand& command) const { return run(run_check, command); }
    Status operator()(const CompileCommand& command) const { return run(run_compile, command); }
    Status operator()(const DumpCommand& command) const { return run(run_dump, command); }
    Status operator()(const ExportCommand& command) const { return run(run_export, command); }
    Status operator()(const ForestCommand& command) const { return run(run_forest, command); }
    Status operator()(const ImportCommand& command) const { return run(run_import, command); }
    Status operator()(const StatsCommand& command) const { return run(run_stats, command); }
    Status operator()(const FormatCommand& command) const { return run(run_format, command); }
    Status operator()(const ExplainCommand& command) const { return run(run_explain, command); }

private:
    template <typename Command>
    [[nodiscard]] Status run(Status (*run_command)(const Command& command, const Console& console),
                             const Command& command) const {
        const Console console(io_, command.messages);
        return console.finish(run_command(command, console));
    }

    const Io& io_;
};

/// Without allocating: there is no memory.
int out_of_memory(const Io& io) {
    io.err << io.program << ": error: out of memory\n" << std::flush;
    return static_cast<int>(Status::Limit);
}

} // namespace

int run(std::span<const std::string> arguments, const Io& io) {
    try {
        const Status status = std::visit(Dispatch{io}, parse_command_line(arguments));
        const bool interrupted =
            io.interrupted != nullptr && io.interrupted->load(std::memory_order_relaxed);
        io.err << (interrupted ? "lsc: interrupted\n" : "") << std::flush;
        return static_cast<int>(interrupted ? Status::Interrupted : status);
    } catch (const std::bad_alloc&) {
        return out_of_memory(io);
    } catch (const std::length_error&) { // what a string or vector throws when it cannot be so long
        return out_of_memory(io);
    }
}

} // namespace lsys::lsc
