// SPDX-License-Identifier: MIT
// Finds the end of a module in the source text, since a Program stores only the begin.
#pragma once

#include <cstddef>
#include <string_view>

namespace lsys {

/// Offset of the first byte at or after `at` that is neither a blank nor in a comment.
[[nodiscard]] std::size_t skip_blanks(std::string_view text, std::size_t at);

/// Offset after the `)` of the arguments of a module whose name ends at offset `name_end`;
/// `name_end` if the module has no arguments.
[[nodiscard]] std::size_t end_of_arguments(std::string_view text, std::size_t name_end);

} // namespace lsys
