// SPDX-License-Identifier: MIT
// Tokens of numbers, with percentages and units of measure, which are reported.
#pragma once

#include "grammar/lsys/impl/parse_session.h"
#include "grammar/lsys/impl/token.h"

#include <cstddef>
#include <string_view>

namespace lsys::lsys_grammar {

/// The token of a number; reports a percentage and a number out of range.
Token number(ParseSession& session, std::string_view text, SourceSpan span);
void report_malformed_number(ParseSession& session, std::string_view text, SourceSpan span);
/// Length of the number in texts like `2x`; 0 if no name follows it.
[[nodiscard]] std::size_t number_before_name(std::string_view text);
/// Whether the current `%` ends a percentage, which number() has reported.
[[nodiscard]] bool is_percent_sign(const ParseSession& session);
/// Reports a unit of measure after a number. Returns whether the current word is one.
[[nodiscard]] bool report_unit_word(ParseSession& session, std::string_view word);

} // namespace lsys::lsys_grammar
