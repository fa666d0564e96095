// The text form of an Ast: `lsc dump --stage ast`. One statement a line, modules as written,
// operations before their operands so that their nesting shows.
#pragma once

#include "grammar/ast/ast.h"

#include <string>

namespace lsys {

[[nodiscard]] std::string dump_ast(const Ast& ast, const Names& names, const SourceMap& sources);

} // namespace lsys
