// SPDX-License-Identifier: MIT
// Decides, as ForestLod::visit_tree(), whether a tree of a visible cell or an added tree is hidden,
// far, or a candidate for branches. With LIST, writes the lists of far trees and of candidates.
#include "culling.glsl"
layout(local_size_x = 256) in;
#include "culling_list.glsl"
layout(std430, binding = 11) writeonly buffer Candidates { uvec2 candidates[]; }; // tree; pixels
#include "culling_entries.glsl"

const uint kCandidate = 1u << 30;
const uint kFar = 2u << 30;

#ifndef LIST
#include "culling_tables.glsl"
#include "culling_horizon.glsl"
layout(std430, binding = 1) readonly buffer Trees { uvec2 trees[]; }; // three per tree
// Three per tree: yaw as float bits; Tree::number; count of branches, 0: unknown, bit 31: removed.
layout(std430, binding = 3) readonly buffer Identities { uint identities[]; };
layout(std430, binding = 8) readonly buffer VisibleCells { uvec4 visible_cells[]; };

// Last visible cell with at most `element` trees before it.
uint cell_of(uint element) {
    uint low = 0u;
    uint high = state.cell_totals[2];
    while (high - low > 1u) {
        uint middle = (low + high) / 2u;
        if (visible_cells[middle].y <= element) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// x: kCandidate or kFar, and the tree's index; y: pixels of a candidate, weight of a far tree.
uvec2 code_of(uint element) {
    uint tree = culling.trees.y + element - state.cell_totals[3];
    float weight = 1.0;
    if (element < state.cell_totals[3]) {
        uvec4 cell = visible_cells[cell_of(element)];
        tree = cell.x + element - cell.y;
        weight = uintBitsToFloat(cell.z);
    }
    if ((identities[3u * tree + 2u] & 0x80000000u) != 0u) {
        return uvec2(0u);
    }
    if (culling.trees.w != 0u) {
        return uvec2(kFar | tree, floatBitsToUint(1.0));
    }
    vec3 root = vec3(uintBitsToFloat(trees[3u * tree]), uintBitsToFloat(trees[3u * tree + 1u].x));
    float scale = uintBitsToFloat(trees[3u * tree + 1u].y);
    LodForm form = form_at(trees[3u * tree + 2u].y & 0xFFFFu);
    vec3 centre = root + vec3(0.0, scale * 0.5 * (form.low + form.high), 0.0);
    vec3 eye = culling.eye_pixels.xyz;
    float sway = sway_of(form, scale);
    float pixels = scale * form.height * culling.eye_pixels.w / max(distance(eye, centre), kNearest);
    if (pixels >= culling.level_pixels[kLevels - 1u]) {
        float yaw = uintBitsToFloat(identities[3u * tree]);
        float s = sin(yaw), c = cos(yaw);
        vec3 turned = vec3(c * form.centre.x + s * form.centre.z, form.centre.y,
                           c * form.centre.z - s * form.centre.x);
        bool seen = is_in_view(root + scale * turned, scale * form.radius + sway);
        return seen ? uvec2(kCandidate | tree, floatBitsToUint(pixels)) : uvec2(0u);
    }
    float radius = scale * form.impostor_radius;
    if (!is_in_view(centre, radius + sway)) {
        return uvec2(0u);
    }
    // The same as ForestLod::impostor_box().
    const float kLevel = 0.15;
    const float kMargin = 1.04; // kImpostorMargin
    bool is_level = abs(eye.y - centre.y) < kLevel * distance(eye, centre);
    float wide = kMargin * radius;
    vec3 extent = vec3(wide, is_level ? kMargin * 0.5 * scale * form.height : wide, wide) + sway;
    if (is_occluded(centre - extent, centre + extent)) {
        atomicAdd(state.occluded, 1u);
        return uvec2(0u);
    }
    return uvec2(kFar | tree, floatBitsToUint(weight));
}
#endif

void main() {
    uint element = block_number() * kBlock + gl_LocalInvocationIndex;
    bool exists = element < state.cell_totals[3] + culling.trees.z;
    uvec2 code = uvec2(0u);
#ifdef LIST
    code = exists ? codes[element] : code;
#else
    if (exists) {
        code = code_of(element);
        codes[element] = code;
    }
#endif
    bool is_candidate = (code.x & kFar) == 0u && (code.x & kCandidate) != 0u;
    bool is_far = (code.x & kFar) != 0u;
    bool is_blended = is_far && uintBitsToFloat(code.y) < 1.0;
    uvec4 counts = uvec4(is_candidate, is_far && !is_blended, is_blended, 0u);
#ifdef LIST
    uvec4 places = places_of(counts);
    uint tree = code.x & 0x3FFFFFFFu;
    if (is_blended) {
        write_entry(culling.key.z - 1u - places.z, tree, 0.0, uintBitsToFloat(code.y));
    } else if (is_far) {
        write_entry(places.y, tree, 0.0, 1.0);
    } else if (is_candidate && places.x < culling.limits.w) {
        candidates[places.x] = uvec2(tree, code.y);
    } else if (is_candidate) {
        write_entry(state.tree_totals[1] + places.x - culling.limits.w, tree, 0.0, 1.0);
    }
#else
    store_sum(counts);
#endif
}
