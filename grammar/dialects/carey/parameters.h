// SPDX-License-Identifier: MIT
// Parameters that stay in the text when a rule of a .rules file replaces the symbol before them:
// the forest generator replaces text, so the rule `F=FF` turns `F(2)` into `FF(2)`.
#pragma once

#include "grammar/ast/parse_context.h"
#include "grammar/dialects/carey/reader.h"

#include <cstddef>
#include <vector>

namespace lsys {

/// Parameter counts that can follow the left side of each rule of the file, ascending.
struct LeftParameters {
    std::vector<std::vector<std::size_t>> counts_by_rule;
    bool has_counts = false; // some rule has a count
};

/// Follows the parameters of axiom and right sides through the rules. A note reports a parameter
/// that moves to another symbol, an error a parameter that no module can take. CareyWriter reports
/// mistakes within the texts.
[[nodiscard]] LeftParameters find_left_parameters(const CareyFile& file,
                                                  const ParseContext& context);

} // namespace lsys
