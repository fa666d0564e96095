// SPDX-License-Identifier: MIT
// Module texts of dialects in which every character is a module: `F[+(30)A]`. Writes them as .lsys
// modules with `names letters`: letters and known symbols as they are, other characters in back
// quotes.
#pragma once

#include "grammar/ast/parse_context.h"
#include "grammar/ast/translation.h"

#include <functional>
#include <string>
#include <string_view>

namespace lsys {

/// The character as a module of a .lsys file whose names are letters.
[[nodiscard]] std::string spelled_letter(char32_t character);

/// One module of a text.
struct LetterModule {
    char32_t character = 0;
    SourceSpan span;      // the character
    SourceSpan arguments; // from `(` to one past `)`; empty: there are none
};

/// Writes the character; arguments are left to the caller.
void write_letter(const LetterModule& module,
                  const ParseContext& context,
                  Translation& translation);

/// Calls visit(LetterModule) for each module of `text`, without blanks. A `(` right after a
/// character begins its arguments, which the matching `)` ends. Reports a missing `)` and
/// characters that cannot be modules; returns false after reporting a mistake.
bool read_letter_modules(SourceSpan text,
                         const ParseContext& context,
                         const std::function<void(const LetterModule&)>& visit);

/// Copies `(...)` of a module, numbers and commas only; reports anything else.
bool write_plain_arguments(SourceSpan arguments,
                           const ParseContext& context,
                           Translation& translation);

} // namespace lsys
