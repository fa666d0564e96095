// SPDX-License-Identifier: MIT
#include "forest.glsl"
// Crown and foot of a tree in the map of openness_at().
layout(location = 0) uniform vec3 area; // middle and half side of the map, m
layout(location = 0) in uint index;     // index of the tree
out vec2 from_trunk;                    // m
flat out vec2 radii;                    // m, of crown and foot
void main() {
    UnpackedTree tree = unpack_tree(index);
    vec4 cylinder = forms[tree.form].cylinder;
    const float kMinFoot = 0.35; // the map has no smaller detail
    radii = vec2(1.1 * tree.scale * cylinder.x,
                 max(0.03 * tree.scale * (cylinder.z - cylinder.y), kMinFoot));
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    from_trunk = corner * max(radii.x, 3.0 * radii.y);
    gl_Position = vec4((tree.root.xz + from_trunk - area.xy) / area.z, 0.0, 1.0);
}
