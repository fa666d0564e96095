// Is this Bytecode well-formed? Every index in range, stacks balanced, operands of the right kind,
// formals numbered in order, folded constants finite, rules and groups dense. The emitter asks in
// debug builds, a loaded file is always asked; what passes can be run without further checks.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <optional>
#include <string>

namespace lsys {

/// The deepest expression stack a verified program can need. Deeper expressions are no obstacle:
/// the deeper operand is then computed first, which bounds the stack by the logarithm of their
/// size.
inline constexpr std::uint32_t kMaxStack = 256;

/// The first problem, or nothing.
[[nodiscard]] std::optional<std::string> verify(const Bytecode& bytecode);

} // namespace lsys
