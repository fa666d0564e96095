// SPDX-License-Identifier: MIT
// Searches for brackets in the text around a mistake, without a scan. A search ends after
// kMaxSearchedBytes bytes, because a statement may be as long as a file; the text beyond counts as
// correct.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lsys {

inline constexpr std::uint32_t kMaxSearchedBytes = 4096;
/// Maximum number of searches in a text.
inline constexpr std::uint32_t kMaxBracketSearches = 1000;

/// The first `)` at or after `at` in the statement that closes no `(` at or after `at`.
[[nodiscard]] std::optional<std::uint32_t> unmatched_parenthesis(std::string_view text,
                                                                 std::uint32_t at);

/// The innermost `[` between `begin` and `at` that has no `]` in the statement.
[[nodiscard]] std::optional<std::uint32_t>
unmatched_branch(std::string_view text, std::uint32_t begin, std::uint32_t at);

/// The last character before `at` that is not a blank; NUL if there is none.
[[nodiscard]] char character_before(std::string_view text, std::uint32_t at);

} // namespace lsys
