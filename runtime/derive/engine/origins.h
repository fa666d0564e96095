// SPDX-License-Identifier: MIT
// Writes the origins of the modules that a pass writes, if DeriveOptions::origins is set: reads the
// records of the counting pass a second time. The origin of a written module is its place in the
// successor; a copied module keeps its origin. Successors of a module followed by
// Derivation::follow() keep its index.
#pragma once

#include "runtime/derive/engine/active_mask.h"
#include "runtime/derive/engine/match.h"
#include "runtime/derive/engine/plan.h"

#include <cstdint>

namespace lsys {

/// Modules [begin, end) of the input word, which write_modules() has just rewritten.
struct OriginRequest {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    std::uint32_t generation = 0;     // generation of the written word
    const ActiveMask* mask = nullptr; // the mask of WriteRequest
};

/// Writes origins to `out`; returns the pointer behind them. `records` as in write_modules().
/// Precondition: word.origins is not null.
template <typename C, typename R>
[[nodiscard]] Origin* trace_origins(const Plan& plan,
                                    const WordView<C>& word,
                                    const OriginRequest& request,
                                    const R* records,
                                    Origin* out);

/// Writes the origins of the axiom's modules.
void copy_axiom_origins(const BytecodeAxiom& axiom, Origin* out);

} // namespace lsys
