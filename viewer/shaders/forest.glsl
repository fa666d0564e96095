// SPDX-License-Identifier: MIT
#include "frame.glsl"
// Trees, branches and forms. The C++ side: TreeRecord and FormRecord in gl/impl/forest_buffers.cpp,
// PoolBranch in scene/branch_pool.h.
struct Branch {
    vec4 position_scale; // m, origin of the hero; scale
    uvec4 rotation_mesh_tree; // snorm16 xy, snorm16 zw, mesh, tree
};
struct Form {
    vec4 cylinder; // m at scale 1: radius, low, high; half side of the box of vertices
    vec4 layers; // x: first layer of its impostors; y: 1 for clusters
};
layout(std430, binding = 0) readonly buffer Branches { Branch branches[]; };
layout(std430, binding = 1) readonly buffer Trees { uvec2 trees[]; }; // three per tree
layout(std430, binding = 2) readonly buffer Forms { Form forms[]; };

struct UnpackedTree {
    vec3 root;
    float scale;
    float yaw;
    uint form;
    uint impostor;
    float phase; // 0 to 1
};

UnpackedTree unpack_tree(uint index) {
    uvec2 first = trees[3u * index], second = trees[3u * index + 1u], third = trees[3u * index + 2u];
    UnpackedTree tree;
    tree.root = vec3(uintBitsToFloat(first), uintBitsToFloat(second.x));
    tree.scale = uintBitsToFloat(second.y);
    tree.yaw = float(third.x & 0xFFFFu) * (6.2831853 / 65536.0);
    tree.phase = float(third.x >> 16) / 65536.0;
    tree.form = third.y & 0xFFFFu;
    tree.impostor = third.y >> 16;
    return tree;
}

vec3 rotate(vec4 q, vec3 v) {
    return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
}
vec3 rotate_y(float angle, vec3 v) {
    float s = sin(angle), c = cos(angle);
    return vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
}
vec3 octahedral(vec2 e) {
    vec3 v = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (v.z < 0.0) {
        v.xy = (1.0 - abs(v.yx)) * vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
    }
    return normalize(v);
}

// Half axes of the crown, m.
vec3 crown_axes(UnpackedTree tree) {
    vec4 cylinder = forms[tree.form].cylinder;
    return tree.scale * vec3(cylinder.x, 0.55 * (cylinder.z - cylinder.y), cylinder.x);
}
vec3 crown_centre(UnpackedTree tree) {
    vec4 cylinder = forms[tree.form].cylinder;
    return tree.root + vec3(0.0, tree.scale * 0.5 * (cylinder.y + cylinder.z), 0.0);
}

// Position of a point of a tree in the wind: a function of the point at rest and the tree alone, so
// that joints stay closed. `flutter`: 1 for leaves. sway_in() in scene/forest_lod_select.cpp bounds it.
vec3 swayed_in(vec3 world_position, UnpackedTree tree, float flutter, vec4 wind, float time) {
#ifdef WIND
    float speed = max(length(wind.xyz), 1e-6);
    vec3 downwind = wind.xyz / speed;
    float height = tree.scale * (forms[tree.form].cylinder.z - forms[tree.form].cylinder.y);
    vec3 from = world_position - tree.root;
    float rise = clamp(from.y / height, 0.0, 1.2);
    // Gusts travel downwind.
    float along = dot(tree.root, downwind);
    float gust = 1.0 + wind.w * sin(0.9 * time - 0.05 * along + 6.2831853 * tree.phase) *
                           sin(0.37 * time - 0.021 * along);
    float push = 0.004 * speed * gust;
    float swing = 1.0 + 0.35 * sin(1.7 * time + 6.2831853 * tree.phase);
    float away = length(from.xz) / height;
    vec3 trunk = downwind * (push * swing * rise * rise);
    float phase = 2.1 * from.x / height + 3.3 * from.z / height + 6.2831853 * tree.phase;
    vec3 boughs = vec3(sin(2.9 * time + 4.0 * phase), 0.6 * sin(3.7 * time + 5.0 * phase),
                       cos(3.1 * time + 4.5 * phase)) * (0.35 * push * gust * away);
    vec3 moved = world_position + height * (trunk + boughs);
    if (flutter > 0.0) {
        vec3 cell = 9.0 * world_position;
        moved += flutter * min(0.004 * speed * gust, 0.05) *
                 sin(vec3(7.0, 9.0, 8.0) * time + cell.yzx + cell.zxy);
    }
    return moved;
#else
    return world_position;
#endif
}
vec3 swayed(vec3 world_position, UnpackedTree tree, float flutter) {
    return swayed_in(world_position, tree, flutter, frame.wind, frame.eye_time.w);
}
vec3 swayed_before(vec3 world_position, UnpackedTree tree, float flutter) {
    return swayed_in(world_position, tree, flutter, frame.wind_before, frame.time_before.x);
}
