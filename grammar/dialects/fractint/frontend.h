// .l collections of Fractint: many systems in a file, each `name { ... }` with an angle, an axiom
// and rules of one symbol, in any case of letters. Its turtle is the profile `fractint`.
#pragma once

#include "grammar/dialects/dialect.h"

#include <string>
#include <string_view>
#include <vector>

namespace lsys {

[[nodiscard]] std::string_view recognise_fractint(std::string_view text);
/// The names of the systems of a collection, in order.
[[nodiscard]] std::vector<std::string> systems_in_fractint(std::string_view text);
/// Of the system that `context` names, or of the only one.
[[nodiscard]] Translation translate_fractint(FileId root, const ParseContext& context);

} // namespace lsys
