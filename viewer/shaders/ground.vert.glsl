// SPDX-License-Identifier: MIT
#include "frame.glsl"
layout(location = 0) uniform vec4 disc; // centre, m; radius
out vec3 world_position;
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    world_position = disc.xyz + vec3(corner.x, 0.0, corner.y) * disc.w;
    gl_Position = frame.view_projection * vec4(world_position, 1.0);
}
