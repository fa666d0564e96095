// The end of a module in its text, which a Program does not keep.
#pragma once

#include <cstddef>
#include <string_view>

namespace lsys {

/// Offset of the first byte from `at` on that is no blank and in no comment.
[[nodiscard]] std::size_t skip_blanks(std::string_view text, std::size_t at);

/// One past the `)` of the arguments that follow a name ending at `name_end`; `name_end` without
/// arguments.
[[nodiscard]] std::size_t end_of_arguments(std::string_view text, std::size_t name_end);

} // namespace lsys
