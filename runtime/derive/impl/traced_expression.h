// SPDX-License-Identifier: MIT
// Expressions evaluated with the text and the value of each part, for traces.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/derive/engine/eval.h"
#include "runtime/derive/trace.h"

#include <optional>
#include <string>
#include <vector>

namespace lsys {

/// The inputs of expressions of one production for one module.
struct TracedFrame {
    const Bytecode& bytecode;
    EvalFrame values;
    const ProductionNames* names = nullptr; // may be null
};

/// Evaluates a condition or a weight at instruction `first`.
[[nodiscard]] ExpressionTrace trace_condition(const TracedFrame& frame, std::uint32_t first);

/// The evaluated local values and arguments of a successor.
struct SuccessorTrace {
    std::vector<TracedLocal> locals;
    std::vector<TracedRange> ranges;
    std::vector<float> arguments; // arguments up to the first fault
    std::string fault;            // describes a value that cannot be used; empty: none
};
/// `draws`: the draws of the module; `first_draw`: the draw number of range 0.
[[nodiscard]] SuccessorTrace trace_successor(const TracedFrame& frame,
                                             const WordTemplate& word,
                                             RangeDraws draws,
                                             std::uint64_t first_draw);

} // namespace lsys
