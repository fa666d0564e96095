// .rules: the rule lists of Carey's forest generator. Settings of its form as a header, then a line
// `LHS=RHS:ratio` for each rule. Rewriting is cyclic, a left side may be several symbols, ratios
// are normalised.
#pragma once

#include "grammar/dialects/dialect.h"

#include <string_view>

namespace lsys {

[[nodiscard]] std::string_view recognise_carey(std::string_view text);
[[nodiscard]] Translation translate_carey(FileId root, const ParseContext& context);

} // namespace lsys
