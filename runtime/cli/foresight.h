// What is known of a run before it derives anything: that it cannot fit, and how many modules its
// words have. Only where that is exact and quickly found; otherwise the run itself finds out.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/base/limits.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace lsys::lsc {

/// What the derivation of `generations` generations from the axiom would report when it meets the
/// limit on modules, if it surely will.
[[nodiscard]] std::optional<LimitReport>
foresee_limit(const Bytecode& bytecode, std::uint32_t generations, const Limits& limits);

/// The number of modules of the words of all ages up to `generations`, which cannot end in an
/// error: no parameters, no conditions, brackets in pairs, as many modules whatever is drawn, and
/// none of the words over the limit.
[[nodiscard]] std::optional<std::vector<std::uint64_t>>
foresee_counts(const Bytecode& bytecode, std::uint32_t generations, const Limits& limits);

/// Modules that are expected of each generation up to `generations`; empty where nothing is.
[[nodiscard]] std::vector<double> expect_modules(const Bytecode& bytecode,
                                                 std::uint32_t generations);

} // namespace lsys::lsc
