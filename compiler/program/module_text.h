// How far a module reaches in the text, which a Program does not keep.
#pragma once

#include <cstddef>
#include <string_view>

namespace lsys {

/// Past blanks and comments.
[[nodiscard]] std::size_t skip_blanks(std::string_view text, std::size_t at);

/// One past the `)` of the arguments of a module whose name ends at `name_end`; `name_end` if no
/// parenthesis follows.
[[nodiscard]] std::size_t end_of_arguments(std::string_view text, std::size_t name_end);

} // namespace lsys
