// SPDX-License-Identifier: MIT
// The text form of an Ast, for `lsc dump --stage ast`: one statement per line, modules as written,
// expressions in prefix notation.
#pragma once

#include "grammar/ast/ast.h"

#include <string>

namespace lsys {

[[nodiscard]] std::string dump_ast(const Ast& ast, const Names& names, const SourceMap& sources);

} // namespace lsys
