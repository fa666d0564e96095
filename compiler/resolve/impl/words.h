// SPDX-License-Identifier: MIT
// Resolves module lists of the axiom and of successors to words of the Program.
#pragma once

#include "compiler/resolve/impl/environments.h"
#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/resolution.h"
#include "compiler/resolve/impl/split_report.h"
#include "compiler/resolve/impl/splitting.h"
#include "compiler/resolve/impl/symbols.h"

#include <vector>

namespace lsys {

/// State shared by the parts of the resolution that read module lists.
struct ModuleReading {
    Resolution& resolution;
    SymbolTable& symbols;
    NameSplitter& splitter;
    ExpressionResolver& expressions;
    EnvironmentResolver& environments;
    SplitReport splits;
    /// Cache by name: the symbol of its modules without arguments; kNoSymbol if not cached.
    /// Names that are split into several modules are never cached.
    std::vector<SymbolId> bare;
};

/// Reports parameters of a module that takes none, and a sense module without environment. Returns
/// false if the module is in error.
[[nodiscard]] bool check_module(ModuleReading& reading, const ModuleView& module);

/// Resolves the modules of a list and appends them to the Program. Ranges in the arguments are
/// numbered from 0.
[[nodiscard]] ProgramWord
resolve_word(ModuleReading& reading, ModuleList list, ExpressionPlace place);

} // namespace lsys
