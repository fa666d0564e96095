// SPDX-License-Identifier: MIT
// Colour maps and materials of vlab as `#material` statements.
#pragma once

#include "grammar/dialects/cpfg/looks.h"

#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The `#material` statements of the colours that the model uses; empty if the file is neither a
/// colour map nor materials. `first_colour`: colour at the start of the word.
[[nodiscard]] std::string
material_statements(std::string_view colours, const CpfgUses& uses, unsigned first_colour);

/// The `#material` statements of these colours with each texture that the model uses: colour i of
/// texture n, from 1, has the index 256 n + i.
[[nodiscard]] std::string texture_statements(std::string_view colours,
                                             const CpfgUses& uses,
                                             const std::vector<CpfgTexture>& textures,
                                             unsigned first_colour);

} // namespace lsys
