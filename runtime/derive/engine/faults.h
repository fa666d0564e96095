// SPDX-License-Identifier: MIT
// Finds the module at which a pass has failed: evaluates module by module, slowly, up to the
// lowest position at which a condition, weight or argument fails.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/derive/engine/choose.h"

#include <optional>

namespace lsys {

/// The error of a fault, without production and module, which the caller sets.
[[nodiscard]] RuntimeError error_of(const Bytecode& bytecode, const EvalFault& fault);

/// The first fault among the modules from `begin` to `end`; a match of several modules may reach
/// past `end`. Within a module, conditions in file order come before arguments from left to right.
template <typename C>
[[nodiscard]] std::optional<RuntimeError> find_fault(const Plan& plan,
                                                     const PassKeys& keys,
                                                     const WordView<C>& word,
                                                     const ContextTables* contexts,
                                                     ModulePlace begin,
                                                     std::uint64_t end);

} // namespace lsys
