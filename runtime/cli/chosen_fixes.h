// The choice of fixes for one round of `lsc check --fix`, and their application.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"
#include "runtime/cli/fixes.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::lsc {

using FileEdits = std::map<std::string, std::vector<const Edit*>>;
/// Fixes that can be applied together, with their edits by path and place.
struct ChosenFixes {
    std::vector<const Diagnostic*> diagnostics; // one per fix
    std::vector<const Fix*> fixes;
    FileEdits edits;
};
using FixFilter = std::function<bool(const Diagnostic&, const Fix&)>;
/// Chooses the first certain fix of each diagnostic, or with FixChoice::Offered the first one, if
/// `is_allowed` accepts the fix and its edits touch no edit chosen before.
[[nodiscard]] ChosenFixes choose_fixes(const Diagnostics& diagnostics,
                                       const SourceMap& sources,
                                       FixChoice choice,
                                       const FixFilter& is_allowed);

/// `text` after `edits`, which are sorted by place and do not overlap. Line feeds of replacements
/// become CRLF if the text has CRLF.
[[nodiscard]] std::string apply_edits(std::string_view text, const std::vector<const Edit*>& edits);

} // namespace lsys::lsc
