// Looks for brackets in the text around a mistake, without scanning it. Each search ends after
// kMaxBracketSearch bytes, since a statement may be as long as a file; what lies beyond is taken to
// be right.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lsys {

inline constexpr std::uint32_t kMaxBracketSearch = 4096;
/// A text with more mistakes than this is no longer searched.
inline constexpr std::uint32_t kMaxBracketSearches = 1000;

/// The first `)` of the statement from `at` on that closes no `(` there.
[[nodiscard]] std::optional<std::uint32_t> unmatched_parenthesis(std::string_view text,
                                                                 std::uint32_t at);

/// The innermost `[` of the modules from `begin` on that is open at `at` and that no `]` of the
/// statement is left for.
[[nodiscard]] std::optional<std::uint32_t>
unmatched_branch(std::string_view text, std::uint32_t begin, std::uint32_t at);

/// The last character before `at` that is no blank; NUL if there is none.
[[nodiscard]] char character_before(std::string_view text, std::uint32_t at);

} // namespace lsys
