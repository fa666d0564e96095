// SPDX-License-Identifier: MIT
// Sharper bounds if modules have several outcomes: the min and max size of the whole word of each
// generation, computed backwards. The min size of a module after g generations is the min, over its
// outcomes, of the sum of the sizes of the outcome's modules after g - 1 generations. Modules of a
// context-free system are rewritten independently, so some seeds reach the bounds.
#pragma once

#include "compiler/growth/growth.h"
#include "compiler/growth/impl/module_classes.h"

#include <cstdint>
#include <vector>

namespace lsys::analysis {

struct SizeBounds {
    std::vector<GenerationSize> low; // by generation
    std::vector<GenerationSize> high;
};

/// Bounds of generations 0 ... generations; expands the classes that occur in them. Empty for
/// expansions that depend on the age, for cyclic rewriting, for predecessors of several modules,
/// and for programs that need too much work.
[[nodiscard]] SizeBounds bound_totals(ModuleClasses& classes, std::uint32_t generations);

} // namespace lsys::analysis
