// The note about a file of L3D whose rules give another word in the order of their lines than in
// the order of their keys, by which L3D sorts them.
#pragma once

#include "grammar/ast/parse_context.h"
#include "grammar/dialects/l3d/reader.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace lsys {

/// `rules`: in the order of the file, without comments. Derives the word in both orders, up to
/// `generations` or a limit of work, and reports only what differs there.
void report_rule_order(const std::vector<L3dRule>& rules,
                       std::string_view axiom,
                       std::uint32_t generations,
                       const ParseContext& context);

} // namespace lsys
