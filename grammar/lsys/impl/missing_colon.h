// SPDX-License-Identifier: MIT
// Messages about productions with too few parts.
#pragma once

#include "grammar/lsys/impl/parse_session.h"

#include <string_view>

namespace lsys::lsys_grammar {

/// Reports, at the current match, a production with too few `:`; returns whether it is one. The fix
/// adds `inserted` unless it is empty.
bool report_missing_colon(ParseSession& session, std::string_view inserted);

} // namespace lsys::lsys_grammar
