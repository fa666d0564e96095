// SPDX-License-Identifier: MIT
// The note about an L3D file whose order of rules matters: L3D sorts the rules by key, which gives
// another word than the order of the lines.
#pragma once

#include "grammar/ast/parse_context.h"
#include "grammar/dialects/l3d/reader.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

/// `rules`: in the order of the file, without comments. Derives words in both orders, up to
/// `generations` or a limit of work, and reports two rules if their order changes a word.
void report_rule_order(const std::vector<L3dRule>& rules,
                       std::string_view axiom,
                       std::uint32_t generations,
                       const ParseContext& context);

} // namespace lsys
