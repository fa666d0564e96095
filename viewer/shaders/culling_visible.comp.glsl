// SPDX-License-Identifier: MIT
// Finds the branches in view, like ForestLod::cull_branches(), and their keys, one for each level,
// form and instance. Hidden branches get the last key.
#include "culling.glsl"
layout(local_size_x = 256) in;
#include "culling_tables.glsl"
#include "culling_near.glsl"
layout(std430, binding = 13) readonly buffer Nodes { uvec4 nodes[]; };
struct Branch { // as in forest.glsl
    vec4 position_scale;
    uvec4 rotation_mesh_tree;
};
layout(std430, binding = 0) readonly buffer Branches { Branch branches[]; };
layout(std430, binding = 14) writeonly buffer Sorted { uvec2 sorted[]; }; // key; BranchEntry
layout(std430, binding = 16) buffer Keys { uint keys[]; };                // by key: count, first

void main() {
    uint slot = block_number() * kBlock + gl_LocalInvocationIndex;
    if (slot >= state.pool_used) {
        return;
    }
    uint number = nodes[slot].w;
    NearTree tree = near_trees[number];
    LodForm form = form_at(tree.form);
    float scale = tree.position_scale.w;
    float sway = sway_of(form, scale);
    float s = sin(tree.yaw), c = cos(tree.yaw);
    vec3 turned = vec3(c * form.centre.x + s * form.centre.z, form.centre.y,
                       c * form.centre.z - s * form.centre.x);
    vec3 whole = tree.position_scale.xyz + scale * turned;
    Branch branch = branches[slot];
    uint instance = branch.rotation_mesh_tree.z;
    uint at = instances_at(tree.form) + kInstanceWords * instance + 9u;
    float radius = table_float(at + 3u);
    vec4 rotation = normalize(vec4(unpackSnorm2x16(branch.rotation_mesh_tree.x),
                                   unpackSnorm2x16(branch.rotation_mesh_tree.y)));
    vec3 centre = branch.position_scale.xyz + rotate(rotation, scale * table_vec3(at));
    bool seen = radius >= 0.0 && (is_within_view(whole, scale * form.radius + sway) ||
                                  is_in_view(centre, scale * radius + sway));
    uint level = tree.level_steps >> 8, steps = tree.level_steps & 0xFFu;
    uint key = culling.key.w;
    if (seen) {
        uint group = steps == kBlendSteps ? level : kLevels + level;
        key = first_key_of(tree.form) + group * instances_of(tree.form) + instance;
        atomicAdd(keys[2u * key], 1u);
        near_trees[number].is_drawn = 1u;
    }
    sorted[slot] = uvec2(key, steps << 24 | slot);
    if (has_coarser(level, steps)) {
        uint coarser_key = seen ? key + instances_of(tree.form) : key;
        if (seen) {
            atomicAdd(keys[2u * coarser_key], 1u);
        }
        sorted[state.pool_used + tree.first_coarser + slot - tree.first] =
            uvec2(coarser_key, 1u << 31 | steps << 24 | slot);
    }
}
