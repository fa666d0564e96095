// SPDX-License-Identifier: MIT
// The .lsys front end: text to Ast.
#pragma once

#include "grammar/ast/ast.h"
#include "grammar/ast/parse_context.h"
#include "grammar/ast/translation.h"
#include "grammar/base/source.h"

namespace lsys {

/// Parses the .lsys file `root` and its included files in place. After errors the Ast holds the
/// statements without syntax errors.
[[nodiscard]] Ast parse_lsys(FileId root, const ParseContext& context);

/// Parses the text of a translation; all places are in the original.
[[nodiscard]] Ast parse_translation(const Translation& translation, const ParseContext& context);

} // namespace lsys
