// What the end of a derivation makes of a command: its message and its exit status.
#pragma once

#include "runtime/cli/console.h"
#include "runtime/cli/grammar_file.h"
#include "runtime/derive.h"

#include <vector>

namespace lsys::lsc {

/// Shows a diagnostic of the run; returns `status`.
Status show(Diagnostic diagnostic, Status status, const Grammar& grammar, const Console& console);

/// Prints an error of the environment; returns Failure, or Limit where memory is meant.
Status fail(const Error& error, const Console& console);

/// The exit status of a derivation that ended as `status`, after its message.
[[nodiscard]] Status tell(DeriveStatus status,
                          const RuntimeError& error,
                          const LimitReport& limit,
                          const Limits& limits,
                          const Grammar& grammar,
                          const Console& console);

} // namespace lsys::lsc
