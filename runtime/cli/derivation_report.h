// The message and the exit status of a derivation that the command itself runs.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/program/console.h"

namespace lsys::lsc {

/// Shows a diagnostic with places in the grammar; returns `status`.
ExitStatus show_diagnostic(Diagnostic diagnostic,
                           ExitStatus status,
                           const Grammar& grammar,
                           const Console& console);

/// The exit status of a derivation that ended as `status`, after its message.
[[nodiscard]] ExitStatus report_derivation(DeriveStatus status,
                                           const RuntimeError& error,
                                           const LimitReport& limit,
                                           const Limits& limits,
                                           const Grammar& grammar,
                                           const Console& console);

} // namespace lsys::lsc
