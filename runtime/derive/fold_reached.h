// Folds the modules that a derivation can reach. Where the arguments of the modules are few
// different tuples, as in most published systems (lengths that grow by a factor each generation,
// counters that run down), a module with its arguments is one code: then words store no parameters,
// conditions are decided once a code, and what was parametric is rewritten as fast as what is not.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>
#include <optional>

namespace lsys {

/// The program with all modules folded whose arguments are known when a derivation from the axiom
/// begins and that `generations` generations can write. It derives the same words, with codes of
/// its own. Nothing if there is nothing to fold, or if these modules are more than codes of the
/// same width can tell apart.
[[nodiscard]] std::optional<Bytecode>
fold_reached(const Bytecode& bytecode, std::uint64_t seed, std::uint32_t generations);

} // namespace lsys
