// How deep the productions of a stage can nest: what one writes another may take apart again.
#pragma once

#include "compiler/bytecode/bytecode.h"

#include <cstdint>

namespace lsys {

/// Numbers of draws (docs/language.md section 6) are raised in the passes of later stages, so that
/// none is drawn twice: by these, and 4096 more for each pass.
inline constexpr std::uint64_t kDrawsOfPass = std::uint64_t{kMaxSequentialDraws} + 1;
inline constexpr std::uint64_t kFirstDecomposeDraw = std::uint64_t{1} << 32;
inline constexpr std::uint64_t kFirstInterpretDraw = kFirstDecomposeDraw + (std::uint64_t{1} << 31);

/// The passes of Stage::Decompose or Stage::Interpret.
struct StageDepth {
    std::uint32_t passes = 0; // after which nothing matches, or that many are allowed
    bool checked = false;     // something may still match then, which is an error
};
[[nodiscard]] StageDepth depth_of(const Bytecode& bytecode, Stage stage);

} // namespace lsys
