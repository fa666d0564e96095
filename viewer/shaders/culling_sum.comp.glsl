// SPDX-License-Identifier: MIT
// Replaces the sum of each workgroup of a kernel by the sum over all workgroups before it. Runs in
// one workgroup. Sets the sizes of the next dispatches and draws.
#include "culling.glsl"
layout(local_size_x = 1024) in;
layout(location = 0) uniform uint stage; // 0: cells, 1: trees, 2: candidates
layout(std430, binding = 7) buffer Sums { uvec4 sums[]; };
shared uvec4 partial[1024];

uint element_count() {
    if (stage == 0u) {
        return culling.trees.x;
    }
    return stage == 1u ? state.cell_totals[3] + culling.trees.z
                       : min(state.tree_totals[0], culling.limits.w);
}

void main() {
    uint index = gl_LocalInvocationIndex;
    uint count = (element_count() + kBlock - 1u) / kBlock;
    uint part = (count + 1023u) / 1024u;
    uint begin = min(index * part, count);
    uint end = min(begin + part, count);
    uvec4 sum = uvec4(0u);
    for (uint i = begin; i < end; ++i) {
        sum += sums[i];
    }
    partial[index] = sum;
    memoryBarrierShared();
    barrier();
    for (uint step = 1u; step < 1024u; step *= 2u) {
        uvec4 other = index >= step ? partial[index - step] : uvec4(0u);
        memoryBarrierShared();
        barrier();
        partial[index] += other;
        memoryBarrierShared();
        barrier();
    }
    uvec4 before = partial[index] - sum;
    for (uint i = begin; i < end; ++i) {
        uvec4 here = sums[i];
        sums[i] = before;
        before += here;
    }
    if (index != 0u) {
        return;
    }
    uvec4 total = partial[1023];
    for (int i = 0; i < 4; ++i) {
        if (stage == 0u) {
            state.cell_totals[i] = total[i];
        } else if (stage == 1u) {
            state.tree_totals[i] = total[i];
        } else {
            state.near_totals[i] = total[i];
        }
    }
    if (stage == 0u) {
        set_draw(2u, total.x, 0u);
        set_draw(3u, total.y, culling.trees.x - total.y);
        set_dispatch(0u, total.w + culling.trees.z, kBlock);
    } else if (stage == 1u) {
        uint candidates = min(total.x, culling.limits.w);
        set_draw(0u, total.y + (total.x - candidates), 0u);
        set_draw(1u, total.z, culling.key.z - total.z);
        set_dispatch(1u, candidates, kBlock);
    } else {
        uint branches = min(total.z, culling.limits.z);
        set_dispatch(2u, total.y, 64u);
        set_dispatch(3u, branches, kBlock);
        set_dispatch(4u, branches + min(total.w, culling.limits.z), 2048u);
    }
}
