// SPDX-License-Identifier: MIT
// Tokens of a .lsys text for colouring: the semantic tokens of the language server, and the colours
// of lsview's source pane.
#pragma once

#include "runtime/names/name_index.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The enumerators of NameKind before NameKind::Environment, in the same order, then the others.
/// Names of environments are tokens of the kind Module.
enum class SourceTokenKind : std::uint8_t {
    Module,
    Constant,
    Formal,
    Function,
    Production,
    Keyword, // `#define`
    Setting, // the key of a `#set`
    Comment,
};

/// Bytes [begin, end) of a text.
struct SourceToken {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    SourceTokenKind kind = SourceTokenKind::Module;

    friend bool operator==(const SourceToken&, const SourceToken&) = default;
};

/// The tokens of the file `path` with the contents `text`, ascending and without overlaps.
/// Statements with syntax errors have none.
[[nodiscard]] std::vector<SourceToken>
source_tokens(const NameIndex& index, const std::string& path, std::string_view text);

/// A file of a grammar, to be shown with coloured tokens.
struct ColouredFile {
    std::string path; // as the grammar names it, relative to the same folder as the grammar
    std::vector<SourceToken> tokens;
    /// Places of statements, ascending; also of statements with syntax errors.
    std::vector<SourceSpan> statements;
};

/// The files of the .lsys grammar `path` with the contents `text`: first the grammar, then the
/// files that it includes.
[[nodiscard]] std::vector<ColouredFile>
coloured_files(const std::string& path, std::string text, const FileLoader& load);

} // namespace lsys
