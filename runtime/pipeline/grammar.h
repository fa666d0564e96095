// Grammar: from a file to checked bytecode. Reads the file and its includes, parses, compiles.
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

/// Options of reading and compiling a grammar.
struct GrammarOptions {
    std::string dialect; // name; empty: detected by contents, else by extension
    bool bug_compatible = false;
    std::string system; // name in a file of several systems; empty: the only one
    std::vector<Definition> definitions;
    /// Definitions that are ignored if the grammar has no such constant.
    std::vector<Definition> optional_definitions;
    /// Replace the `#set` statements of the same keys; each key at most once.
    std::vector<SettingText> settings;
    std::optional<std::uint32_t> generations; // instead of #n
    bool part = false; // of other grammars; it is checked, and has no bytecode

    friend bool operator==(const GrammarOptions&, const GrammarOptions&) = default;
};

/// The bytes of a grammar and their dialect.
struct GrammarText {
    std::string bytes;
    Dialect dialect = Dialect::Lsys;
};

/// A compiled grammar. Spans of its diagnostics, its program and its bytecode lie in `sources`.
struct Grammar {
    std::shared_ptr<SourceMap> sources = std::make_shared<SourceMap>();
    Names names;
    std::optional<Program> program; // none for a .lsb file or after errors
    Bytecode bytecode;
    SourceSpan height_span;      // of `height` in `#set height`; kNoFile: none, or a .lsb file
    std::string translation;     // .lsys text of a grammar in another dialect
    bool is_module_file = false; // read from a .lsb file; `sources` has only settings of options
};

/// The result of compile_text(), also for a text with errors.
struct CompiledText {
    Grammar grammar;
    Diagnostics diagnostics;
    std::vector<SourceSpan> statements; // of all statements, including wrong ones
    /// Number of syntax diagnostics, which come first until the diagnostics are sorted.
    std::size_t syntax_diagnostic_count = 0;
    bool has_bytecode = false;             // there are no errors
    std::optional<Error> definition_error; // a -D that names no constant
};

/// `path` in messages; `-` is standard input.
[[nodiscard]] std::string shown_path(const std::string& path);
/// The path of standard input as a grammar of `folder`, `FOLDER/<stdin>`: paths in the grammar are
/// relative to the folder. Empty folder: `-`.
[[nodiscard]] std::string standard_input_in(const std::string& folder);
/// The path of standard input as the grammar `name`: shown as `name`, whose folder is that of its
/// paths. Empty name: `-`.
[[nodiscard]] std::string standard_input_as(const std::string& name);
/// Whether `path` is `-`, or one of standard_input_in() and standard_input_as().
[[nodiscard]] bool is_standard_input(const std::string& path);

/// A reader of files for #include, at most `max_bytes` in all.
[[nodiscard]] FileLoader make_loader(const Project& project, std::uint64_t max_bytes);

/// Reads a grammar. `dialect`: a name, or empty to detect it. Stop::Failed: the file cannot be
/// read, or its dialect is unknown.
[[nodiscard]] Outcome<GrammarText>
read_grammar(const std::string& path, const std::string& dialect, const Project& project);

/// Error: GrammarOptions::system is set for a dialect with one system per file.
[[nodiscard]] Result<void>
check_system(const std::string& path, Dialect dialect, const GrammarOptions& options);

/// Compiles the `text` of `path`. Errors: those of check_system(); a setting that the dialect does
/// not have.
[[nodiscard]] Result<CompiledText> compile_text(const std::string& path,
                                                GrammarText text,
                                                const GrammarOptions& options,
                                                std::uint64_t max_modules,
                                                const FileLoader& load);

/// Reads and compiles `path`, a grammar or a .lsb file.
[[nodiscard]] Outcome<Grammar>
load_grammar(const std::string& path, const GrammarOptions& options, const Project& project);

} // namespace lsys
