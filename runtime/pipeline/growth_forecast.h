// SPDX-License-Identifier: MIT
// Predictions of word sizes before deriving: limits that words will exceed, and numbers of modules.
// Exact, except predict_expected_modules(). Programs of more than 10,000 productions have no
// predictions, which would be slow.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/limits.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// The limit report of a derivation of `generations` generations from the axiom. Nothing unless the
/// derivation is certain to exceed the limit on modules.
[[nodiscard]] std::optional<LimitReport>
predict_limit(const Bytecode& bytecode, std::uint32_t generations, const Limits& limits);

/// The number of modules of each generation up to `generations`. Nothing if a word exceeds the
/// limit, if a number depends on random draws, or if a derivation could end in an error: the
/// program has parameters, conditions, computed weights or unpaired brackets.
[[nodiscard]] std::optional<std::vector<std::uint64_t>>
predict_counts(const Bytecode& bytecode, std::uint32_t generations, const Limits& limits);

/// The expected number of modules of each generation up to `generations`; empty if unknown.
[[nodiscard]] std::vector<double> predict_expected_modules(const Bytecode& bytecode,
                                                           std::uint32_t generations);

} // namespace lsys
