// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/resolution.h"

#include <fmt/format.h>

#include <algorithm>

namespace lsys {

std::string Suggestions::nearest(std::string_view wanted,
                                 const std::vector<std::string_view>& candidates) {
    if (!may_compare(candidates.size())) {
        return {};
    }
    work_left_ -= candidates.size();
    return std::string(nearest_name(wanted, candidates).value_or(""));
}

void suggest(Diagnostic& diagnostic, SourceSpan span, std::string_view name) {
    diagnostic.help.push_back(fmt::format("did you mean {}?", quoted(name)));
    diagnostic.fixes.push_back(
        {fmt::format("write {}", quoted(name)), {{span, std::string(name)}}, false});
}

} // namespace lsys
