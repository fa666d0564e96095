// SPDX-License-Identifier: MIT
// Uniform: the coordinates of place i are the draws 0 and 1 at position i. A place where no species
// can live gets no tree, so the numbers of trees do not depend on the terrain.
#include "runtime/placement/impl/draws.h"
#include "runtime/placement/impl/methods.h"

#include <algorithm>

namespace lsys {

namespace {

constexpr std::uint64_t kPiece = 1024; // trees

} // namespace

void place_uniform(const PlacementJob& job, Placement& placement) {
    const PlacementOptions& options = job.options;
    placement.trees.reserve(options.count);
    const std::uint64_t pieces = (options.count + kPiece - 1) / kPiece;
    const auto piece = [&](std::uint64_t number, TreeChunk& chunk) {
        const std::uint64_t end = std::min(options.count, (number + 1) * kPiece);
        for (std::uint64_t i = number * kPiece; i < end; ++i) {
            const PhiloxBlock words = placement_draws(options.key, i, kPlaceBlock);
            job.maker.make(static_cast<std::uint32_t>(i),
                           coordinate_within(options.region.x, options.region.width, words[0]),
                           coordinate_within(options.region.z, options.region.depth, words[1]),
                           chunk);
        }
    };
    collect_trees(job.workers, pieces, piece, placement);
}

} // namespace lsys
