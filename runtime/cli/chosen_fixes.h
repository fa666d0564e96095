// Which fixes can be applied to a text at once, and the text after them.
#pragma once

#include "grammar/base/diagnostic.h"
#include "grammar/base/source.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::lsc {

/// Fixes that can be applied at once, and their edits by path and place.
using FileEdits = std::map<std::string, std::vector<const Edit*>>;
struct ChosenFixes {
    std::vector<const Diagnostic*> diagnostics; // that each fix is of
    std::vector<const Fix*> fixes;
    FileEdits edits;
};
using FixFilter = std::function<bool(const Diagnostic&, const Fix&)>;
/// Chooses of `diagnostics` the first certain fix of each that `is_allowed`, leaving out those that
/// touch one before.
[[nodiscard]] ChosenFixes
choose_fixes(const Diagnostics& diagnostics, const SourceMap& sources, const FixFilter& is_allowed);

/// `text` with the edits applied; they are in order of place and do not overlap. A line feed of a
/// replacement becomes CRLF where the text has CRLF.
[[nodiscard]] std::string apply_edits(std::string_view text, const std::vector<const Edit*>& edits);

} // namespace lsys::lsc
