// SPDX-License-Identifier: MIT
// The entry point of the compiler: Ast to Program to Bytecode.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "compiler/program/compile_options.h"
#include "compiler/program/program.h"
#include "grammar/ast/ast.h"
#include "grammar/base/diagnostic.h"
#include "grammar/base/names.h"
#include "grammar/base/result.h"
#include "grammar/base/source.h"

#include <optional>
#include <string>
#include <vector>

namespace lsys {

struct CompileOutcome {
    std::optional<Program> program;   // unset after errors, or for CompileOptions::part
    std::optional<Bytecode> bytecode; // unset like `program`, or without CompileOptions::lower
    std::vector<std::string> unknown_definitions; // -D names without a #define or #param
};

/// Checks and compiles; appends diagnostics. Frees parts of the Ast early to keep peak memory low.
[[nodiscard]] CompileOutcome compile(Ast ast,
                                     Names& names,
                                     const SourceMap& sources,
                                     const CompileOptions& options,
                                     Diagnostics& diagnostics);

/// Applies the `#set` statements of `ast` to the settings of compiled code. Mistakes in the
/// statements become diagnostics. Error: verify() refuses the code with these settings.
/// Precondition: `ast` defines no constants.
[[nodiscard]] Result<void> change_settings(
    Ast& ast, Names& names, const SourceMap& sources, Bytecode& bytecode, Diagnostics& diagnostics);

} // namespace lsys
