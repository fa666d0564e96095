// SPDX-License-Identifier: MIT
#include "grammar/format/format.h"
#include "runtime/cli/commands.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace lsys::lsc {

namespace {

ExitStatus
format_file(const std::string& path, const FormatCommand& command, const Console& console) {
    const Project project = make_project(console, command.run);
    GrammarText grammar;
    if (const ExitStatus read = console.take(read_grammar(path, command.dialect, project), grammar);
        read != ExitStatus::Ok) {
        return read;
    }
    if (grammar.dialect != Dialect::Lsys) {
        console.error(fmt::format("`{}` is {}; only .lsys files are laid out", shown_path(path),
                                  row_of(grammar.dialect).title));
        console.help("`lsc import` makes a .lsys file of it");
        return ExitStatus::Failure;
    }
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileLoader load = make_include_loader(project);
    const std::string before = grammar.bytes;
    const FileId file = sources.add(shown_path(path), std::move(grammar.bytes));
    const ParseContext context{sources, names, diagnostics, load};
    const std::optional<std::string> text =
        check_is_lsys(file, context) ? format_lsys(file, context) : std::nullopt;
    if (!text) { // a text with syntax errors is not formatted; the messages show them
        return console.show(diagnostics, sources);
    }
    if (command.check) {
        if (*text != before) {
            console.line(fmt::format("{}: not formatted", shown_path(path)));
            return ExitStatus::AuthorErrors;
        }
        return ExitStatus::Ok;
    }
    if (path != "-" && *text == before) {
        return ExitStatus::Ok;
    }
    if (Result<void> written = rewrite_file(path, *text, console); !written) {
        return report_error(written.error(), console);
    }
    if (path != "-") {
        console.detail(fmt::format("`{}`: formatted", shown_path(path)));
    }
    return ExitStatus::Ok;
}

} // namespace

ExitStatus run_command(const FormatCommand& command, const Console& console) {
    ExitStatus status = ExitStatus::Ok;
    for (const std::string& path : command.files) {
        status = more_severe(status, format_file(path, command, console));
        if (console.interrupted()) {
            return ExitStatus::Interrupted;
        }
    }
    return status;
}

} // namespace lsys::lsc
