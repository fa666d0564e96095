// SPDX-License-Identifier: MIT
// The number of distinct shapes among the trees of a forest.
#pragma once

#include "runtime/forest/forest.h"

#include <cstdint>
#include <span>

namespace lsys {

/// Counts the distinct shapes of trees, in the coordinates of each tree: place, yaw, scale, age and
/// the division of a tree into instances are not compared. Two trees of one species have the same
/// shape if they draw the same number of items and the moments of these items up to the second
/// order agree to one part in a million. Takes about 100 bytes per tree and time linear in the
/// branches. 0 threads: as many as the machine has.
[[nodiscard]] std::uint64_t count_different_trees(const Forest& forest, std::uint32_t threads);

/// Counts the distinct shapes among `trees`, which are trees of `forest`, on one thread.
[[nodiscard]] std::uint64_t count_different_trees(const Forest& forest,
                                                  std::span<const Tree> trees);

} // namespace lsys
