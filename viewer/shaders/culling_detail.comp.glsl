// SPDX-License-Identifier: MIT
// Finds the largest factor of heights in pixels that keeps the triangles of branches within their
// max: ForestLod::detail_in_budget(). Each of six steps sums triangles for 15 factors, which gives
// four bits of the factor in 1/2^24. A seventh step stores it. The first step also tries factor 1.
#include "culling.glsl"
layout(local_size_x = 256) in;
layout(location = 0) uniform uint step_number;
#include "culling_tables.glsl"
layout(std430, binding = 1) readonly buffer Trees { uvec2 trees[]; };
layout(std430, binding = 11) readonly buffer Candidates { uvec2 candidates[]; };
const uint kSteps = 6u;
const uint kParts = 16u;
const float kUnit = 1.0 / 16777216.0;
shared uint low_words[kParts];
shared uint high_words[kParts];

bool fits(uint step, uint part) {
    uint at = 2u * (kParts * step + part);
    uvec2 sum = uvec2(state.sums[at], state.sums[at + 1u]);
    uvec2 most = culling.limits.xy;
    return sum.y < most.y || (sum.y == most.y && sum.x <= most.x);
}
// The factor that the steps before `step` have found, in units of kUnit.
uint factor_before(uint step) {
    uint factor = 0u;
    for (uint i = 0u; i < step; ++i) {
        uint fitting = 0u;
        uint excessive = kParts;
        while (excessive - fitting > 1u) {
            uint middle = (fitting + excessive) / 2u;
            if (fits(i, middle)) {
                fitting = middle;
            } else {
                excessive = middle;
            }
        }
        factor += fitting << (20u - 4u * i);
    }
    return factor;
}

void main() {
    uint index = gl_LocalInvocationIndex;
    bool is_whole = step_number != 0u && fits(0u, 0u);
    if (step_number == kSteps) {
        if (index == 0u) {
            float factor = is_whole ? 1.0 : float(factor_before(kSteps)) * kUnit;
            state.detail = floatBitsToUint(factor);
        }
        return;
    }
    if (is_whole) {
        return;
    }
    if (index < kParts) {
        low_words[index] = 0u;
        high_words[index] = 0u;
    }
    memoryBarrierShared();
    barrier();
    uint number = block_number() * kBlock + index;
    if (number < min(state.tree_totals[0], culling.limits.w)) {
        uvec2 candidate = candidates[number];
        uint form = trees[3u * candidate.x + 2u].y & 0xFFFFu;
        uint factor = factor_before(step_number);
        for (uint part = step_number == 0u ? 0u : 1u; part < kParts; ++part) {
            // Part 0 of the first step is factor 1.
            uint units = part == 0u ? 16777216u : factor + (part << (20u - 4u * step_number));
            float pixels = uintBitsToFloat(candidate.y) * (float(units) * kUnit);
            uint level = level_of(pixels);
            uint triangles = triangles_of(form, level);
            if (has_coarser(level, blend_steps(pixels, level))) {
                triangles += triangles_of(form, level + 1u);
            }
            uint before = atomicAdd(low_words[part], triangles);
            if (before + triangles < before) {
                atomicAdd(high_words[part], 1u);
            }
        }
    }
    memoryBarrierShared();
    barrier();
    if (index < kParts) {
        uint at = 2u * (kParts * step_number + index);
        uint before = atomicAdd(state.sums[at], low_words[index]);
        uint carry = before + low_words[index] < before ? 1u : 0u;
        atomicAdd(state.sums[at + 1u], high_words[index] + carry);
    }
}
