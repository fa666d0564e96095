#include "grammar/format.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/files.h"
#include "runtime/cli/grammar_file.h"
#include "runtime/cli/tell.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

namespace fs = std::filesystem;

/// What became of one file.
struct Imported {
    std::string text; // .lsys
    Dialect dialect = Dialect::Lsys;
    std::uint64_t warnings = 0;
};

/// Compiles as every other command does, so that it says the same. Fine: the text derives what the
/// file derives.
Status import_text(const std::string& path,
                   GrammarText text,
                   const ImportCommand& command,
                   const Console& console,
                   Imported& imported) {
    imported.dialect = text.dialect;
    Grammar grammar;
    const Result<Done> compiled =
        compile_text(path, std::move(text), command.grammar, make_loader(console), grammar);
    if (!compiled) {
        return fail(compiled.error(), console);
    }
    const Status status = console.show(grammar.diagnostics, grammar.sources);
    imported.warnings = grammar.diagnostics.count(Severity::Warning);
    if (status == Status::Fine) {
        imported.text = fmt::format(
            "// Imported from `{}`, {}.\n{}", fs::path(shown_path(path)).filename().string(),
            row_of(imported.dialect).title, format_text(grammar.translation));
    }
    return status;
}

Status write_imported(const std::string& path, const std::string& text, const Console& console) {
    const Result<Done> written = write_file(path, text, console);
    return written ? Status::Fine : fail(written.error(), console);
}

/// The regular files of a folder by name.
Result<std::vector<fs::path>> files_of(const std::string& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code ignored;
        if (at->is_regular_file(ignored)) {
            files.push_back(at->path());
        }
    }
    if (error) {
        return Error{fmt::format("cannot read the folder `{}`: {}", folder, error.message())};
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// A line for each file; what is no grammar of a known dialect is passed over.
Status import_folder(const ImportCommand& command, const Console& console) {
    const Result<std::vector<fs::path>> files = files_of(command.folder);
    if (!files) {
        return fail(files.error(), console);
    }
    const fs::path target =
        command.output.empty() ? fs::path(command.folder) : fs::path(command.output);
    std::error_code error;
    fs::create_directories(target, error);
    if (error) {
        return fail(
            Error{fmt::format("cannot make the folder `{}`: {}", target.string(), error.message())},
            console);
    }
    Status status = Status::Fine;
    std::uint64_t done = 0;
    std::uint64_t lost = 0;
    for (const fs::path& path : files.value()) {
        if (console.interrupted()) {
            return Status::Interrupted;
        }
        if (path.extension() == ".lsb") {
            continue;
        }
        Result<GrammarText> text = read_grammar(path.string(), command.grammar.dialect, console);
        if (!text || text.value().dialect == Dialect::Lsys) {
            continue;
        }
        const std::string_view title = row_of(text.value().dialect).title;
        Imported imported;
        Status one =
            import_text(path.string(), std::move(text.value()), command, console, imported);
        const fs::path to = target / path.filename().concat(".lsys");
        if (one == Status::Fine) {
            one = write_imported(to.string(), imported.text, console);
        }
        done += one == Status::Fine ? 1U : 0U;
        lost += one == Status::Fine ? 0U : 1U;
        const std::string line =
            one == Status::Fine ? fmt::format("{}: {}, {} warnings, written to {}\n", path.string(),
                                              title, imported.warnings, to.string())
                                : fmt::format("{}: {}, not imported\n", path.string(), title);
        if (const Result<Done> written = console.write(line); !written) {
            return fail(written.error(), console);
        }
        status = worse(status, one);
    }
    const Result<Done> written = console.write(fmt::format("{} imported, {} not\n", done, lost));
    return written ? status : fail(written.error(), console);
}

} // namespace

Status run_import(const ImportCommand& command, const Console& console) {
    if (command.file.empty() == command.folder.empty()) {
        return fail(Error{command.file.empty() ? "FILE is missing, or --all FOLDER"
                                               : "FILE and --all do not go together"},
                    console);
    }
    if (!command.folder.empty()) {
        return import_folder(command, console);
    }
    Result<GrammarText> text = read_grammar(command.file, command.grammar.dialect, console);
    if (!text) {
        return fail(text.error(), console);
    }
    if (text.value().dialect == Dialect::Lsys) {
        return fail(Error{fmt::format("`{}` is a .lsys file already", shown_path(command.file))},
                    console);
    }
    Imported imported;
    const Status status =
        import_text(command.file, std::move(text.value()), command, console, imported);
    if (status != Status::Fine) {
        return status;
    }
    return write_imported(command.output.empty() ? "-" : command.output, imported.text, console);
}

} // namespace lsys::lsc
