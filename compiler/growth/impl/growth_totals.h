// Sharper bounds of whole words where modules have several outcomes: the least and the greatest
// size that a word of each generation can have, found backwards from the modules of the last
// generation (a module's least size after g generations is the least, over its outcomes, of the sum
// of what it yields after g - 1). Modules of a context-free system are rewritten independently, so
// these are reached.
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

/// Generations 0 ... generations. The classes are expanded as far as those generations reach. Empty
/// where this way is not open: expansions that depend on the age, cyclic rewriting, predecessors of
/// several modules, or too much work.
[[nodiscard]] SizeBounds bound_totals(ModuleClasses& classes, std::uint32_t generations);

} // namespace lsys::analysis
