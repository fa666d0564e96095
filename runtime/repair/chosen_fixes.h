// SPDX-License-Identifier: MIT
// Chooses the fixes for one round of `lsc check --fix`, and applies them to texts.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"
#include "runtime/repair/fixes.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::repair {

using FileEdits = std::map<std::string, std::vector<const Edit*>>;
/// Fixes that can be applied together, with their edits by path, sorted by place.
struct ChosenFixes {
    std::vector<const Diagnostic*> diagnostics; // the diagnostic of each of `fixes`
    std::vector<const Fix*> fixes;
    FileEdits edits;
};
using FixFilter = std::function<bool(const Diagnostic&, const Fix&)>;
/// Chooses the first certain fix of each diagnostic, or with FixChoice::Offered its first fix.
/// Skips a fix that `is_allowed` refuses or whose edits overlap edits chosen before.
[[nodiscard]] ChosenFixes choose_fixes(const Diagnostics& diagnostics,
                                       const SourceMap& sources,
                                       FixChoice choice,
                                       const FixFilter& is_allowed);

/// `text` after `edits`. Line feeds of replacements become CRLF if the text has CRLF. Precondition:
/// `edits` are sorted by place and do not overlap.
[[nodiscard]] std::string apply_edits(std::string_view text, const std::vector<const Edit*>& edits);

} // namespace lsys::repair
