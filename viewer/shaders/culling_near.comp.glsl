// SPDX-License-Identifier: MIT
// Decides, as ForestLod::list_branches(), whether a candidate is an impostor or a near tree, and of
// which level. With LIST, writes the list of near trees and their places in the pool of branches.
#include "culling.glsl"
layout(local_size_x = 256) in;
#include "culling_list.glsl"
layout(std430, binding = 11) readonly buffer Candidates { uvec2 candidates[]; };
layout(std430, binding = 1) readonly buffer Trees { uvec2 trees[]; };
layout(std430, binding = 3) buffer Identities { uint identities[]; };
#ifdef LIST
#include "culling_entries.glsl"
#include "culling_near.glsl"
#else
#include "culling_tables.glsl"
void visit(uint node, uint instance, uint parent, uint exit_number) {}
#include "culling_walk.glsl"

uint branches_of(uint tree, uint form) {
    uint known = identities[3u * tree + 2u];
    if (known == 0u) {
        known = walk(form, identities[3u * tree + 1u]);
        identities[3u * tree + 2u] = known;
    }
    return known;
}
#endif

void main() {
    uint element = block_number() * kBlock + gl_LocalInvocationIndex;
    bool exists = element < min(state.tree_totals[0], culling.limits.w);
    uvec2 candidate = exists ? candidates[element] : uvec2(0u);
    uvec2 code = uvec2(0u);
#ifdef LIST
    code = exists ? codes[element] : code;
#else
    if (exists) {
        float pixels = uintBitsToFloat(candidate.y) * factor_of_heights();
        uint level = level_of(pixels);
        if (level < kLevels) {
            uint steps = blend_steps(pixels, level);
            uint form = trees[3u * candidate.x + 2u].y & 0xFFFFu;
            code = uvec2(level << 8 | steps, branches_of(candidate.x, form));
        }
        codes[element] = code;
    }
#endif
    bool is_near = code.y != 0u;
    uint coarser = has_coarser(code.x >> 8, code.x & 0xFFu) ? code.y : 0u;
    uvec4 counts = uvec4(exists && !is_near, is_near, code.y, coarser);
#ifdef LIST
    uvec4 places = places_of(counts);
    if (is_near) {
        bool has_room = places.z + code.y <= culling.limits.z;
        uvec2 first = trees[3u * candidate.x], second = trees[3u * candidate.x + 1u];
        near_trees[places.y] = NearTree(
            candidate.x, trees[3u * candidate.x + 2u].y & 0xFFFFu, code.x, places.w,
            places.z, has_room ? code.y : 0u, 0u, uintBitsToFloat(identities[3u * candidate.x]),
            vec4(uintBitsToFloat(first), uintBitsToFloat(second)));
        if (has_room) {
            atomicMax(state.pool_used, places.z + code.y);
            atomicMax(state.coarser_used, places.w + coarser);
        }
    } else if (exists) {
        write_entry(state.draws[1] + places.x, candidate.x, 0.0, 1.0);
    }
#else
    store_sum(counts);
#endif
}
