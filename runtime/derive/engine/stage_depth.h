// SPDX-License-Identifier: MIT
// The depth to which productions of a stage can nest: one may rewrite modules that another wrote.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>

namespace lsys {

/// Draws of later stages have numbers of their own (docs/language.md section 6): kDrawsOfPass per
/// pass, from the first draw of the stage on.
inline constexpr std::uint64_t kDrawsOfPass = std::uint64_t{kMaxSequentialDraws} + 1;
inline constexpr std::uint64_t kFirstDecomposeDraw = std::uint64_t{1} << 32;
inline constexpr std::uint64_t kFirstInterpretDraw = kFirstDecomposeDraw + (std::uint64_t{1} << 31);

/// The passes of Stage::Decompose or Stage::Interpret.
struct StageDepth {
    std::uint32_t passes = 0; // until nothing can match, or the max number allowed
    bool checked = false;     // a module that still matches after these passes is an error
};
[[nodiscard]] StageDepth stage_depth(const Bytecode& bytecode, Stage stage);

} // namespace lsys
