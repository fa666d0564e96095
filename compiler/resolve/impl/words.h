// Module lists of axioms and successors to words of the Program.
#pragma once

#include "compiler/resolve/impl/expressions.h"
#include "compiler/resolve/impl/resolution.h"
#include "compiler/resolve/impl/split_report.h"
#include "compiler/resolve/impl/splitting.h"
#include "compiler/resolve/impl/symbols.h"

#include <vector>

namespace lsys {

/// What the parts of a resolution that read module lists share.
struct ModuleReading {
    Resolution& resolution;
    SymbolTable& symbols;
    NameSplitter& splitter;
    ExpressionResolver& expressions;
    SplitReport splits;
    /// By name: the symbol of its modules without arguments, once met, where the name is one module
    /// however it is written.
    std::vector<SymbolId> bare;
};

/// Reports parameters of a module that takes none. False: the module is wrong.
[[nodiscard]] bool check_module(ModuleReading& reading, const ModuleView& module);

/// Resolves the modules of a list and appends them to the Program. Ranges of its arguments are
/// numbered from 0.
[[nodiscard]] ProgramWord
resolve_word(ModuleReading& reading, ModuleList list, ExpressionPlace place);

} // namespace lsys
