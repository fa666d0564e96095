// SPDX-License-Identifier: MIT
// Near trees, as culling_near.comp.glsl lists them.
struct NearTree {
    uint tree;
    uint form;
    uint level_steps;   // weight of its branches in 1/kBlendSteps; bits from 8 on: level
    uint first_coarser; // its first branch among those drawn once more, in a coarser level
    uint first; // its first branch in the pool
    uint count; // count of its branches; 0: no room
    uint is_drawn;
    float yaw;
    vec4 position_scale;
};
layout(std430, binding = 12) buffer NearTrees { NearTree near_trees[]; };
