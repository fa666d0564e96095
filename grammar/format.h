// The formatter behind `lsc fmt`: one layout for every grammar. One statement a line, single blanks
// around
// `:` and binary operators except `^`, none inside parentheses; blanks between modules stay where
// the author put them; long statements are broken at blanks; comments and single blank lines stay.
// It works on tokens, so what a file means cannot change, and formatting twice is formatting once.
#pragma once

#include "grammar/parse.h"

#include <optional>
#include <string>
#include <string_view>

namespace lsys {

/// The text of `file` in the common layout, with LF line ends and without a byte order mark.
/// Included files are not read. Nothing if the file has errors; they are in context.diagnostics.
[[nodiscard]] std::optional<std::string> format_lsys(FileId file, const ParseContext& context);

/// The layout of a text that is known to parse.
[[nodiscard]] std::string format_text(std::string_view text);

} // namespace lsys
