// SPDX-License-Identifier: MIT
#include "grammar/base/counted_text.h"
#include "grammar/base/paths.h"
#include "grammar/dialects/other_language.h"
#include "grammar/format/format.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/import_table.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/named_files.h"
#include "runtime/pipeline/value_edits.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"
#include "runtime/program/run_files.h"

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

/// The translation of one system.
struct Imported {
    std::string text; // a .lsys grammar
    Dialect dialect = Dialect::Lsys;
    std::uint64_t warnings = 0;
    std::string reason; // the first error; empty if the text is complete
};

/// The first error among diagnostics, or an empty text.
std::string first_error(const Diagnostics& diagnostics) {
    for (const Diagnostic& diagnostic : diagnostics.all()) {
        if (diagnostic.severity == Severity::Error) {
            return diagnostic.message;
        }
    }
    return {};
}

/// The first error of an outcome without a value, or an empty text.
std::string first_error(const Messages& messages) {
    for (const Message& message : messages.all()) {
        if (message.kind == Message::Kind::Error) {
            return message.text;
        }
        if (std::string text = first_error(message.diagnostics); !text.empty()) {
            return text;
        }
    }
    return {};
}

/// The name of a file, with `?` for control characters, which could end a `//` comment.
std::string comment_text(const std::filesystem::path& name) {
    std::string text = path_text(name);
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
    std::replace_if(text.begin(), text.end(), is_control, '?');
    return text;
}

/// Prints an error and stores it as the reason why `imported` is incomplete.
ExitStatus fail(const Error& error, const Console& console, Imported& imported) {
    imported.reason = error.message;
    return report_error(error, console);
}

/// A .lsys text with the generations, constants and settings of the command line in place of its
/// own.
Result<std::string> with_options(const std::string& text, const GrammarOptions& options) {
    const FileLoader load = [](const std::string& path) -> Result<std::string> {
        return Error{fmt::format("`{}` is not read here", path)};
    };
    return with_values("translation", text,
                       {options.generations, options.definitions, options.settings}, load);
}

/// Whether binary32, the type of all numbers in a grammar, can represent the number exactly.
bool is_exact(std::uint32_t generations) {
    return static_cast<double>(static_cast<float>(generations)) == static_cast<double>(generations);
}

/// Translates one system and reports its diagnostics. If it returns Ok, `imported.text` derives the
/// same word as the original.
ExitStatus import_text(const std::string& path,
                       GrammarText text,
                       const GrammarOptions& options,
                       const RunOptions& run,
                       const Console& console,
                       Imported& imported) {
    const Project project = make_project(console, run);
    imported.dialect = text.dialect;
    Result<CompiledText> compiled = compile_text(
        path, std::move(text), options, project.limits.max_modules, make_include_loader(project));
    if (!compiled) {
        return fail(compiled.error(), console, imported);
    }
    CompiledText& compiled_text = compiled.value();
    if (compiled_text.definition_error) {
        return fail(*compiled_text.definition_error, console, imported);
    }
    const ExitStatus status =
        console.show(compiled_text.diagnostics, *compiled_text.grammar.sources);
    note_read(console.io().files, named_files(compiled_text.grammar.bytecode, path));
    imported.warnings = compiled_text.diagnostics.count(Severity::Warning);
    imported.reason = first_error(compiled_text.diagnostics);
    if (status == ExitStatus::Ok) {
        const Result<std::string> changed =
            with_options(compiled_text.grammar.translation, options);
        if (!changed) {
            return fail(changed.error(), console, imported);
        }
        imported.text = fmt::format(
            "// Imported from `{}`, {}{}.\n{}", comment_text(path_of(shown_path(path)).filename()),
            row_of(imported.dialect).title,
            options.system.empty() ? std::string() : fmt::format(": {}", options.system),
            format_text(changed.value()));
    }
    return status;
}

ExitStatus
write_imported(const std::string& path, const std::string& text, const Console& console) {
    return report_result(write_file(path, text, console), console);
}

