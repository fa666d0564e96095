// SPDX-License-Identifier: MIT
#include "frame.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 vertex_colour;
layout(location = 0) uniform float diameter; // m, of points
out vec4 sense_colour;
out vec3 place;
void main() {
    sense_colour = vertex_colour;
    place = position;
    gl_Position = frame.view_projection * vec4(position, 1.0);
    // The second row of the matrix has the length 1 / tan(half of the field of view).
    mat4 rows = transpose(frame.view_projection);
    float pixels = 0.5 * frame.viewport.w * length(rows[1].xyz) / max(gl_Position.w, 1e-6);
    gl_PointSize = clamp(diameter * pixels, 2.0, 64.0);
}
