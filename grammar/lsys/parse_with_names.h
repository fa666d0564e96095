// SPDX-License-Identifier: MIT
// The .lsys front end with a form of module names that replaces the `#set names` of the file.
#pragma once

#include "grammar/ast/ast.h"
#include "grammar/ast/parse_context.h"
#include "grammar/base/source.h"

#include <string_view>

namespace lsys {

/// parse_lsys() with `names` (`words`, `letters` or `characters`) in place of the `#set names` of
/// `root`; any other value keeps the file's own. Included files are not affected.
[[nodiscard]] Ast
parse_lsys_with_names(FileId root, std::string_view names, const ParseContext& context);

} // namespace lsys
