#include "runtime/cli/grammar_file.h"

#include "compiler/compile.h"
#include "compiler/module_file.h"
#include "runtime/cli/files.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

namespace lsys::lsc {

namespace {

constexpr std::string_view kModuleExtension = ".lsb";

/// `lsys, sys, ...`
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
    return Error{fmt::format("neither the name of `{}` nor what it holds tells its language; say "
                             "which with --dialect ({})",
                             path, dialect_names())};
}

/// The dialect of a file: as asked for, else as it tells.
Result<Dialect> dialect_of(const std::string& path,
                           const std::string& dialect,
                           std::string_view bytes,
                           const Console& console) {
    if (!dialect.empty()) {
        const std::optional<Dialect> asked = find_dialect(dialect);
        return asked ? Result<Dialect>(*asked)
                     : Error{fmt::format("there is no dialect `{}`", dialect)};
    }
    if (path.ends_with(kModuleExtension)) {
        return unknown_dialect(path);
    }
    if (is_module_file(bytes)) {
        return Dialect::Lsys; // which the caller tells apart
    }
    const DetectedDialect detected = detect_dialect(path, bytes);
    if (!detected.dialect) {
        return path == "-" ? Result<Dialect>(Dialect::Lsys) : unknown_dialect(path);
    }
    if (*detected.dialect != Dialect::Lsys) {
        console.detail(fmt::format("`{}` is read as {}: {} tells", shown_path(path),
                                   row_of(*detected.dialect).title, detected.by));
    }
    return *detected.dialect;
}

/// The -D that no constant answers to, with the nearest that does.
Error unknown_definition(const std::string& name, const Grammar& grammar) {
    std::string text = fmt::format("-D {}: the grammar has no #define or #param `{}`", name, name);
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

Status load_module(std::string_view bytes,
                   const std::string& path,
                   const GrammarOptions& options,
                   const Console& console,
                   Grammar& grammar) {
    if (!options.system.empty()) {
        console.error(fmt::format("--system: `{}` is compiled and holds one system only", path));
        return Status::Failure;
    }
    if (!options.definitions.empty()) {
        console.error(fmt::format("-D cannot change `{}`, which is compiled", path));
        console.help("compile the grammar again with this -D");
        return Status::Failure;
    }
    Result<Bytecode> bytecode = read_module_file(bytes);
    if (!bytecode) {
        console.error(fmt::format("cannot use `{}`: {}", path, bytecode.error().message));
        return Status::Failure;
    }
    grammar.bytecode = std::move(bytecode.value());
    grammar.is_module_file = true;
    if (!options.generations && !grammar.bytecode->generations) {
        grammar.diagnostics.add(
            DiagnosticCode::MissingGenerations, {},
            fmt::format("`{}` does not say how many generations to derive", path));
    }
    return console.show(grammar.diagnostics, grammar.sources);
}

} // namespace

Result<Done> check_system(const std::string& path, Dialect dialect, const GrammarOptions& options) {
    return options.system.empty() || has_systems(dialect)
               ? Result<Done>(Done{})
               : Error{fmt::format("--system: `{}` is {} and holds one system only",
                                   shown_path(path), row_of(dialect).title)};
}

FileLoader make_loader(const Console& console) {
    return
        [console](const std::string& path) { return read_bytes(path, kMaxSourceBytes, console); };
}

Result<GrammarText>
read_grammar(const std::string& path, const std::string& dialect, const Console& console) {
    Result<std::string> bytes = read_file(path, kMaxSourceBytes, console);
    if (!bytes) {
        return bytes.error();
    }
    const Result<Dialect> found = dialect_of(path, dialect, bytes.value(), console);
    if (!found) {
        return found.error();
    }
    return GrammarText{std::move(bytes.value()), found.value()};
}

Result<Done> compile_text(const std::string& path,
                          GrammarText text,
                          const GrammarOptions& options,
                          const FileLoader& load,
                          Grammar& grammar) {
    if (Result<Done> fine = check_system(path, text.dialect, options); !fine) {
        return fine;
    }
    const FileId root = grammar.sources.add(shown_path(path), std::move(text.bytes));
    const FileLoader load_included = [&load, &grammar](const std::string& wanted) {
        grammar.included.push_back(wanted);
        return load(wanted);
    };
    Ast ast = parse_dialect(root, text.dialect,
                            {grammar.sources, grammar.names, grammar.diagnostics, load_included,
                             options.bug_compatible, options.system, &grammar.statements},
                            &grammar.translation);
    grammar.syntax_diagnostics = grammar.diagnostics.all().size();
    const bool foreign = text.dialect != Dialect::Lsys;
    if (foreign && grammar.diagnostics.has_errors()) {
        return Done{}; // nothing can be said of the rest
    }
    CompileOptions compile_options;
    compile_options.definitions = options.definitions;
    compile_options.generations = options.generations;
    compile_options.max_modules = options.max_modules;
    CompileOutcome outcome = compile(std::move(ast), grammar.names, grammar.sources,
                                     compile_options, grammar.diagnostics);
    if (foreign) {
        grammar.diagnostics.drop_repairs("`#"); // they are written in .lsys
    }
    grammar.program = std::move(outcome.program);
    grammar.bytecode = std::move(outcome.bytecode);
    if (!outcome.unknown_definitions.empty()) {
        return unknown_definition(outcome.unknown_definitions.front(), grammar);
    }
    return Done{};
}

Status load_grammar(const std::string& path,
                    const GrammarOptions& options,
                    const Console& console,
                    Grammar& grammar) {
    Result<std::string> bytes = read_file(path, kMaxSourceBytes, console);
    if (!bytes) {
        console.error(bytes.error().message);
        return console.interrupted() ? Status::Interrupted : Status::Failure;
    }
    if (is_module_file(bytes.value()) || path.ends_with(kModuleExtension)) {
        return load_module(bytes.value(), path, options, console, grammar);
    }
    const Result<Dialect> dialect = dialect_of(path, options.dialect, bytes.value(), console);
    if (!dialect) {
        console.error(dialect.error().message);
        return Status::Failure;
    }
    const Result<Done> compiled = compile_text(path, {std::move(bytes.value()), dialect.value()},
                                               options, make_loader(console), grammar);
    const Status status = console.show(grammar.diagnostics, grammar.sources);
    if (!compiled) {
        console.error(compiled.error().message);
        return Status::Failure;
    }
    return status;
}

} // namespace lsys::lsc
