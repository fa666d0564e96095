#include "grammar/format/format.h"
#include "runtime/cli/commands.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
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
ExitStatus import_text(const std::string& path,
                       GrammarText text,
                       const GrammarOptions& options,
                       const RunOptions& run,
                       const Console& console,
                       Imported& imported) {
    const Project project = make_project(console, run);
    imported.dialect = text.dialect;
    Result<CompiledText> compiled = compile_text(path, std::move(text), options,
                                                 project.limits.max_modules, make_loader(project));
    if (!compiled) {
        return report_error(compiled.error(), console);
    }
    CompiledText& made = compiled.value();
    if (made.definition_error) {
        return report_error(*made.definition_error, console);
    }
    const ExitStatus status = console.show(made.diagnostics, *made.grammar.sources);
    imported.warnings = made.diagnostics.count(Severity::Warning);
    if (status == ExitStatus::Ok) {
        imported.text = fmt::format(
            "// Imported from `{}`, {}{}.\n{}", fs::path(shown_path(path)).filename().string(),
            row_of(imported.dialect).title,
            options.system.empty() ? std::string() : fmt::format(": {}", options.system),
            format_text(made.grammar.translation));
    }
    return status;
}

ExitStatus
write_imported(const std::string& path, const std::string& text, const Console& console) {
    const Result<Done> written = write_file(path, text, console);
    return written ? ExitStatus::Ok : report_error(written.error(), console);
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

/// What came of many.
struct Tally {
    ExitStatus status = ExitStatus::Ok;
    std::uint64_t done = 0;
    std::uint64_t lost = 0;
};

/// `name` as that of a file.
std::string file_name(std::string_view name) {
    std::string text;
    for (const char c : name) {
        const bool fits =
            static_cast<unsigned char>(c) > 0x20 && c != '/' && c != '\\' && c != 0x7F;
        text += fits ? c : '_';
    }
    return text.starts_with('.') ? "_" + text : text;
}

/// Imports one system to the file `to`, and says on a line what came of it.
Result<Done> import_one(const std::string& path,
                        GrammarText text,
                        const GrammarOptions& options,
                        const RunOptions& run,
                        const fs::path& to,
                        const Console& console,
                        Tally& tally) {
    const std::string_view title = row_of(text.dialect).title;
    Imported imported;
    ExitStatus one = import_text(path, std::move(text), options, run, console, imported);
    if (one == ExitStatus::Ok) {
        one = write_imported(to.string(), imported.text, console);
    }
    (one == ExitStatus::Ok ? tally.done : tally.lost) += 1;
    tally.status = worse(tally.status, one);
    const std::string what =
        options.system.empty() ? path : fmt::format("{}: `{}`", path, options.system);
    return console.write(one == ExitStatus::Ok
                             ? fmt::format("{}: {}, {} warnings, written to {}\n", what, title,
                                           imported.warnings, to.string())
                             : fmt::format("{}: {}, not imported\n", what, title));
}

/// All systems of a file, each to `folder`/`prefix`NAME.lsys. Of two with one name, whatever the
/// case of its letters, only the first can be asked for.
Result<Done> import_systems(const std::string& path,
                            const GrammarText& text,
                            const ImportCommand& command,
                            const fs::path& folder,
                            const std::string& prefix,
                            const Console& console,
                            Tally& tally) {
    std::set<std::string> known;
    for (const std::string& system : systems_in(text.dialect, text.bytes)) {
        if (console.interrupted()) {
            tally.status = ExitStatus::Interrupted;
            return Done{};
        }
        std::string low = system;
        std::transform(low.begin(), low.end(), low.begin(), [](char c) {
            return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        });
        if (!known.insert(low).second) {
            ++tally.lost;
            tally.status = worse(tally.status, ExitStatus::AuthorErrors);
            if (Result<Done> written = console.write(fmt::format(
                    "{}: `{}`: a second system of this name, not imported\n", path, system));
                !written) {
                return written;
            }
            continue;
        }
        GrammarOptions options = command.grammar;
        options.system = system;
        if (Result<Done> written =
                import_one(path, text, options, command.run,
                           folder / (prefix + file_name(system) + ".lsys"), console, tally);
            !written) {
            return written;
        }
    }
    return Done{};
}

Result<Done> make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    return error ? Result<Done>(Error{fmt::format("cannot make the folder `{}`: {}",
                                                  folder.string(), error.message())})
                 : Done{};
}

