// Dialects: the other formats in which grammars are written, how a file's own is told, and their
// front ends, which make .lsys text of it (grammar/ast/translation.h).
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
    Sys,      // the forest of 2005
    Houdini,  // rule texts of its L-system node; asked before Carey's, whose settings it shares
    Carey,    // the forest generator of 2019
    Cpfg,     // L-systems of L-studio and vlab
    Fractint, // its .l collections
    L3d,
    Lplus, // L+System, an extension of L3D
};

struct DialectRow {
    Dialect dialect{};
    std::string_view name;       // as an option has it
    std::string_view title;      // in messages
    std::string_view extensions; // with dots, separated by blanks
};
/// All of them, .lsys first.
[[nodiscard]] std::span<const DialectRow> dialects();
[[nodiscard]] const DialectRow& row_of(Dialect dialect);
/// By DialectRow::name.
[[nodiscard]] std::optional<Dialect> find_dialect(std::string_view name);

struct DetectedDialect {
    std::optional<Dialect> dialect; // none: nothing tells
    std::string_view by;            // what told it: "its first line is `LSYSTEM`"
};
/// By what the text holds, else by the extension of `path`.
[[nodiscard]] DetectedDialect detect_dialect(std::string_view path, std::string_view text);

/// The names of the systems of a file, in order; none where a file of the dialect is one system.
[[nodiscard]] std::vector<std::string> systems_in(Dialect dialect, std::string_view text);
/// Whether a file of the dialect may hold several systems, each with a name.
[[nodiscard]] bool has_systems(Dialect dialect);

/// Makes .lsys text of the file `root`. Mistakes are reported where they stand; after errors the
/// text is what could be read, and not to be used. Precondition: not Dialect::Lsys.
[[nodiscard]] Translation translate(FileId root, Dialect dialect, const ParseContext& context);

/// parse_lsys() of a file of any dialect. `text`, if there is one, gets the .lsys text of a file of
/// another.
[[nodiscard]] Ast parse_dialect(FileId root,
                                Dialect dialect,
                                const ParseContext& context,
                                std::string* text = nullptr);

} // namespace lsys
