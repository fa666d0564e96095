// SPDX-License-Identifier: MIT
// Trees of a growing forest between two consecutive years.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/forest/tree.h"

#include <functional>
#include <span>

namespace lsys {

/// Height of a tree of scale 1 with the species and age of `tree`, m; 0: unknown.
using TreeHeight = std::function<float(const Tree& tree)>;

/// The trees at fraction `part` between two years: exactly `before` at 0, exactly `after` at 1. In
/// between, a tree that exists in both years keeps its age, and its scale changes linearly to its
/// scale in the next year. If the tree has another stage in the next year, its scale changes to the
/// value at which both stages are equally high, so that the height does not jump at the turn of the
/// year. New trees grow from scale 0 and dead trees shrink to 0, both eased by a smoothstep.
/// `before`, `after` and the result are sorted by Tree::number.
[[nodiscard]] LargeVector<Tree> trees_between(std::span<const Tree> before,
                                              std::span<const Tree> after,
                                              double part,
                                              const TreeHeight& height_of);

} // namespace lsys
