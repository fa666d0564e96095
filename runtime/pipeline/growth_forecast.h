// Predictions of the sizes of words before deriving: whether they pass a limit, and their numbers
// of modules. Only if they are exact and quick to compute.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/limits.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// The limit report of a derivation of `generations` generations from the axiom, if it is certain
/// to pass the limit on modules.
[[nodiscard]] std::optional<LimitReport>
predict_limit(const Bytecode& bytecode, std::uint32_t generations, const Limits& limits);

/// The numbers of modules of the words of all ages up to `generations`, if no word passes the limit
/// and no derivation can end in an error: no parameters, no conditions, brackets in pairs, and
/// numbers that do not depend on draws.
[[nodiscard]] std::optional<std::vector<std::uint64_t>>
predict_counts(const Bytecode& bytecode, std::uint32_t generations, const Limits& limits);

/// The expected numbers of modules of all generations up to `generations`; empty where unknown.
[[nodiscard]] std::vector<double> expect_modules(const Bytecode& bytecode,
                                                 std::uint32_t generations);

} // namespace lsys
