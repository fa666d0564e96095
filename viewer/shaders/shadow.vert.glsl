// SPDX-License-Identifier: MIT
#include "frame.glsl"
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 texture_coordinate;
out vec2 uv;
void main() {
    uv = texture_coordinate;
    gl_Position = frame.shadow_from_world * vec4(position, 1.0);
}
