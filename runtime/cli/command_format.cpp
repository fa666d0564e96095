#include "grammar/format.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/files.h"
#include "runtime/cli/grammar_file.h"
#include "runtime/cli/memory_size.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace lsys::lsc {

namespace {

Status format_file(const std::string& path, const FormatCommand& command, const Console& console) {
    Result<GrammarText> grammar = read_grammar(path, command.dialect, console);
    if (!grammar) {
        console.error(grammar.error().message);
        return Status::Failure;
    }
    if (grammar.value().dialect != Dialect::Lsys) {
        console.error(fmt::format("`{}` is {}; only .lsys files are laid out", shown_path(path),
                                  row_of(grammar.value().dialect).title));
        console.help("`lsc import` makes a .lsys file of it");
        return Status::Failure;
    }
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    const FileLoader load = make_loader(half_of_memory(), console);
    const std::string before = grammar.value().bytes;
    const FileId file = sources.add(shown_path(path), std::move(grammar.value().bytes));
    const std::optional<std::string> text = format_lsys(file, {sources, names, diagnostics, load});
    if (!text) { // nothing is written; the messages say why
        return console.show(diagnostics, sources);
    }
    if (command.check) {
        if (*text != before) {
            console.line(fmt::format("{}: not formatted", shown_path(path)));
            return Status::AuthorErrors;
        }
        return Status::Fine;
    }
    if (path != "-" && *text == before) {
        return Status::Fine;
    }
    if (Result<Done> written = write_file(path, *text, console); !written) {
        console.error(written.error().message);
        return Status::Failure;
    }
    if (path != "-") {
        console.detail(fmt::format("`{}`: formatted", shown_path(path)));
    }
    return Status::Fine;
}

} // namespace

Status run_format(const FormatCommand& command, const Console& console) {
    Status status = Status::Fine;
    for (const std::string& path : command.files) {
        status = worse(status, format_file(path, command, console));
        if (console.interrupted()) {
            return Status::Interrupted;
        }
    }
    return status;
}

} // namespace lsys::lsc
