// SPDX-License-Identifier: MIT
// NameIndex: every place of a name in a grammar and its included files. Made from the syntax tree,
// so it also works for a grammar with errors; read by navigation, renaming and completion.
#pragma once

#include "compiler/bytecode/settings.h"
#include "grammar/ast/ast.h"
#include "grammar/ast/parse_context.h"
#include "grammar/dialects/dialect.h"

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lsys {

/// The name spaces (docs/language.md section 2.1). Local values count as formals. The name of a
/// sense module `?NAME` is the environment NAME, without the `?`.
enum class NameKind : std::uint8_t { Module, Constant, Formal, Function, Production, Environment };

/// Bytes [begin, end) of a file.
struct TextPlace {
    std::string path; // normalised
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    // NOLINTNEXTLINE(modernize-use-nullptr): a false alarm
    friend auto operator<=>(const TextPlace&, const TextPlace&) = default;
};

struct NameUse {
    TextPlace place; // place of the name without back quotes
    NameKind kind{};
    std::string name;
    TextPlace scope; // statement of a formal; else empty
    bool is_definition = false;
    bool is_part = false; // one of several modules that are written as one name

    // NOLINTNEXTLINE(modernize-use-nullptr): a false alarm
    friend auto operator<=>(const NameUse&, const NameUse&) = default;
};

/// A module that a production rewrites, with its formals.
struct ModuleHead {
    std::string name;
    std::vector<std::string> formals;
};

/// A statement with its places, for outlines and hovers.
struct StatementOutline {
    StatementKind kind{};
    Stage stage = Stage::Rewrite;
    TextPlace place;
    TextPlace name_place;
    std::string name;                 // empty for statements without a name
    std::string detail;               // the text without the name, on one line, truncated
    std::vector<std::string> formals; // formals of a production, function or module
    std::vector<ModuleHead> heads;    // heads of a production
    std::string environment_kind;     // word of the kind of a #sense
};

/// A parsed grammar: the syntax tree and the tables that its ids refer to.
struct ParsedGrammar {
    SourceMap sources;
    Names names;
    Diagnostics diagnostics;
    Ast ast;
    std::vector<SourceSpan> statements; // also of statements with syntax errors
    bool is_translated = false; // from another dialect: the text may lack some names of the tree
};

struct NameIndex {
    std::vector<NameUse> uses; // ascending, unique
    std::vector<StatementOutline> statements;
    TurtleProfile profile = TurtleProfile::Lsys;

    /// Adds the uses and statements of another grammar of the same project.
    void merge(const NameIndex& other);
    /// The use at an offset, which may be its end; null if there is none.
    [[nodiscard]] const NameUse* at(const std::string& path, std::size_t offset) const;
    /// Whether two uses refer to the same definition.
    [[nodiscard]] static bool are_same(const NameUse& a, const NameUse& b);
};

/// Parses a grammar and its included files. If the grammar is in the dialect of another program,
/// places are offsets in its original text, not in a translation to .lsys.
void parse_grammar(const std::string& path,
                   std::string text,
                   Dialect dialect,
                   const FileLoader& load,
                   ParsedGrammar& parsed);
/// The uses of names and the statements of a parsed grammar.
[[nodiscard]] NameIndex index_names(const ParsedGrammar& parsed);

} // namespace lsys
