// Different trees of a forest: how many of them look unlike all others.
#pragma once

#include "runtime/forest/forest.h"

#include <cstdint>
#include <span>

namespace lsys {

/// Counts trees with different segments, regardless of their instances: number, lengths and places
/// of the segments in the coordinates of the tree, compared by second moments to one part in a
/// million. Trees of one species that differ only in age count once if their segments are equal.
/// Takes about 100 bytes a tree and time linear in the branches. 0 threads: as many as the machine
/// has.
[[nodiscard]] std::uint64_t count_different_trees(const Forest& forest, std::uint32_t threads);

/// Counts the different trees among `trees`, which are trees of `forest`; on one thread.
[[nodiscard]] std::uint64_t count_different_trees(const Forest& forest,
                                                  std::span<const Tree> trees);

} // namespace lsys
