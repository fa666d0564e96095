// SPDX-License-Identifier: MIT
// Grammar: a file as checked bytecode. Reads the file and its includes, parses and compiles them.
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

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// Displacement of an environment of `#sense`: of its obstacles, its markers or its map.
struct EnvironmentMove {
    std::string name;          // name without the `?`
    std::array<float, 3> by{}; // m, in the plant's own axes; finite

    friend bool operator==(const EnvironmentMove&, const EnvironmentMove&) = default;
};

/// Options of reading and compiling a grammar.
struct GrammarOptions {
    std::string dialect;         // name; empty: detected from the contents, else from the extension
    bool bug_compatible = false; // reproduce bugs of the original program of the dialect
    std::string view{}; // path of the view file of a cpfg model; empty: found beside the model
    std::string system; // name in a file of several systems; empty: the only one
    std::vector<Definition> definitions;
    /// Definitions for -D that are ignored if the grammar has no such constant.
    std::vector<Definition> optional_definitions;
    /// Values that replace the `#set` statements with the same keys; each key at most once.
    std::vector<SettingText> settings;
    std::optional<std::uint32_t> generations; // replaces #n
    bool part = false; // the file is for `#include`: it is checked but not compiled to bytecode
    /// Moves that load_grammar() applies; names that the grammar lacks are ignored.
    std::vector<EnvironmentMove> moves{};

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
    /// Place of `height` in `#set height`; kNoFile if missing or a .lsb file.
    SourceSpan height_span;
    /// Places of the files of `#object`, by BytecodeSymbol::mesh_file; empty for a .lsb file.
    std::map<std::string, SourceSpan, std::less<>> object_spans;
    std::string translation;     // .lsys text of a grammar in another dialect
    bool is_module_file = false; // read from a .lsb file; `sources` then has only texts of --set
};

/// The result of compile_text(), also for a text with errors.
struct CompiledText {
    Grammar grammar;
    Diagnostics diagnostics;
    std::vector<SourceSpan> statements; // places of all statements, including those with errors
    /// Number of syntax diagnostics. They come first in the diagnostics, which are not sorted yet.
    std::size_t syntax_diagnostic_count = 0;
    bool has_bytecode = false;             // false after errors
    std::optional<Error> definition_error; // a -D that names no constant
};

/// `path` as printed in messages. Standard input is printed as `<stdin>` or as its given name.
[[nodiscard]] std::string shown_path(const std::string& path);
/// A path that means standard input and makes paths in the grammar relative to `folder`:
/// `FOLDER/<stdin>`. `-` if `folder` is empty.
[[nodiscard]] std::string standard_input_in(const std::string& folder);
/// A path that means standard input, is printed as `name`, and makes paths in the grammar relative
/// to the folder of `name`. `-` if `name` is empty.
[[nodiscard]] std::string standard_input_as(const std::string& name);
/// Whether `path` is `-`, or one of standard_input_in() and standard_input_as().
[[nodiscard]] bool is_standard_input(const std::string& path);

/// A reader of files for #include, which together may have at most `max_bytes` bytes.
[[nodiscard]] FileLoader make_loader(const Project& project, std::uint64_t max_bytes);

/// Reads a grammar and finds its dialect. `dialect`: its name, or empty to detect it. Stop::Failed:
/// the file cannot be read, or its dialect is unknown.
[[nodiscard]] Outcome<GrammarText>
read_grammar(const std::string& path, const std::string& dialect, const Project& project);

/// Error: GrammarOptions::system is set for a dialect with one system per file.
[[nodiscard]] Result<void>
check_system(const std::string& path, Dialect dialect, const GrammarOptions& options);

/// Compiles `text`, the contents of the file `path`. Errors: an error of check_system(); --set
/// of a key that the dialect does not have. Throws CompilationCancelled within a CancellationScope
/// whose flag is set.
[[nodiscard]] Result<CompiledText> compile_text(const std::string& path,
                                                GrammarText text,
                                                const GrammarOptions& options,
                                                std::uint64_t max_modules,
                                                const FileLoader& load);

/// Whether the extension of `path` is that of a grammar in any dialect or of a .lsb file.
[[nodiscard]] bool has_grammar_extension(std::string_view path);

/// Reads and compiles `path`, a grammar or a .lsb file.
[[nodiscard]] Outcome<Grammar>
load_grammar(const std::string& path, const GrammarOptions& options, const Project& project);

} // namespace lsys
