// SPDX-License-Identifier: MIT
// Traces as text for people and as JSON for tools: docs/trace.md describes both.
#pragma once

#include "runtime/pipeline/grammar.h"
#include "runtime/pipeline/trace.h"

#include <string>

namespace lsys {

/// The trace as text: one paragraph per decision, with lines of the grammar; about one screen per
/// module.
[[nodiscard]] std::string trace_text(const Trace& trace, const Grammar& grammar, bool colour);
/// The trace as a JSON object with a line end.
[[nodiscard]] std::string trace_json(const Trace& trace, const Grammar& grammar);

} // namespace lsys
