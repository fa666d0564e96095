// SPDX-License-Identifier: MIT
// Shared by the compute shaders that choose the trees and branches of a picture. The C++ side is
// gl/impl/forest_culling.cpp; the reference on the CPU is scene/forest_lod_select.cpp. Lists keep the
// order of their input, so the same forest and camera always give the same lists.
layout(std140, binding = 1) uniform Culling {
    vec4 planes[5];     // planes of the view, pointing inward
    vec4 eye_pixels;    // xyz: eye, m; w: height in pixels of an object as high as it is far away
    vec4 level_pixels;  // min height in pixels for each level of branches
    vec4 sway;          // xyz: Sway: m per m of height, m per m of width, m; w: LodOptions::blend
    vec4 clusters;      // x: LodOptions::cluster_pixels; y: side of a cell, m; z: level_blend
    vec4 casters_low;   // box of the casters of shadows, m
    vec4 casters_high;
    uvec4 trees;        // counts: x: cells; y: trees in cells; z: added trees; w: 1 to list casters
    uvec4 limits;       // max of: xy: triangles (64 bits); z: branches; w: trees that may be drawn as branches
    uvec4 key;          // xy: key of the forest; z: max impostors; w: number of keys of branches
    vec4 ground;        // x: 1 if the ground occludes, else 0; y: height of the eye above it, m
    uvec4 heights;      // x: number of levels of the ground; y: number of distances of the horizon
    ivec4 origins[14];  // xy: first texel of the heights of a level, in cells of the level
} culling;

const uint kBlock = 256u; // elements of a workgroup of a kernel that makes a list
const uint kLevels = 4u;
const uint kBlendSteps = 127u; // BranchEntry::kBlendSteps
const float kNearest = 0.1; // m: min distance

// Counts and draw sizes that the compute shaders write; the C++ side is CullingState.
layout(std430, binding = 5) buffer State {
    uint dispatches[24];   // sizes of indirect dispatches, three words each
    uint draws[16];        // 4 commands: impostors of trees, whole and blended; then of clusters
    uint cell_totals[4];   // clusters, blended clusters, cells with visible trees, their trees
    uint tree_totals[4];   // counts: candidates, whole far trees, blended far trees, 0
    uint near_totals[4];   // counts: candidate impostors, near trees, branches, coarser branches
    uint pool_used;        // number of branches in the pool
    uint waiting;          // near trees without room for their branches
    uint occluded;         // trees occluded by the ground
    uint clustered;        // trees drawn only in clusters
    uint cluster_blended;     // trees drawn both alone and in a cluster
    uint branch_blended;     // trees drawn both as branches and as an impostor
    uint drawn_branches;
    // A float as bits: factor of the heights of trees in pixels, which lowers the detail of trees; see
    // ForestFrameStats::detail.
    uint detail;
    uint level_counts[4];  // by level: number of near trees with branches in view
    uint triangles[2];     // triangles of branches, 64 bits
    uint coarser_used;     // branches drawn once more, in a coarser level
    uint level_blended;    // trees drawn in two levels of branches
    uint sums[192];        // triangles by step and factor of the search for `detail`: 64 bits each
} state;

// Index of this workgroup in a dispatch of two dimensions.
uint block_number() {
    return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
}
// Sets the size of an indirect dispatch of `count` elements, `size` per workgroup.
void set_dispatch(uint which, uint count, uint size) {
    const uint kWidest = 32768u;
    uint groups = (count + size - 1u) / size;
    state.dispatches[3u * which] = min(groups, kWidest);
    state.dispatches[3u * which + 1u] = (groups + kWidest - 1u) / kWidest;
    state.dispatches[3u * which + 2u] = 1u;
}
void set_draw(uint which, uint instances, uint first) {
    state.draws[4u * which] = 4u;
    state.draws[4u * which + 1u] = instances;
    state.draws[4u * which + 2u] = 0u;
    state.draws[4u * which + 3u] = first;
}

bool is_in_view(vec3 centre, float radius) {
    for (int i = 0; i < 5; ++i) {
        vec4 plane = culling.planes[i];
        if (plane.x * centre.x + plane.y * centre.y + plane.z * centre.z + plane.w < -radius) {
            return false;
        }
    }
    return true;
}
bool is_within_view(vec3 centre, float radius) {
    for (int i = 0; i < 5; ++i) {
        vec4 plane = culling.planes[i];
        if (plane.x * centre.x + plane.y * centre.y + plane.z * centre.z + plane.w < radius) {
            return false;
        }
    }
    return true;
}
// Max displacement by wind, m.
float displacement(float height, float width) {
    return culling.sway.x * height + culling.sway.y * width + culling.sway.z;
}
float finer_weight(float pixels, float limit, float blend) {
    return blend > 1.0 ? clamp((pixels / limit - 1.0) / (blend - 1.0), 0.0, 1.0) : 1.0;
}
// Counts the min heights above `pixels`. A loop over level_pixels with a variable index fails: a
// driver of NVIDIA (580.159) returned kLevels for every tree lower than the first min height.
uint level_of(float pixels) {
    return uint(dot(vec4(lessThan(vec4(pixels), culling.level_pixels)), vec4(1.0)));
}
// The same as ForestLod::blend_steps().
uint blend_steps(float pixels, uint level) {
    float limit = dot(culling.level_pixels, vec4(equal(uvec4(level), uvec4(0u, 1u, 2u, 3u))));
    float blend = level + 1u == kLevels ? culling.sway.w : culling.clusters.z;
    return uint(floor(finer_weight(pixels, limit, blend) * float(kBlendSteps) + 0.5));
}
// Whether a near tree of this level and weight is drawn in the next coarser level, too.
bool has_coarser(uint level, uint steps) {
    return level + 1u < kLevels && steps != kBlendSteps;
}
float factor_of_heights() {
    return uintBitsToFloat(state.detail);
}
vec3 rotate(vec4 q, vec3 v) {
    return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}
vec4 times(vec4 a, vec4 b) {
    return vec4(a.w * b.xyz + b.w * a.xyz + cross(a.xyz, b.xyz), a.w * b.w - dot(a.xyz, b.xyz));
}
