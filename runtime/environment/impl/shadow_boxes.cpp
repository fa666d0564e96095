// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/shadow_boxes.h"

namespace lsys {

namespace {

using Lanes = SummedAreaTable::Lanes;

std::int64_t signed_of(std::uint32_t difference) {
    return static_cast<std::int32_t>(difference);
}

/// Lanes 0, 1 and 2 have the counts at z - 1, z and z + 1. middle(): the count at z; sides(): the
/// sum of the other two; along_z(): the count at z + 1 minus that at z - 1.
std::int64_t middle(Lanes lanes) {
    return signed_of(lanes[1]);
}
std::int64_t sides(Lanes lanes) {
    return signed_of(lanes[0] + lanes[2]);
}
std::int64_t along_z(Lanes lanes) {
    return signed_of(lanes[2] - lanes[0]);
}

} // namespace

LayerCounts count_by_tables(const std::array<const SummedAreaTable*, 3>& tables,
                            std::int64_t x,
                            std::int64_t z,
                            std::int64_t layer) {
    // Indices 0, 1 and 2 are the neighbours at x - 1, x and x + 1.
    std::array<Lanes, 3> level; // counts at the same height
    std::array<Lanes, 3> sum;   // counts one voxel above plus counts one voxel below
    std::array<Lanes, 3> rise;  // counts one voxel above minus counts one voxel below
    for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t at = x + static_cast<std::int64_t>(i) - 1;
        const Lanes below = tables[0]->squares(at, z, layer);
        const Lanes above = tables[2]->squares(at, z, layer);
        level[i] = tables[1]->squares(at, z, layer);
        sum[i] = above + below;
        rise[i] = above - below;
    }
    const Lanes level_x = level[2] - level[0];
    const Lanes sum_x = sum[2] - sum[0];
    const Lanes rise_sides = rise[0] + rise[2];
    LayerCounts counts;
    counts.own = middle(level[1]);
    counts.differences[0] = {middle(level_x), sides(level_x) + middle(sum_x), sides(sum_x)};
    counts.differences[1] = {middle(rise[1]), sides(rise[1]) + middle(rise_sides),
                             sides(rise_sides)};
    counts.differences[2] = {along_z(level[1]), along_z(level[0] + level[2]) + along_z(sum[1]),
                             along_z(sum[0] + sum[2])};
    return counts;
}

} // namespace lsys
