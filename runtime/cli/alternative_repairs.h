// Alternative repairs of a statement with a missing, doubled or mistyped bracket or comma. If one
// of them is as plausible as the proposed repair, that is not certain.
#pragma once

#include "grammar/base/diagnostic.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::lsc {

struct StatementRepair {
    DiagnosticCode code{};   // of the mistake
    std::string_view broken; // the statement before the repair
    std::string_view repaired;
    std::uint32_t place = 0;    // of the first edit, in `broken`
    std::string_view file_text; // with the `#set names` of the statement
};

/// Whether the repair of a mistake may have alternatives: one of a bracket or comma.
[[nodiscard]] bool may_have_alternatives(DiagnosticCode code);

/// The statement after each alternative repair by one character that parses, with readings
/// different from `repaired` and each other. None for statements of more than kMaxComparedStatement
/// bytes.
inline constexpr std::size_t kMaxComparedStatement = 2000;
[[nodiscard]] std::vector<std::string> alternative_repairs(const StatementRepair& repair);

} // namespace lsys::lsc
