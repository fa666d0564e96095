// Sizes of words before anything is derived: that they pass a limit, and their numbers of modules.
// Only where they are exact and quickly found; otherwise the run itself finds out.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/limits.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// The report of a derivation of `generations` generations from the axiom that certainly passes the
/// limit on modules.
[[nodiscard]] std::optional<LimitReport>
predict_limit(const Bytecode& bytecode, std::uint32_t generations, const Limits& limits);

/// The numbers of modules of the words of all ages up to `generations`, where no word passes the
/// limit and no derivation can end in an error: no parameters, no conditions, brackets in pairs,
/// and the same numbers whatever is drawn.
[[nodiscard]] std::optional<std::vector<std::uint64_t>>
predict_counts(const Bytecode& bytecode, std::uint32_t generations, const Limits& limits);

/// The expected numbers of modules of all generations up to `generations`; empty where unknown.
[[nodiscard]] std::vector<double> expect_modules(const Bytecode& bytecode,
                                                 std::uint32_t generations);

} // namespace lsys
