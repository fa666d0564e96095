// SPDX-License-Identifier: MIT
// Verification of Bytecode: every index in range, stacks balanced, operands of the right kind,
// formals numbered in order, folded constants finite, rules and groups numbered without gaps. Debug
// builds verify emitted bytecode; a loaded file is always verified. Verified bytecode runs without
// more checks.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <optional>
#include <string>

namespace lsys {

/// Max stack depth of code without choices and without mix(). Deep expressions compute the deeper
/// operand first, which bounds the stack depth by the logarithm of the expression size. Nested
/// choices and nested calls of mix() may need more (Bytecode::stack_depth).
inline constexpr std::uint32_t kUsualStack = 256;

/// The first problem, as text for messages, or nothing if the bytecode is valid.
[[nodiscard]] std::optional<std::string> verify(const Bytecode& bytecode);

} // namespace lsys
