// SPDX-License-Identifier: MIT
// Folds the modules that a derivation can reach. If modules have few different tuples of arguments,
// as in most published systems (lengths that grow by a factor per generation, counters that run
// down), a module with its arguments becomes one code. Words then store no parameters, conditions
// are decided once per code, and parametric systems are rewritten as fast as those without
// parameters.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <optional>

namespace lsys {

/// The program with folded modules: all modules with arguments known in advance that `generations`
/// generations can write from the axiom. It derives the same words with different codes. Returns
/// nothing if no module can be folded, or if the codes need a greater width.
[[nodiscard]] std::optional<Bytecode>
fold_reached(const Bytecode& bytecode, std::uint64_t seed, std::uint32_t generations);

} // namespace lsys