ExitStatus end_tally(const Result<Done>& result, const Tally& tally, const Console& console) {
    if (!result) {
        return report_error(result.error(), console);
    }
    if (tally.status == ExitStatus::Interrupted) {
        return tally.status;
    }
    const Result<Done> written =
        console.write(fmt::format("{} imported, {} not\n", tally.done, tally.lost));
    return written ? tally.status : report_error(written.error(), console);
}

/// A line for each system of the files; what is no grammar of a known dialect is passed over.
ExitStatus import_folder(const ImportCommand& command, const Console& console) {
    const Result<std::vector<fs::path>> files = files_of(command.folder);
    if (!files) {
        return report_error(files.error(), console);
    }
    const fs::path target =
        command.output.empty() ? fs::path(command.folder) : fs::path(command.output);
    if (const Result<Done> made = make_folder(target); !made) {
        return report_error(made.error(), console);
    }
    Tally tally;
    for (const fs::path& path : files.value()) {
        if (console.interrupted()) {
            return ExitStatus::Interrupted;
        }
        if (path.extension() == ".lsb") {
            continue;
        }
        Outcome<GrammarText> text = read_grammar(path.string(), command.grammar.dialect,
                                                 make_project(console, command.run));
        if (!text || text.value().dialect == Dialect::Lsys) {
            continue;
        }
        const bool several = has_systems(text.value().dialect) && command.grammar.system.empty() &&
                             systems_in(text.value().dialect, text.value().bytes).size() > 1;
        const std::string name = path.filename().string();
        const Result<Done> result =
            several ? import_systems(path.string(), text.value(), command, target, name + ".",
                                     console, tally)
                    : import_one(path.string(), std::move(text.value()), command.grammar,
                                 command.run, target / (name + ".lsys"), console, tally);
        if (!result) {
            return report_error(result.error(), console);
        }
    }
    return end_tally(Done{}, tally, console);
}

/// `-o FOLDER` of a file of several systems.
ExitStatus
import_to_folder(const ImportCommand& command, const GrammarText& text, const Console& console) {
    if (const Result<Done> made = make_folder(command.output); !made) {
        return report_error(made.error(), console);
    }
    Tally tally;
    const Result<Done> result =
        import_systems(command.file, text, command, command.output, "", console, tally);
    return end_tally(result, tally, console);
}

bool is_folder(const std::string& path) {
    std::error_code error;
    return path.ends_with('/') || (!path.empty() && fs::is_directory(path, error));
}

} // namespace

ExitStatus run_import(const ImportCommand& command, const Console& console) {
    if (command.file.empty() == command.folder.empty()) {
        return report_error(Error{command.file.empty() ? "FILE is missing, or --all FOLDER"
                                                       : "FILE and --all do not go together"},
                            console);
    }
    if (!command.folder.empty()) {
        return import_folder(command, console);
    }
    GrammarText text;
    const ExitStatus read = console.take(
        read_grammar(command.file, command.grammar.dialect, make_project(console, command.run)),
        text);
    if (read != ExitStatus::Ok) {
        return read;
    }
    if (text.dialect == Dialect::Lsys) {
        return report_error(
            Error{fmt::format("`{}` is a .lsys file already", shown_path(command.file))}, console);
    }
    if (has_systems(text.dialect) && command.grammar.system.empty() && is_folder(command.output)) {
        return import_to_folder(command, text, console);
    }
    Imported imported;
    const ExitStatus status =
        import_text(command.file, std::move(text), command.grammar, command.run, console, imported);
    if (status != ExitStatus::Ok) {
        return status;
    }
    return write_imported(command.output.empty() ? "-" : command.output, imported.text, console);
}

} // namespace lsys::lsc
