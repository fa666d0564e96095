// The one entry of the compiler: Ast to Program to Bytecode. Both `lsc` and the viewer come through
// here.
#pragma once

#include "compiler/bytecode.h"
#include "compiler/compile_options.h"
#include "compiler/program.h"
#include "grammar/ast.h"
#include "grammar/diagnostic.h"
#include "grammar/names.h"
#include "grammar/source.h"

#include <optional>
#include <string>
#include <vector>

namespace lsys {

struct CompileOutcome {
    std::optional<Program> program;               // without errors only
    std::optional<Bytecode> bytecode;             // without errors only
    std::vector<std::string> unknown_definitions; // -D names that no #define or #param has
};

/// Checks and compiles. Diagnostics are appended; the Ast is consumed to keep peak memory low.
[[nodiscard]] CompileOutcome compile(Ast ast,
                                     Names& names,
                                     const SourceMap& sources,
                                     const CompileOptions& options,
                                     Diagnostics& diagnostics);

} // namespace lsys
