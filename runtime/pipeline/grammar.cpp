// SPDX-License-Identifier: MIT
#include "runtime/pipeline/grammar.h"

#include "compiler/bytecode/module_file.h"
#include "compiler/compile.h"
#include "grammar/ast/folder_list.h"
#include "grammar/base/cancellation.h"
#include "grammar/base/message_levels.h"
#include "grammar/base/paths.h"
#include "grammar/dialects/other_language.h"
#include "grammar/dialects/repeated_messages.h"
#include "grammar/lsys/parse_with_names.h"
#include "runtime/pipeline/impl/moved_environments.h"
#include "runtime/pipeline/setting_options.h"
#include "runtime/pipeline/step.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

constexpr std::string_view kModuleExtension = ".lsb";
constexpr const char* kStandardInput = "<stdin>";
/// Suffix of a path from standard_input_as(). It begins with NUL, which no path of a file contains.
constexpr std::string_view kNamedInput("\0<stdin>", 8);

/// The names of all dialects, with commas: "lsys, sys".
std::string dialect_names() {
    std::string names;
    for (const DialectRow& row : dialects()) {
        names += names.empty() ? "" : ", ";
        names += row.name;
    }
    return names;
}

Error unknown_dialect(const std::string& path) {
    if (path.ends_with(kModuleExtension)) {
        return Error{fmt::format("`{}` is compiled; this needs the grammar itself", path)};
    }
    if (path.ends_with(".toml")) {
        return Error{fmt::format("`{}` is a scene, not a grammar: `lsc forest` generates it, and "
                                 "`lsview` shows it",
                                 path)};
    }
    return Error{fmt::format("neither the name of `{}` nor what it holds tells its language; say "
                             "which with --dialect ({})",
                             path, dialect_names())};
}

/// The dialect named `dialect`, or the detected one if `dialect` is empty.
Result<Dialect> dialect_of(const std::string& path,
                           const std::string& dialect,
                           std::string_view bytes,
                           Messages& messages) {
    if (!dialect.empty()) {
        const std::optional<Dialect> requested = find_dialect(dialect);
        return requested ? Result<Dialect>(*requested)
                         : Error{fmt::format("there is no dialect `{}`", dialect)};
    }
    if (path.ends_with(kModuleExtension) || path.ends_with(".toml")) {
        return unknown_dialect(path);
    }
    if (is_module_file(bytes)) {
        return Dialect::Lsys; // callers test is_module_file() themselves
    }
    const DetectedDialect detected = detect_dialect(shown_path(path), bytes);
    if (!detected.dialect) {
        // The front end reports the language, and the .lsys form of its lines.
        const bool is_explained = is_standard_input(path) || is_foreign_notation(bytes);
        return is_explained ? Result<Dialect>(Dialect::Lsys) : unknown_dialect(path);
    }
    if (*detected.dialect != Dialect::Lsys) {
        messages.add_detail(fmt::format("`{}` is read as {} because of {}", shown_path(path),
                                        row_of(*detected.dialect).title, detected.evidence));
    }
    return *detected.dialect;
}

/// The error of a new value for a constant that does not exist, with the nearest name that exists.
Error unknown_definition(const std::string& name, const Grammar& grammar) {
    std::string text = fmt::format("the grammar has no #define or #param `{}`", name);
    if (grammar.program) {
        std::vector<std::string_view> known;
        for (const Constant& constant : grammar.program->constants) {
            known.push_back(grammar.names.text(constant.name));
        }
        if (const auto nearest = nearest_name(name, known)) {
            text += fmt::format("; did you mean `{}`?", *nearest);
        }
    }
    return Error{text};
}

Outcome<Grammar> load_module(std::string_view bytes,
                             const std::string& path,
                             const GrammarOptions& options,
                             Step step) {
    if (!options.system.empty()) {
        return step.fail(fmt::format("--system: `{}` is compiled and holds one system only", path));
    }
    if (!options.definitions.empty() || !options.optional_definitions.empty()) {
        step.messages.add_error(fmt::format("-D cannot change `{}`, which is compiled", path));
        step.messages.add_help("compile the grammar again with this -D");
        return step.end(Stop::Failed);
    }
    Result<Bytecode> bytecode = read_module_file(bytes);
    if (!bytecode) {
        return step.fail(fmt::format("cannot use `{}`: {}", path, bytecode.error().message));
    }
    Grammar grammar;
    grammar.bytecode = std::move(bytecode.value());
    grammar.is_module_file = true;
    if (!options.settings.empty()) {
        Diagnostics diagnostics;
        const Result<void> changed =
            change_compiled_settings(path, options.settings, grammar, diagnostics);
        if (!changed) {
            step.messages.add_error(changed.error().message);
            step.messages.add_help("compile the grammar again with this --set");
            return step.end(Stop::Failed);
        }
        if (!step.diagnose(std::move(diagnostics), grammar.sources)) {
            return step.end_diagnosed();
        }
    }
    if (!options.generations && !grammar.bytecode.generations) {
        const Diagnostic missing =
            make_diagnostic(DiagnosticCode::MissingGenerations, {},
                            fmt::format("`{}` does not say how many generations to derive", path));
        if (!step.diagnose(missing, grammar.sources)) {
            return step.end(Stop::Diagnosed);
        }
    }
    move_environments(options.moves, grammar.bytecode);
    return step.done(std::move(grammar));
}

} // namespace

