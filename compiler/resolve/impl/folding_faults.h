// SPDX-License-Identifier: MIT
// Texts of the errors of constant folding, and the names of the functions.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The reason why an instruction with these operands yields an infinity or NaN: "division by zero".
[[nodiscard]] std::string reason_for_fault(Opcode opcode, float x, float y);

/// The names of all functions of expressions.
[[nodiscard]] std::vector<std::string_view> function_names();

} // namespace lsys
