// SPDX-License-Identifier: MIT
#include "frame.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texture_coordinate;
layout(location = 3) in vec4 tangent;
out vec3 world_position;
out vec3 world_normal;
out vec2 uv;
out vec4 world_tangent;
void main() {
    world_position = position;
    world_normal = normal;
    uv = texture_coordinate;
    world_tangent = tangent;
    gl_Position = frame.view_projection * vec4(position, 1.0);
}
