// SPDX-License-Identifier: MIT
// The text listing of Bytecode: `lsc dump --stage bytecode`. Precondition: verify() accepts the
// bytecode.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <string>

namespace lsys {

[[nodiscard]] std::string disassemble(const Bytecode& bytecode);

} // namespace lsys
