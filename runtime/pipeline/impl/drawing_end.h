// SPDX-License-Identifier: MIT
// Reports the end of a derivation and of the drawing of its word to a step, for single plants and
// for the heroes of forests.
#pragma once

#include "runtime/derive/derive.h"
#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/step.h"
#include "runtime/turtle/turtle.h"

#include <optional>

namespace lsys {

/// Adds the diagnostics of a derivation and of the drawing of its word to `step`. Returns the Stop
/// with which the step has to end, or nothing.
[[nodiscard]] std::optional<Stop> report_drawing(const DerivationEnd& derived,
                                                 const DrawingEnd& drawn,
                                                 const Grammar& grammar,
                                                 Step& step);

} // namespace lsys
