// .l, .l3d and .l++: the texts of L3D and its L+System. Three numbers (generations, angle,
// thickness in percent), an axiom, lines `key=value`, and a line `@`. Rewriting replaces text, key
// after key; of several values of one key each generation takes one. Words are texts too, so
// modules are characters here, and the turtle reads parameters.
#pragma once

#include "grammar/dialects/dialect.h"

#include <string_view>

namespace lsys {

/// Of both: what their files hold does not tell them apart.
[[nodiscard]] std::string_view recognise_l3d(std::string_view text);
[[nodiscard]] Translation translate_l3d(FileId root, const ParseContext& context);
[[nodiscard]] Translation translate_lplus(FileId root, const ParseContext& context);

} // namespace lsys
