// SPDX-License-Identifier: MIT
// Tokens of module lists: foreign symbols, back quotes; also quoted file names, control characters
// and comments.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

#include <cstdint>
#include <string_view>

namespace lsys::lsys_grammar {

/// Handling of a character among modules that is not a module.
enum class StrayHandling : std::uint8_t {
    Skip,
    ReadAsModule, // read as if in back quotes; a `)` becomes `]`
    SkipRange,    // skip a random range outside of parentheses, up to `}`
    InsertColon,  // insert a `:` before the character; the condition begins
    EndStatement, // end the statement as a `;` does
    Discard,      // discard the statement and skip its rest
};
/// Reports a number or one of `@ * ~ = ? ,` in a module list; returns its handling.
StrayHandling report_stray_in_modules(ParseSession& session, std::string_view text);

/// The token of the current match, read as the module `name` in back quotes.
Token read_as_module(ParseSession& session, std::string_view name);
void report_foreign_symbol(ParseSession& session, char symbol);
/// Reports a `//` before the current character on its line that looks like a comment. Returns
/// whether there is one.
bool report_likely_comment(ParseSession& session);
/// Reports one or more `)` without `(`; returns their handling.
StrayHandling report_extra_parenthesis(ParseSession& session);
/// Reports a `;` that sets the colour in cpfg and L-Py, as in `;(0.9)`. Returns whether the current
/// `;` is one.
bool report_colour_symbol(ParseSession& session);

/// Reports control characters in a text whose characters are modules; `text` includes the quotes.
void check_quoted_text(ParseSession& session, std::string_view text);
/// The name in back quotes; `text` includes the quotes.
NameId quoted_name(ParseSession& session, std::string_view text, SourceSpan span);
void report_unclosed_back_quote(ParseSession& session);
Token unclosed_quote(ParseSession& session);

/// Length of the run at the start of `text`, before its `*`. A `/` before the `*` begins a comment
/// and is not part of the run.
[[nodiscard]] int run_before_star(std::string_view text);

/// Reports control characters, once per sequence, and reads them as a blank.
void control_characters(ParseSession& session);
void report_unclosed_comment(ParseSession& session);
/// Reads the codes that the current comment allows, and records the comment in
/// ParseSession::comments.
void keep_comment(ParseSession& session);

} // namespace lsys::lsys_grammar
