// Grammar: from a file to checked bytecode: reads it and what it includes, parses, compiles.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/program/compile_options.h"
#include "compiler/program/program.h"
#include "grammar/ast/parse_context.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/outcome.h"
#include "grammar/base/source.h"
#include "grammar/dialects/dialect.h"
#include "runtime/pipeline/project.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

/// How a grammar is read and compiled.
struct GrammarOptions {
    std::string dialect; // a name of one; empty: by what the file holds, else by its extension
    bool bug_compatible = false;
    std::string system; // of a file that holds several; empty: the only one
    std::vector<Definition> definitions;
    /// Those of constants that the grammar does not have are ignored.
    std::vector<Definition> optional_definitions;
    std::optional<std::uint32_t> generations; // instead of #n

    friend bool operator==(const GrammarOptions&, const GrammarOptions&) = default;
};

/// The bytes of a grammar and the dialect that they are in.
struct GrammarText {
    std::string bytes;
    Dialect dialect = Dialect::Lsys;
};

/// A compiled grammar. Spans of its diagnostics, its program and its bytecode lie in `sources`.
struct Grammar {
    std::shared_ptr<SourceMap> sources = std::make_shared<SourceMap>();
    Names names;
    std::optional<Program> program; // of a source without errors
    Bytecode bytecode;
    std::string translation;     // .lsys text of a grammar of another dialect
    bool is_module_file = false; // read from a .lsb: `sources` is empty
};

/// What compile_text() made of a text, also where that has errors.
struct CompiledText {
    Grammar grammar;
    Diagnostics diagnostics;
    std::vector<SourceSpan> statements; // places of all, of those with errors too
    /// The first diagnostics, before they are sorted, are those of the syntax.
    std::size_t syntax_diagnostics = 0;
    bool has_bytecode = false;             // there are no errors
    std::optional<Error> definition_error; // a -D of no constant
};

/// `path` in messages; `-` is standard input.
[[nodiscard]] std::string shown_path(const std::string& path);

////// Reads files for #include, which take at most `max_bytes` together.
[[nodiscard]] FileLoader make_loader(const Project& project, std::uint64_t max_bytes);

/// `dialect`: a name of one, or empty. Failed: the file cannot be read, or nothing tells its
/// dialect.
[[nodiscard]] Outcome<GrammarText>
read_grammar(const std::string& path, const std::string& dialect, const Project& project);

/// Error: `system` is given for a dialect whose files are one system.
[[nodiscard]] Result<Done>
check_system(const std::string& path, Dialect dialect, const GrammarOptions& options);

/// Compiles the `text` of `path`. Error: check_system().
[[nodiscard]] Result<CompiledText> compile_text(const std::string& path,
                                                GrammarText text,
                                                const GrammarOptions& options,
                                                std::uint64_t max_modules,
                                                const FileLoader& load);

/// Reads and compiles `path`, a grammar or a .lsb file.
[[nodiscard]] Outcome<Grammar>
load_grammar(const std::string& path, const GrammarOptions& options, const Project& project);

} // namespace lsys
