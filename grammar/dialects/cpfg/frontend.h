// cpfg: the L-system files of L-studio and vlab. A label `Lsystem: 1`, header items, the axiom,
// productions `left < predecessor > right : {statements} condition {statements} --> successor :
// weight`, then decomposition and homomorphism. Lines go on where the next begins with a tab. Its
// turtle is the profile `abop`.
#pragma once

#include "grammar/dialects/dialect.h"

#include <string_view>

namespace lsys {

[[nodiscard]] std::string_view recognise_cpfg(std::string_view text);
[[nodiscard]] Translation translate_cpfg(FileId root, const ParseContext& context);

} // namespace lsys
