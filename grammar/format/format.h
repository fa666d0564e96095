// The formatter behind `lsc fmt`: one layout for every grammar. One statement a line; what
// neighbouring statements have in common stands in columns, and so do the comments behind them; an
// author's line ends between modules stay, longer lines are broken; comments and single blank lines
// stay. It works on tokens, so what a file means cannot change, and formatting twice is formatting
// once. docs/manual.md gives the rules.
#pragma once

#include "grammar/lsys/parse.h"

#include <optional>
#include <string>
#include <string_view>

namespace lsys {

/// The text of `file` in the common layout, with the byte order mark and the line ends that it has
/// (of mixed line ends the more frequent). Included files are not read. Nothing if the file has
/// errors; they are in context.diagnostics.
[[nodiscard]] std::optional<std::string> format_lsys(FileId file, const ParseContext& context);

/// The layout of a text that is known to parse.
[[nodiscard]] std::string format_text(std::string_view text);

} // namespace lsys
