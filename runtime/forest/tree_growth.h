// Trees of a growing forest between two of its years.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/forest/tree.h"

#include <functional>
#include <span>

namespace lsys {

/// Height of a tree of scale 1 with the species and age of `tree`, m; 0: unknown.
using TreeHeight = std::function<float(const Tree& tree)>;

/// The trees `part` of the way, 0 to 1, from one year to the next: at 0 exactly `before`, at 1
/// `after`. Between them a tree of both keeps its age and takes the size that it will have: its scale
/// changes steadily, and where the next age has another stage, to that at which both stages are
/// equally high, so that only its branches change at the year. New trees grow from nothing, dead
/// ones shrink to nothing in their place, both slowly at first and last. `before` and `after`: by
/// rising Tree::number; so is the result.
[[nodiscard]] LargeVector<Tree> trees_between(std::span<const Tree> before,
                                              std::span<const Tree> after,
                                              double part,
                                              const TreeHeight& height_of);

} // namespace lsys
