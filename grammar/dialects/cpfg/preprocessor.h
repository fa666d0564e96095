// SPDX-License-Identifier: MIT
// The C preprocessor, as far as cpfg files use it: comments, #define with and without parameters,
// #undef, #include, #if of numbers and names, #ifdef, #ifndef, #else, #endif.
#pragma once

#include "grammar/ast/translation.h"
#include "grammar/lsys/parse.h"

namespace lsys {

/// The text of `root` without directives and comments, with macros expanded; each part keeps its
/// place in the files. Mistakes are reported.
[[nodiscard]] Translation preprocess_cpfg(FileId root, const ParseContext& context);

} // namespace lsys
