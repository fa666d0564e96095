// Other repairs of a statement in which a bracket or comma is missing, stands twice or was
// mistyped. If one of them is as good as the repair that was proposed, nobody knows which one the
// author meant.
#pragma once

#include "grammar/base/diagnostic.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::lsc {

struct StatementRepair {
    DiagnosticCode code{};   // of the mistake
    std::string_view broken; // the statement as it was
    std::string_view repaired;
    std::uint32_t place = 0;    // of the first edit, in `broken`
    std::string_view file_text; // its `#set names` holds for the statement
};

/// Whether the repair of a mistake may have rivals: it is about a bracket or comma.
[[nodiscard]] bool may_have_alternatives(DiagnosticCode code);

/// The statement as other repairs by one character would make it: those that parse and read
/// differently from `repaired` and from each other. A statement of more than
/// kMaxComparedStatement bytes is not looked at.
inline constexpr std::size_t kMaxComparedStatement = 2000;
[[nodiscard]] std::vector<std::string> alternative_repairs(const StatementRepair& repair);

} // namespace lsys::lsc
