// SPDX-License-Identifier: MIT
// Makes the branches of the near trees, in the layout of PoolBranch, like pose_of() and
// pool_branch(). An invocation multiplies the transforms from a branch to the root of its tree.
#include "culling.glsl"
layout(local_size_x = 256) in;
#include "culling_tables.glsl"
#include "culling_near.glsl"
layout(std430, binding = 13) readonly buffer Nodes { uvec4 nodes[]; };
struct Branch { // as in forest.glsl
    vec4 position_scale;
    uvec4 rotation_mesh_tree;
};
layout(std430, binding = 0) writeonly buffer Branches { Branch branches[]; };

void main() {
    uint slot = block_number() * kBlock + gl_LocalInvocationIndex;
    if (slot >= state.pool_used) {
        return;
    }
    uvec4 node = nodes[slot];
    NearTree tree = near_trees[node.w];
    uint exits = exits_at(tree.form);
    vec4 turn = vec4(0.0, 0.0, 0.0, 1.0);
    vec3 place = vec3(0.0);
    uint instance = node.x;
    while (node.z != 0xFFFFFFFFu) {
        uint at = exits + 8u * node.z;
        vec4 exit_turn = table_vec4(at);
        turn = times(exit_turn, turn);
        place = table_vec3(at + 4u) + rotate(exit_turn, place);
        node = nodes[node.y];
    }
    float scale = tree.position_scale.w;
    vec4 root = vec4(0.0, sin(0.5 * tree.yaw), 0.0, cos(0.5 * tree.yaw));
    uint at = instances_at(tree.form) + kInstanceWords * instance;
    vec4 rotation = normalize(times(times(root, turn), table_vec4(at)));
    vec3 entry = rotate(root, place) - rotate(rotation, table_vec3(at + 4u));
    branches[slot].position_scale = vec4(tree.position_scale.xyz + scale * entry, scale);
    branches[slot].rotation_mesh_tree =
        uvec4(packSnorm2x16(rotation.xy), packSnorm2x16(rotation.zw), instance, tree.tree);
}
