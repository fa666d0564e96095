// SPDX-License-Identifier: MIT
// Facts about the current statement that its text tells, also if the statement is incomplete.
#pragma once

#include "grammar/lsys/impl/parse_session.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lsys::lsys_grammar {

/// Help of messages about productions with too few or too many parts.
inline constexpr const char* kFourParts =
    "a production has four parts: `#name : predecessor : condition : successor;`, with `*` for no "
    "condition";

/// The number of `:` of the current statement, counted once per statement.
[[nodiscard]] std::uint32_t colons_of_statement(ParseSession& session);
/// Whether the `;` at `at` is a mistyped `:`: the text up to the next `;` begins with neither a
/// statement nor a comment and has exactly `missing` colons.
[[nodiscard]] bool is_mistyped_colon(std::string_view text, std::size_t at, std::ptrdiff_t missing);
/// Whether the predecessor of the current production is one module without contexts, with nothing
/// else before the `:` or `~` after it.
[[nodiscard]] bool has_plain_head(const ParseSession& session);
/// The part after the `:` that ends at scan.end.
[[nodiscard]] Part part_after_colon(const ParseSession& session);

} // namespace lsys::lsys_grammar
