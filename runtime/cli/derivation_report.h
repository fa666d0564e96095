// Message and exit status of a derivation run by a command.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/console.h"

namespace lsys::lsc {

/// Prints a diagnostic with places in the grammar; returns `status`.
ExitStatus show_diagnostic(Diagnostic diagnostic,
                           ExitStatus status,
                           const Grammar& grammar,
                           const Console& console);

/// Shows the message of a derivation that a Stop ended; returns its exit status.
[[nodiscard]] ExitStatus report_derivation(const DerivationEnd& end,
                                           const Limits& limits,
                                           const Grammar& grammar,
                                           const Console& console);

} // namespace lsys::lsc
