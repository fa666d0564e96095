// A listing of Bytecode for people: `lsc dump --stage bytecode`. Total: any verified Bytecode has
// one.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <string>

namespace lsys {

[[nodiscard]] std::string disassemble(const Bytecode& bytecode);

} // namespace lsys
