// SPDX-License-Identifier: MIT
#include "runtime/cli/commands.h"
#include "runtime/cli/progress.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/trace.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/program/trace_report.h"

#include <string>

namespace lsys::lsc {

namespace {

/// A message about options that are missing or conflict; empty if none.
std::string find_conflict(const TraceCommand& command) {
    const int given = (command.position ? 1 : 0) + (command.module.empty() ? 0 : 1) +
                      (command.name.empty() ? 0 : 1);
    if (given == 0) {
        return "no module is given: say which one with --at POSITION, --module 'A(3)' or "
               "--all NAME";
    }
    if (command.written && command.back) {
        return "--back goes on from the step that --written traces, so only one of them is given";
    }
    if (given > 1) {
        return "--at, --module and --all each say which modules, so only one of them is given";
    }
    return {};
}

/// Reads and compiles the grammar. Here -n names the generation of a module, so the checks of the
/// compiler use the number of generations of `#n`. They use -n for a file without `#n`, and for
/// standard input, which can be read only once.
Outcome<Grammar> load_traced(const TraceCommand& command, const Project& project) {
    GrammarOptions options = command.grammar;
    if (options.generations && !is_standard_input(command.file)) {
        options.generations.reset();
        Outcome<Grammar> loaded = load_grammar(command.file, options, project);
        if (!loaded || loaded.value().bytecode.generations) {
            return loaded;
        }
        options.generations = command.grammar.generations;
    }
    return load_grammar(command.file, options, project);
}

} // namespace

ExitStatus run_command(const TraceCommand& command, const Console& console) {
    if (const std::string conflict = find_conflict(command); !conflict.empty()) {
        return report_error(Error{conflict}, console);
    }
    Grammar grammar;
    Project project = make_project(console, command.run);
    ExitStatus status = console.take(load_traced(command, project), grammar);
    if (status != ExitStatus::Ok) {
        return status;
    }
    TraceOptions options;
    options.file = command.file;
    options.generation = command.grammar.generations;
    options.seed = command.seed;
    options.position = command.position;
    options.module = command.module;
    options.name = command.name;
    options.rows = command.rows;
    options.scope = command.back      ? TraceScope::Back
                    : command.written ? TraceScope::Written
                                      : TraceScope::Next;
    PipelineProgress progress(console, project.host);
    Outcome<Trace> traced = trace_modules(options, grammar, project);
    progress.clear();
    Trace trace;
    status = console.take(std::move(traced), trace);
    if (status != ExitStatus::Ok) {
        return status;
    }
    const TraceFormat format = command.format.value_or(
        command.messages.format == MessageFormat::Json ? TraceFormat::Json : TraceFormat::Text);
    // ColourMode::Auto depends on whether standard error is a terminal. The text goes to standard
    // output, which may be a pipe, so it has colours only on request.
    const bool colour = command.messages.colour == ColourMode::Always;
    const std::string text = format == TraceFormat::Json ? trace_json(trace, grammar)
                                                         : trace_text(trace, grammar, colour);
    status = report_result(write_file(command.output, text, console), console);
    if (status != ExitStatus::Ok) {
        return status;
    }
    if (!trace.agrees) {
        return report_error(Error{"the engine wrote something else than this trace; please report "
                                  "the grammar and the command line"},
                            console);
    }
    return trace.stop ? status_of(*trace.stop) : ExitStatus::Ok;
}

} // namespace lsys::lsc
