// What the scanner does with characters that are no modules of the language but stand in a module
// list, with back quotes, and with quoted file names.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

#include <cstdint>
#include <string_view>

namespace lsys::lsys_grammar {

/// How a character that is no module is read on.
enum class Stray : std::uint8_t {
    Skip,
    Module, // as if it stood in back quotes; a `)` as `]`
    Range,  // the text up to `}` is skipped: a random range outside of parentheses
    Colon,  // a `:` is supplied before it, and the condition begins
    Lost,   // the statement is dropped
};
/// Reports a number or one of `@ * ~ = ? ,` in a module list.
Stray stray_in_modules(ParseSession& session, std::string_view text);

/// The match at hand as the module `name`, as if that stood in back quotes.
Token read_as_module(ParseSession& session, std::string_view name);
void report_foreign_symbol(ParseSession& session, char symbol);
/// Reports one or more `)` that close nothing.
Stray extra_parenthesis(ParseSession& session);
/// Whether the `;` at hand is a module of other programs, `;(0.9)`; reported.
bool is_colour_symbol(ParseSession& session);

/// Reports what is no character of a text whose characters are modules; `text` has the quotes.
void check_quoted_text(ParseSession& session, std::string_view text);
/// The name in back quotes; `text` has the quotes.
NameId quoted_name(ParseSession& session, std::string_view text, SourceSpan span);
void report_unclosed_back_quote(ParseSession& session);
Token unclosed_quote(ParseSession& session);

/// `text` is a run and a `*`: the length of the run, which does not reach into a comment.
[[nodiscard]] int run_before_star(std::string_view text);

/// Control characters in a row are one mistake, and read as a blank.
void control_characters(ParseSession& session);
void report_unclosed_comment(ParseSession& session);
void keep_comment(ParseSession& session);

} // namespace lsys::lsys_grammar
