// The .lsys front end with a form of module names that replaces the `#set names` of the file.
#pragma once

#include "grammar/ast/ast.h"
#include "grammar/ast/parse_context.h"
#include "grammar/base/source.h"

#include <string_view>

namespace lsys {

/// parse_lsys() with `names`, which is `words`, `letters` or `characters`, as the form of module
/// names of `root`, but not of its included files. Another word leaves the form to the file.
[[nodiscard]] Ast
parse_lsys_with_names(FileId root, std::string_view names, const ParseContext& context);

} // namespace lsys