/// The regular files of a folder and its sub-folders, sorted by path, relative to the folder. Skips
/// hidden folders and the folder `except`.
Result<std::vector<fs::path>> files_of(const std::string& folder, const fs::path& except) {
    std::error_code error;
    std::error_code ignored;
    std::vector<fs::path> files;
    const fs::path root = path_of(folder);
    for (fs::recursive_directory_iterator at(root, error), end; !error && at != end;
         at.increment(error)) {
        const bool is_hidden = path_text(at->path().filename()).starts_with('.');
        if (at->is_directory(ignored)) {
            if (is_hidden || fs::equivalent(at->path(), except, ignored)) {
                at.disable_recursion_pending();
            }
        } else if (at->is_regular_file(ignored)) {
            files.push_back(at->path().lexically_relative(root));
        }
    }
    if (error) {
        return Error{fmt::format("cannot read the folder `{}`: {}", folder, error.message())};
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// State of an import of several systems, each to a file named after it.
struct FolderImport {
    const ImportCommand& command;
    const Console& console;
    fs::path folder;
    std::set<std::string> names; // names of the files written by this run
    ExitStatus status = ExitStatus::Ok;
    ImportTable table{};
};

/// `name` with `_` in place of blanks, control characters and slashes, and before a leading dot.
std::string file_name(std::string_view name) {
    std::string text;
    for (const char c : name) {
        const bool fits =
            static_cast<unsigned char>(c) > 0x20 && c != '/' && c != '\\' && c != 0x7F;
        text += fits ? c : '_';
    }
    return text.starts_with('.') ? "_" + text : text;
}

/// The path of `stem`.lsys in the folder, or of `stem`-2.lsys, ... if this run has already used the
/// name. For example, the systems `a/b` and `a_b` have the same stem.
std::string unused_path(const std::string& stem, FolderImport& import) {
    std::string name = stem + ".lsys";
    for (std::uint64_t number = 2; !import.names.insert(name).second; ++number) {
        name = fmt::format("{}-{}.lsys", stem, number);
    }
    return path_text(import.folder / path_of(name));
}

/// Writes a file whose name the program chose; replaces an existing file only with --force. The
/// caller prints the Error.
Result<void>
write_new_file(const std::string& path, const std::string& text, const FolderImport& import) {
    std::error_code error;
    fs::create_directories(path_of(path).parent_path(), error);
    if (error) {
        return Error{fmt::format("cannot make the folder of `{}`: {}", path, error.message())};
    }
    if (import.command.force) {
        return write_file(path, text, import.console);
    }
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(path_of(path), ignored))) {
        return Error{fmt::format("`{}` is there already; --force replaces it", path)};
    }
    Result<Output> output = Output::create(path, import.console);
    if (!output) {
        return output.error();
    }
    Result<void> done = output.value().write(text);
    return done ? output.value().commit() : done;
}

/// Imports one system to `stem`.lsys and adds a row about it.
void import_one(const std::string& path,
                GrammarText text,
                const GrammarOptions& options,
                const std::string& stem,
                FolderImport& import) {
    const std::string title(row_of(text.dialect).title);
    Imported imported;
    ExitStatus status =
        import_text(path, std::move(text), options, import.command.run, import.console, imported);
    std::string output_path;
    if (status == ExitStatus::Ok) {
        output_path = unused_path(stem, import);
        if (const Result<void> written = write_new_file(output_path, imported.text, import);
            !written) {
            status = fail(written.error(), import.console, imported);
        }
    }
    import.status = more_severe(import.status, status);
    const std::string what =
        options.system.empty() ? path : fmt::format("{}: `{}`", path, options.system);
    if (status != ExitStatus::Ok) {
        import.table.add(ImportTable::Kind::Failed, what, title, imported.reason);
        return;
    }
    const std::string warnings =
        imported.warnings == 0 ? "" : ", " + counted(imported.warnings, "warning");
    import.table.add(ImportTable::Kind::Imported, what, title,
                     fmt::format("written to {}{}", output_path, warnings));
}

