// The text listing of verified Bytecode: `lsc dump --stage bytecode`.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <string>

namespace lsys {

[[nodiscard]] std::string disassemble(const Bytecode& bytecode);

} // namespace lsys
