// SPDX-License-Identifier: MIT
#include "compiler/resolve/impl/resolution.h"

#include <fmt/format.h>

namespace lsys {

void suggest(Diagnostic& diagnostic, SourceSpan span, std::string_view name) {
    diagnostic.help.push_back(fmt::format("did you mean {}?", quoted(name)));
    diagnostic.fixes.push_back(
        {fmt::format("write {}", quoted(name)), {{span, std::string(name)}}, false});
}

} // namespace lsys
