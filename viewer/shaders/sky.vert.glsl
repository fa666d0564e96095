// SPDX-License-Identifier: MIT
#include "frame.glsl"
out vec3 view_ray;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0); // at infinity
    vec4 world = frame.clip_to_world * vec4(corner, 1.0, 1.0);
    view_ray = world.xyz / world.w - frame.eye_time.xyz;
}