/// Imports the systems of a file to `prefix`NAME.lsys. Skips a system with the name of an earlier
/// system, ignoring letter case.
void import_systems(const std::string& path,
                    const GrammarText& text,
                    const std::string& prefix,
                    FolderImport& import) {
    std::set<std::string> seen;
    for (const std::string& system : systems_in(text.dialect, text.bytes)) {
        if (import.console.interrupted()) {
            import.status = ExitStatus::Interrupted;
            return;
        }
        std::string lower_case = system;
        std::transform(lower_case.begin(), lower_case.end(), lower_case.begin(), [](char c) {
            return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        });
        if (!seen.insert(lower_case).second) {
            import.status = more_severe(import.status, ExitStatus::AuthorErrors);
            import.table.add(ImportTable::Kind::Failed, fmt::format("{}: `{}`", path, system),
                             std::string(row_of(text.dialect).title),
                             "a second system of this name");
            continue;
        }
        GrammarOptions options = import.command.grammar;
        options.system = system;
        import_one(path, text, options, prefix + file_name(system), import);
    }
}

Result<void> make_folder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    return error ? Result<void>(Error{fmt::format("cannot make the folder `{}`: {}",
                                                  path_text(folder), error.message())})
                 : Result<void>();
}

ExitStatus end_import(const FolderImport& import) {
    const Result<void> written =
        import.console.write(import.table.text(import.console.options().quiet));
    return written ? import.status : report_error(written.error(), import.console);
}

/// Why a file of a folder is no grammar to import; empty if it is one.
std::string reason_not_to_read(const fs::path& path, const Outcome<GrammarText>& text) {
    if (path.extension() == ".lsb") {
        return "a compiled grammar";
    }
    if (!text) {
        const std::string reason = first_error(text.messages());
        return reason.empty() ? "no grammar" : reason;
    }
    if (text.value().dialect != Dialect::Lsys) {
        return {};
    }
    const auto other = recognise_other_language(text.value().bytes);
    return other ? other->name : "a .lsys grammar";
}

/// Imports all systems of the files of a folder and its sub-folders.
ExitStatus import_folder(const ImportCommand& command, const Console& console) {
    const fs::path output = path_of(command.output.empty() ? command.folder : command.output);
    const Result<std::vector<fs::path>> files = files_of(command.folder, output);
    if (!files) {
        return report_error(files.error(), console);
    }
    FolderImport import{command, console, output, {}};
    if (const Result<void> made = make_folder(import.folder); !made) {
        return report_error(made.error(), console);
    }
    for (const fs::path& relative : files.value()) {
        if (console.interrupted()) {
            import.status = ExitStatus::Interrupted;
            break;
        }
        const std::string path = path_text(path_of(command.folder) / relative);
        Outcome<GrammarText> text =
            read_grammar(path, command.grammar.dialect, make_project(console, command.run));
        if (std::string reason = reason_not_to_read(relative, text); !reason.empty()) {
            import.table.add(ImportTable::Kind::NotRead, path, {}, std::move(reason));
            continue;
        }
        const bool several = has_systems(text.value().dialect) && command.grammar.system.empty() &&
                             systems_in(text.value().dialect, text.value().bytes).size() > 1;
        const std::string stem = path_text(relative);
        if (several) {
            import_systems(path, text.value(), stem + ".", import);
        } else {
            import_one(path, std::move(text.value()), command.grammar, stem, import);
        }
    }
    return end_import(import);
}

/// Imports all systems of a file to the folder of `-o`.
ExitStatus
import_to_folder(const ImportCommand& command, const GrammarText& text, const Console& console) {
    if (const Result<void> made = make_folder(path_of(command.output)); !made) {
        return report_error(made.error(), console);
    }
    FolderImport import{command, console, path_of(command.output), {}};
    import_systems(command.file, text, "", import);
    return end_import(import);
}

bool is_folder(const std::string& path) {
    std::error_code error;
    return names_folder(path) || (!path.empty() && fs::is_directory(path_of(path), error));
}

} // namespace

ExitStatus run_command(const ImportCommand& command, const Console& console) {
    if (command.file.empty() == command.folder.empty()) {
        return report_error(Error{command.file.empty() ? "FILE is missing, or --all FOLDER"
                                                       : "FILE and --all do not go together"},
                            console);
    }
    if (command.grammar.generations && !is_exact(*command.grammar.generations)) {
        return report_error(Error{fmt::format("a grammar cannot hold the number {}: its numbers "
                                              "are binary32",
                                              *command.grammar.generations)},
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
