// SPDX-License-Identifier: MIT
// Faults of a drawing as messages to the grammar's author.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "grammar/base/diagnostic.h"
#include "runtime/turtle/turtle.h"

#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// One diagnostic for each kind of fault that occurred, with the number of faults and the first
/// module: an error if it ends the drawing, else a warning.
[[nodiscard]] std::vector<Diagnostic>
turtle_diagnostics(const std::array<TurtleFault, kTurtleFaultKindCount>& faults,
                   const Bytecode& bytecode);

/// The error that `what`, such as "the skeleton", does not fit into `max_bytes`.
[[nodiscard]] Diagnostic plant_limit_diagnostic(std::string_view what, std::uint64_t max_bytes);
/// Overload for another limit, given in words, with a help text.
[[nodiscard]] Diagnostic
plant_limit_diagnostic(std::string_view what, std::string_view limit, std::string help);

/// The error that the system has no memory for `what`, although it may be within the limit.
[[nodiscard]] Diagnostic no_memory_diagnostic(std::string_view what);

} // namespace lsys
