// SPDX-License-Identifier: MIT
// Writes a node for each instance in the near trees: index of the instance, node of its parent,
// exit of the parent, index of the near tree. One invocation per tree.
#include "culling.glsl"
layout(local_size_x = 64) in;
#include "culling_tables.glsl"
#include "culling_near.glsl"
layout(std430, binding = 3) readonly buffer Identities { uint identities[]; };
layout(std430, binding = 13) writeonly buffer Nodes { uvec4 nodes[]; };
uint first_node = 0u;
uint near_number = 0u;
void visit(uint node, uint instance, uint parent, uint exit_number) {
    nodes[first_node + node] = uvec4(instance, first_node + parent, exit_number, near_number);
}
#include "culling_walk.glsl"

void main() {
    near_number = block_number() * 64u + gl_LocalInvocationIndex;
    if (near_number >= state.near_totals[1] || near_trees[near_number].count == 0u) {
        return;
    }
    first_node = near_trees[near_number].first;
    walk(near_trees[near_number].form, identities[3u * near_trees[near_number].tree + 1u]);
}
