// The .lsys front end: text to Ast.
#pragma once

#include "grammar/ast/ast.h"
#include "grammar/ast/parse_context.h"
#include "grammar/ast/translation.h"
#include "grammar/base/source.h"

namespace lsys {

/// Parses the .lsys file `root` and, in place, the files it includes. Always yields an Ast; after
/// errors it holds the statements that parsed.
[[nodiscard]] Ast parse_lsys(FileId root, const ParseContext& context);

/// Parses the text of a translation as if it stood in the original, where all places are shown.
[[nodiscard]] Ast parse_translation(const Translation& translation, const ParseContext& context);

} // namespace lsys
