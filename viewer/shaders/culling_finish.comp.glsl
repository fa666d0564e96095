// SPDX-License-Identifier: MIT
// Lists impostors of near trees that blend with their branches, or whose branches have no room.
// Runs in one workgroup. Sets the draws of impostors.
#include "culling.glsl"
layout(local_size_x = 256) in;
#include "culling_list.glsl"
#include "culling_near.glsl"
#include "culling_entries.glsl"

void main() {
    uint index = gl_LocalInvocationIndex;
    uint near_count = state.near_totals[1];
    uint whole = state.draws[1] + state.near_totals[0];
    uint blended = state.draws[5];
    uint far_blended = blended;
    uint waiting = 0u;
    for (uint first = 0u; first < near_count; first += kBlock) {
        uint number = first + index;
        bool exists = number < near_count;
        bool waits = exists && near_trees[number].count == 0u;
        bool is_drawn = exists && near_trees[number].is_drawn != 0u;
        uint code = exists ? near_trees[number].level_steps : 0u;
        uint level = code >> 8, steps = code & 0xFFu;
        bool is_blended = is_drawn && level + 1u == kLevels && steps != kBlendSteps;
        uvec4 total;
        uvec4 places = sum_before(uvec4(waits, is_blended, 0u, 0u), total);
        barrier();
        if (waits) {
            write_entry(whole + places.x, near_trees[number].tree, 0.0, 1.0);
        }
        if (is_blended) {
            write_entry(culling.key.z - 1u - blended - places.y, near_trees[number].tree,
                        float(steps) / float(kBlendSteps), 1.0);
        }
        if (is_drawn) {
            atomicAdd(state.level_counts[level], 1u);
            if (has_coarser(level, steps)) {
                atomicAdd(state.level_blended, 1u);
            }
        }
        whole += total.x;
        blended += total.y;
        waiting += total.x;
    }
    barrier();
    if (index == 0u) {
        set_draw(0u, whole, 0u);
        set_draw(1u, blended, culling.key.z - blended);
        state.waiting = waiting;
        state.branch_blended = blended - far_blended;
    }
}
