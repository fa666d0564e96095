// SPDX-License-Identifier: MIT
// Texts of the errors of constant folding.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <string>

namespace lsys {

/// The reason why an instruction with these operands yields an infinity or NaN: "division by zero".
[[nodiscard]] std::string reason_for_fault(Opcode opcode, float x, float y);

} // namespace lsys
