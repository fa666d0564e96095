// .sys: the grammars of the forest of 2005. A header `LSYSTEM`, the number of rules, the axiom,
// then a line `A R p` for each rule: symbol, replacement, probability. Its turtle is the profile
// `sys`.
#pragma once

#include "grammar/dialects/dialect.h"

#include <string_view>

namespace lsys {

[[nodiscard]] std::string_view recognise_sys(std::string_view text);
[[nodiscard]] Translation translate_sys(FileId root, const ParseContext& context);

} // namespace lsys
