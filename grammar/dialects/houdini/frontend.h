// The rule texts of Houdini's L-system node: settings, the premise, then a rule
// `left<symbol>right:condition=replacement:probability` a line. Its turtle is the profile `sidefx`.
#pragma once

#include "grammar/dialects/dialect.h"

#include <string_view>

namespace lsys {

[[nodiscard]] std::string_view recognise_houdini(std::string_view text);
[[nodiscard]] Translation translate_houdini(FileId root, const ParseContext& context);

} // namespace lsys
