// SPDX-License-Identifier: MIT
#include "frame.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 vertex_colour;
out vec4 line_colour;
void main() {
    line_colour = vertex_colour;
    gl_Position = frame.view_projection * vec4(position, 1.0);
}
