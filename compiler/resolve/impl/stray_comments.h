// SPDX-License-Identifier: MIT
// `//` among modules that is meant as a comment (docs/language.md section 1).
#pragma once

#include "compiler/resolve/impl/resolution.h"
#include "compiler/resolve/impl/splitting.h"

namespace lsys {

/// Reports each `//` before a word that is not a module of the grammar: the word is neither known,
/// nor used outside of comments, nor split into modules. `known`: by name, whether the module
/// name is known. Precondition: no module of the Ast has been released.
void check_stray_comments(Resolution& resolution,
                          const std::vector<bool>& known,
                          NameSplitter& splitter);

} // namespace lsys
