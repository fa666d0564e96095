// SPDX-License-Identifier: MIT
// Alternative repairs of a statement with a missing, doubled or mistyped bracket or comma. The
// repair that the parser proposes is certain only if no alternative is as plausible.
#pragma once

#include "grammar/base/diagnostic.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::repair {

struct StatementRepair {
    DiagnosticCode code{};      // code of the mistake
    std::string_view broken;    // the statement before the repair
    std::string_view repaired;  // the statement after it
    std::uint32_t place = 0;    // byte offset of the first edit in `broken`
    std::string_view file_text; // whole file; its `#set names` applies to the statement
    /// Whether the file has only one mistake of this code; the bracket may then be a mistyped digit
    /// or name.
    bool is_single = false;
};

/// Whether the repair of a mistake may have alternatives: true for brackets and commas.
[[nodiscard]] bool may_have_alternatives(DiagnosticCode code);

/// Longer statements, in bytes, have no alternatives.
inline constexpr std::size_t kMaxComparedStatement = 2000;

/// Statement texts after alternative repairs: each changes the broken statement at one place,
/// parses, and has a syntax tree unlike those of `repaired` and the other alternatives. Empty for
/// statements of more than kMaxComparedStatement bytes.
[[nodiscard]] std::vector<std::string> alternative_repairs(const StatementRepair& repair);

} // namespace lsys::repair
