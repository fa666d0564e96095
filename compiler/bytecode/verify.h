// Verification of Bytecode: every index in range, stacks balanced, operands of the right kind,
// formals numbered in order, folded constants finite, rules and groups dense. Debug builds verify
// emitted bytecode; a loaded file is always verified. Verified bytecode runs without more checks.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <optional>
#include <string>

namespace lsys {

/// Depth of the stack of nearly all code. Code of deep expressions computes the deeper operand
/// first, which bounds the stack by the logarithm of the size of the expression; only choices
/// within choices need more (Bytecode::stack_depth).
inline constexpr std::uint32_t kUsualStack = 256;

/// The first problem, or nothing.
[[nodiscard]] std::optional<std::string> verify(const Bytecode& bytecode);

} // namespace lsys
