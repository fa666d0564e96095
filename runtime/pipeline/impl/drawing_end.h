// Reports the end of a derivation and of the drawing of its word to a step, for single plants and
// for the heroes of forests.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/step.h"
#include "runtime/turtle/turtle.h"

#include <array>
#include <optional>

namespace lsys {

/// Adds the diagnostics of a derivation and of its drawing to `step`. `drawing_error`: the error of
/// TurtleStatus::NotInterpreted. Returns why the step has to end, or nothing.
[[nodiscard]] std::optional<Stop>
report_drawing(const DerivationEnd& derived,
               TurtleStatus drawn,
               const RuntimeError& drawing_error,
               const std::array<TurtleFault, kTurtleFaultKinds>& faults,
               const Grammar& grammar,
               Step& step);

} // namespace lsys
