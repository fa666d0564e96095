// SPDX-License-Identifier: MIT
// Decides, as ForestLod::visit_cell(), whether a cell is hidden or drawn as a cluster, as trees, or
// as both. With LIST, writes the lists of clusters and of cells with visible trees.
#include "culling.glsl"
layout(local_size_x = 256) in;
#include "culling_list.glsl"
#include "culling_horizon.glsl"
// Three per cell: low corner, height of the tallest tree; high corner, count of trees and, in bit
// 31, whether trees were removed; mean position, first tree. Floats are stored as bits.
layout(std430, binding = 4) readonly buffer Cells { uvec4 cells[]; };
// Cells with visible trees: first tree, number of trees in the entries before, weight of the trees
// against the cluster (a float as bits), index of the cell.
layout(std430, binding = 8) writeonly buffer VisibleCells { uvec4 visible_cells[]; };
#include "culling_entries.glsl"

const uint kCluster = 1u;
const uint kTrees = 2u;
const uint kMinClusterTrees = 8u;
const uint kHasRemoved = 0x80000000u;

// ForestLod::cluster_size(), m.
float cluster_size(float tallest, vec3 middle) {
    vec3 eye = culling.eye_pixels.xyz;
    float away = max(distance(eye, middle), kNearest);
    float sine = clamp((eye.y - middle.y) / away, 0.0, 1.0);
    float shown = sine < 0.300676 ? 0.0 : sine < 0.819127 ? 0.573576 : 0.965926;
    float per_side = max(max(abs(sine - shown), 1.0 / 6.0), 2.5 * (sine - 0.25));
    return max(tallest, per_side * culling.clusters.y);
}

// x: flags kCluster and kTrees; y: weight of the trees against the cluster, a float as bits.
uvec2 code_of(uint index) {
    vec4 low = uintBitsToFloat(cells[3u * index]);
    uvec4 high_words = cells[3u * index + 1u];
    vec3 high = uintBitsToFloat(high_words.xyz);
    vec3 middle = uintBitsToFloat(cells[3u * index + 2u].xyz);
    uint count = high_words.w & ~kHasRemoved;
    uvec2 all = uvec2(kTrees, floatBitsToUint(1.0));
    if (count == 0u) {
        return uvec2(0u);
    }
    if (culling.trees.w != 0u) {
        bool overlaps = low.x <= culling.casters_high.x && high.x >= culling.casters_low.x &&
                        low.z <= culling.casters_high.z && high.z >= culling.casters_low.z;
        return overlaps ? all : uvec2(0u);
    }
    vec3 size = high - low.xyz;
    float sway = displacement(size.y, max(size.x, size.z));
    if (!is_in_view(0.5 * (low.xyz + high), 0.5 * distance(low.xyz, high) + sway)) {
        return uvec2(0u);
    }
    if (is_occluded(low.xyz - sway, high + sway)) {
        atomicAdd(state.occluded, count);
        return uvec2(0u);
    }
    float weight = 1.0;
    if (count >= kMinClusterTrees && count == high_words.w && culling.clusters.x > 0.0) {
        vec3 eye = culling.eye_pixels.xyz;
        float away = max(distance(eye, clamp(eye, low.xyz, high)), kNearest);
        float pixels = culling.eye_pixels.w / away * cluster_size(low.w, middle);
        weight = pixels < culling.clusters.x ? 0.0 : finer_weight(pixels, culling.clusters.x, culling.sway.w);
    }
    if (weight >= 1.0) {
        return all;
    }
    if (weight <= 0.0) {
        atomicAdd(state.clustered, count);
        return uvec2(kCluster, floatBitsToUint(weight));
    }
    atomicAdd(state.cluster_blended, count);
    return uvec2(kCluster | kTrees, floatBitsToUint(weight));
}

void main() {
    uint index = block_number() * kBlock + gl_LocalInvocationIndex;
    bool exists = index < culling.trees.x;
    uvec2 code = uvec2(0u);
#ifdef LIST
    code = exists ? codes[index] : code;
#else
    if (exists) {
        code = code_of(index);
        codes[index] = code;
    }
#endif
    bool is_blended = (code.x & kTrees) != 0u;
    bool is_cluster = (code.x & kCluster) != 0u;
    uint count = is_blended ? cells[3u * index + 1u].w & ~kHasRemoved : 0u;
    uvec4 counts = uvec4(is_cluster && !is_blended, is_cluster && is_blended, is_blended, count);
#ifdef LIST
    uvec4 places = places_of(counts);
    float weight = uintBitsToFloat(code.y);
    if (is_cluster) {
        // Blended clusters fill the list from its end.
        write_entry(is_blended ? culling.trees.x - 1u - places.y : places.x, index, weight, 1.0);
    }
    if (is_blended) {
        visible_cells[places.z] =
            uvec4(cells[3u * index + 2u].w, places.w, code.y, index);
    }
#else
    store_sum(counts);
#endif
}
