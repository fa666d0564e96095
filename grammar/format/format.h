// SPDX-License-Identifier: MIT
// The formatter of `lsc fmt`: one statement per line; neighbouring statements and the comments
// after them aligned in columns; line ends between modules, comments and single blank lines kept;
// long lines broken. The formatter only moves tokens, so the meaning of a file stays the same.
// Formatting a formatted text changes nothing. docs/manual.md gives the rules.
#pragma once

#include "grammar/lsys/parse.h"

#include <optional>
#include <string>
#include <string_view>

namespace lsys {

/// The formatted text of `file`, with its byte order mark and line ends (if mixed, the more
/// frequent kind). Reads no included files. Nullopt if the file has errors, which are added to
/// context.diagnostics.
[[nodiscard]] std::optional<std::string> format_lsys(FileId file, const ParseContext& context);

/// Formats a text without syntax errors.
[[nodiscard]] std::string format_text(std::string_view text);

} // namespace lsys
