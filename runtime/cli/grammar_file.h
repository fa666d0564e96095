// From a file to a compiled grammar: reads it and what it includes, parses, compiles, shows the
// diagnostics. The front door of every command that takes a grammar.
#pragma once

#include "compiler/bytecode.h"
#include "compiler/program.h"
#include "grammar/ast.h"
#include "grammar/diagnostic.h"
#include "grammar/dialect.h"
#include "grammar/names.h"
#include "grammar/parse.h"
#include "grammar/source.h"
#include "runtime/cli/console.h"
#include "runtime/cli/options.h"

#include <optional>
#include <string>
#include <vector>

namespace lsys::lsc {

/// A grammar and all that stands behind it. Diagnostics and sites refer to `sources`.
struct Grammar {
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    std::optional<Program> program;     // of a source without errors
    std::optional<Bytecode> bytecode;   // without errors
    std::vector<std::string> included;  // what #include asked for, whether it could be read or not
    std::vector<SourceSpan> statements; // of a source, with errors or without
    /// The first diagnostics, before they are sorted, are those of the syntax.
    std::size_t syntax_diagnostics = 0;
    std::string translation;     // .lsys text of a grammar of another dialect
    bool is_module_file = false; // read from a .lsb: `sources` is empty
};

/// Reads files for #include.
[[nodiscard]] FileLoader make_loader(const Console& console);

/// The bytes of a grammar and the dialect that they are in.
struct GrammarText {
    std::string bytes;
    Dialect dialect = Dialect::Lsys;
};
/// `dialect`: a name of one, or empty. Error: the file cannot be read, or nothing tells its
/// dialect.
[[nodiscard]] Result<GrammarText>
read_grammar(const std::string& path, const std::string& dialect, const Console& console);

/// Error: --system of a dialect whose files are one system.
[[nodiscard]] Result<Done>
check_system(const std::string& path, Dialect dialect, const GrammarOptions& options);

/// Compiles the `text` of `path`; diagnostics are collected, not shown. An Error is a -D of
/// no constant.
[[nodiscard]] Result<Done> compile_text(const std::string& path,
                                        GrammarText text,
                                        const GrammarOptions& options,
                                        const FileLoader& load,
                                        Grammar& grammar);

/// Reads and compiles `path`, a grammar or a .lsb file, and shows what there is to say. After Fine
/// the bytecode is there.
[[nodiscard]] Status load_grammar(const std::string& path,
                                  const GrammarOptions& options,
                                  const Console& console,
                                  Grammar& grammar);

} // namespace lsys::lsc
