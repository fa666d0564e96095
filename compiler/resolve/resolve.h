// SPDX-License-Identifier: MIT
// The resolution: Ast to Program. Applies the rules of docs/language.md about names, numbers and
// the form of productions; compiler/lint has the rules about whole programs.
#pragma once

#include "compiler/program/compile_options.h"
#include "compiler/program/program.h"
#include "grammar/ast/ast.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/source.h"

#include <string>
#include <vector>

namespace lsys {

struct ResolveOutcome {
    Program program;
    std::vector<std::string> unknown_definitions; // -D names without a #define or #param
};

/// Resolves the Ast. Releases parts of the Ast as soon as they are resolved, to save memory.
[[nodiscard]] ResolveOutcome resolve(Ast ast,
                                     Names& names,
                                     const SourceMap& sources,
                                     const CompileOptions& options,
                                     Diagnostics& diagnostics);

/// Applies the `#set` statements of `ast` to `settings`. Precondition: `ast` defines no constants.
void resolve_settings(
    Ast& ast, Names& names, const SourceMap& sources, Settings& settings, Diagnostics& diagnostics);

} // namespace lsys
