// SPDX-License-Identifier: MIT
// Dialects: the formats in which grammars are written, how the dialect of a file is recognised, and
// the front ends of foreign dialects, which translate a file to .lsys text
// (grammar/ast/translation.h).
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/lsys/parse.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class Dialect : std::uint8_t {
    Lsys,
#define LSYS_DIALECT(enumerator, ...) enumerator,
#include "grammar/dialects/dialects.def"
#undef LSYS_DIALECT
};

/// The properties of a dialect; made from dialects.def.
struct DialectRow {
    Dialect dialect{};
    std::string_view name;       // value of the option --dialect
    std::string_view title;      // name of the dialect in messages
    std::string_view extensions; // extensions with dots, separated by blanks
    std::string_view turtle;     // default profile: the `#set turtle` of a translation
    std::string_view page;       // page of the manual, from the root of the sources

    /// Returns the evidence that a text is of this dialect; empty if there is none. Null for .lsys.
    std::string_view (*recognise)(std::string_view text) = nullptr;
    /// Writes the .lsys text of the file `out.file()`. Reports mistakes at their places in that
    /// file; after errors the text is incomplete. Null for .lsys.
    void (*translate)(const DialectRow& row,
                      const ParseContext& context,
                      Translation& out) = nullptr;
    /// Names of the systems of a file, in order. The function is no_system_names for dialects in
    /// which a file is one unnamed system.
    std::vector<std::string> (*systems)(std::string_view text) = nullptr;
};
/// All dialects, .lsys first.
[[nodiscard]] std::span<const DialectRow> dialects();
[[nodiscard]] const DialectRow& row_of(Dialect dialect);
/// Finds a dialect by DialectRow::name.
[[nodiscard]] std::optional<Dialect> find_dialect(std::string_view name);

struct DetectedDialect {
    std::optional<Dialect> dialect; // nullopt if neither text nor path shows a dialect
    std::string_view evidence;      // for messages: "its first word, `LSYSTEM`"
};
/// Detects the dialect from the extension of `path`; if no dialect has the extension, or if it is
/// `.l` or `.ls`, which several programs use, from the content of `text`. A `.l` file of unknown
/// content is L3D. A text in a language that lsc does not read is treated as .lsys, whose front end
/// reports the language.
[[nodiscard]] DetectedDialect detect_dialect(std::string_view path, std::string_view text);

/// Names of the systems of `text`, in order; none for dialects whose files hold one system.
[[nodiscard]] std::vector<std::string> systems_in(Dialect dialect, std::string_view text);
/// Whether a file may hold several systems, each with a name.
[[nodiscard]] bool has_systems(Dialect dialect);

/// Translates the file `root` to .lsys text. Reports mistakes at their places in the file; after
/// errors the text is incomplete and must not be used. Precondition: not Dialect::Lsys.
[[nodiscard]] Translation translate(FileId root, Dialect dialect, const ParseContext& context);

/// Reports a .lsys file that is not text or looks like another language; returns whether it may be
/// parsed.
[[nodiscard]] bool check_is_lsys(FileId root, const ParseContext& context);

/// parse_lsys() of a file of any dialect. `text`, if not null, gets the .lsys text of a foreign
/// file.
[[nodiscard]] Ast parse_dialect(FileId root,
                                Dialect dialect,
                                const ParseContext& context,
                                std::string* text = nullptr);

} // namespace lsys
