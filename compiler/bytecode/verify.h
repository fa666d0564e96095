// Verification of Bytecode: every index in range, stacks balanced, operands of the right kind,
// formals numbered in order, folded constants finite, rules and groups dense. Debug builds verify
// emitted bytecode; a loaded file is always verified. Verified bytecode runs without more checks.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <optional>
#include <string>

namespace lsys {

/// Maximum depth of the expression stack of verified bytecode. Code of deeper expressions computes
/// the deeper operand first, which bounds the stack by the logarithm of the size of the
/// expression.
inline constexpr std::uint32_t kMaxStack = 256;

/// The first problem, or nothing.
[[nodiscard]] std::optional<std::string> verify(const Bytecode& bytecode);

} // namespace lsys