bool has_grammar_extension(std::string_view path) {
    const std::string_view name = name_of_path(path);
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos) {
        return false;
    }
    const std::string_view extension = name.substr(dot);
    if (extension == kModuleExtension || extension == ".lsys") {
        return true;
    }
    return std::any_of(dialects().begin(), dialects().end(), [&](const DialectRow& row) {
        return fmt::format(" {} ", row.extensions).find(fmt::format(" {} ", extension)) !=
               std::string::npos;
    });
}

std::string shown_path(const std::string& path) {
    if (path == "-") {
        return kStandardInput;
    }
    return path.ends_with(kNamedInput) ? path.substr(0, path.size() - kNamedInput.size()) : path;
}

std::string standard_input_as(const std::string& name) {
    return name.empty() ? "-" : name + std::string(kNamedInput);
}

std::string standard_input_in(const std::string& folder) {
    return folder.empty() ? "-" : folder + (names_folder(folder) ? "" : "/") + kStandardInput;
}

bool is_standard_input(const std::string& path) {
    return path == "-" || path.ends_with(std::string("/") + kStandardInput) ||
           path.ends_with(kNamedInput);
}

FileLoader make_loader(const Project& project, std::uint64_t max_bytes) {
    const FilePolicy& files = project.files;
    return [read = project.host.read_referenced_file, list = project.host.list_folder,
            left = max_bytes, policy_left = files.max_included_bytes,
            max_policy_bytes = files.max_included_bytes, max_files = files.max_included_files,
            count = std::uint64_t{0}](const std::string& path) mutable -> Result<std::string> {
        if (path.ends_with(kListEnd)) {
            const std::string folder = path.substr(0, path.size() - 1);
            return list ? Result<std::string>(fmt::format("{}", fmt::join(list(folder), "\n")))
                        : Error{"no folder is listed here"};
        }
        if (++count > max_files) {
            return Error{fmt::format("more than {} files are included, the maximum for grammars "
                                     "that are not trusted",
                                     max_files),
                         ErrorKind::Limit};
        }
        Result<std::string> bytes = read(path, {kMaxSourceBytes, left});
        const std::uint64_t size = bytes ? bytes.value().size() : 0;
        if (size > policy_left) {
            return Error{fmt::format("the included files are larger than {} bytes together, the "
                                     "maximum for grammars that are not trusted",
                                     max_policy_bytes),
                         ErrorKind::Limit};
        }
        left -= size;
        policy_left -= size;
        return bytes;
    };
}

Outcome<GrammarText>
read_grammar(const std::string& path, const std::string& dialect, const Project& project) {
    Step step(project);
    Result<std::string> bytes = step.read(path, {kMaxSourceBytes});
    if (!bytes) {
        return step.fail(bytes.error());
    }
    const Result<Dialect> found = dialect_of(path, dialect, bytes.value(), step.messages);
    if (!found) {
        return step.fail(found.error());
    }
    return step.done(GrammarText{std::move(bytes.value()), found.value()});
}

Result<void> check_system(const std::string& path, Dialect dialect, const GrammarOptions& options) {
    return options.system.empty() || has_systems(dialect)
               ? Result<void>()
               : Error{fmt::format("--system: `{}` is {} and holds one system only",
                                   shown_path(path), row_of(dialect).title)};
}

