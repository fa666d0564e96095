// SPDX-License-Identifier: MIT
// Messages and exit status of a derivation that a command runs itself.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/console.h"

namespace lsys::lsc {

/// Prints a diagnostic whose places are in the grammar; returns `status`.
ExitStatus show_diagnostic(Diagnostic diagnostic,
                           ExitStatus status,
                           const Grammar& grammar,
                           const Console& console);

/// Prints why a derivation stopped; returns the exit status.
[[nodiscard]] ExitStatus report_derivation(const DerivationEnd& end,
                                           const Limits& limits,
                                           const Grammar& grammar,
                                           const Console& console);

} // namespace lsys::lsc