Result<CompiledText> compile_text(const std::string& path,
                                  GrammarText text,
                                  const GrammarOptions& options,
                                  std::uint64_t max_modules,
                                  const FileLoader& load) {
    if (Result<void> ok = check_system(path, text.dialect, options); !ok) {
        return ok.error();
    }
    if (!options.view.empty() && text.dialect != Dialect::Cpfg) {
        return Error{fmt::format("--view: `{}` is {}, which has no view files", shown_path(path),
                                 row_of(text.dialect).title)};
    }
    const bool foreign = text.dialect != Dialect::Lsys;
    const std::string_view names = values_of("names", options.settings);
    if (foreign && !names.empty()) {
        return Error{fmt::format("--set names: `{}` is {}, which has its own form of names",
                                 shown_path(path), row_of(text.dialect).title)};
    }
    CompiledText compiled;
    Grammar& grammar = compiled.grammar;
    const FileId root = grammar.sources->add(shown_path(path), std::move(text.bytes));
    const ParseContext context{
        *grammar.sources,       grammar.names,  compiled.diagnostics, load,
        options.bug_compatible, options.system, &compiled.statements, options.view};
    Ast ast = names.empty() ? parse_dialect(root, text.dialect, context, &grammar.translation)
                            : parse_lsys_with_names(root, names, context);
    apply_levels({}, *grammar.sources, compiled.diagnostics); // `/* lsc: allow CODE */`
    if (foreign) {
        merge_repeated_messages(compiled.diagnostics, 0);
    }
    compiled.syntax_diagnostic_count = compiled.diagnostics.all().size();
    const std::vector<Diagnostic>& found = compiled.diagnostics.all();
    const bool is_no_grammar =
        std::any_of(found.begin(), found.end(), [root](const Diagnostic& diagnostic) {
            return diagnostic.code == DiagnosticCode::OtherLanguage && diagnostic.span.file == root;
        });
    if (is_no_grammar || (foreign && compiled.diagnostics.has_errors())) {
        return compiled; // an incomplete translation is not checked
    }
    CompileOptions compile_options;
    compile_options.definitions = options.definitions;
    compile_options.definitions.insert(compile_options.definitions.end(),
                                       options.optional_definitions.begin(),
                                       options.optional_definitions.end());
    const std::uint32_t first_option = grammar.sources->file_count();
    std::optional<Ast> settings =
        parse_settings(options.settings, *grammar.sources, grammar.names, compiled.diagnostics);
    compile_options.settings = settings ? &*settings : nullptr;
    compile_options.generations = options.generations;
    compile_options.max_modules = max_modules;
    compile_options.part = options.part;
    CompileOutcome outcome = compile(std::move(ast), grammar.names, *grammar.sources,
                                     compile_options, compiled.diagnostics);
    apply_levels({}, *grammar.sources, compiled.diagnostics);
    // Fixes in the text of options cannot be applied, because no file contains this text.
    compiled.diagnostics.offer_fixes_where([&](const Diagnostic& diagnostic) {
        return diagnostic.span.file != kNoFile &&
               static_cast<std::uint32_t>(diagnostic.span.file) >= first_option;
    });
    if (foreign) {
        drop_follow_ups(compiled.diagnostics);
        merge_repeated_messages(compiled.diagnostics, compiled.syntax_diagnostic_count);
        compiled.diagnostics.drop_repairs("`#"); // they propose .lsys text, invalid in the dialect
    }
    grammar.program = std::move(outcome.program);
    if (grammar.program) {
        grammar.height_span = grammar.program->height_span;
        for (const ObjectBinding& binding : grammar.program->objects) {
            if (!binding.mesh_file.empty()) {
                grammar.object_spans.emplace(binding.mesh_file, binding.object_span);
            }
        }
    }
    if (outcome.bytecode) {
        grammar.bytecode = std::move(*outcome.bytecode);
        compiled.has_bytecode = true;
    }
    const auto is_optional = [&](const std::string& name) {
        return std::any_of(options.optional_definitions.begin(), options.optional_definitions.end(),
                           [&](const Definition& one) { return one.name == name; });
    };
    for (const std::string& name : outcome.unknown_definitions) {
        if (!is_optional(name) && !compiled.definition_error) {
            compiled.definition_error = unknown_definition(name, grammar);
        }
    }
    return compiled;
}

namespace {

/// load_grammar() without its CancellationScope.
Outcome<Grammar>
load_source(const std::string& path, const GrammarOptions& options, const Project& project) {
    Step step(project);
    project.begin(LongStep::Read);
    Result<std::string> bytes = step.read(path, {kMaxSourceBytes, project.limits.max_bytes});
    if (!bytes) {
        return step.fail(bytes.error());
    }
    if (is_module_file(bytes.value()) || path.ends_with(kModuleExtension)) {
        return load_module(bytes.value(), path, options, std::move(step));
    }
    const Result<Dialect> dialect = dialect_of(path, options.dialect, bytes.value(), step.messages);
    if (!dialect) {
        return step.fail(dialect.error());
    }
    const FileLoader load = make_loader(project, project.limits.max_bytes - bytes.value().size());
    Result<CompiledText> compiled = compile_text(path, {std::move(bytes.value()), dialect.value()},
                                                 options, project.limits.max_modules, load);
    if (!compiled) {
        return step.fail(compiled.error());
    }
    CompiledText& text = compiled.value();
    const bool ok = step.diagnose(std::move(text.diagnostics), text.grammar.sources);
    if (text.definition_error) {
        return step.fail(*text.definition_error);
    }
    move_environments(options.moves, text.grammar.bytecode);
    return ok ? step.done(std::move(text.grammar)) : step.end_diagnosed();
}

} // namespace

Outcome<Grammar>
load_grammar(const std::string& path, const GrammarOptions& options, const Project& project) {
    const CancellationScope scope(project.host.cancelled);
    try {
        return load_source(path, options, project);
    } catch (const CompilationCancelled&) {
        return Step(project).end(Stop::Cancelled);
    }
}

} // namespace lsys
