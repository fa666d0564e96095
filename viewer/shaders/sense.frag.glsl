// SPDX-License-Identifier: MIT
#include "frame.glsl"
in vec4 sense_colour;
in vec3 place;
layout(location = 1) uniform int primitive; // SensePrimitive of scene/sense_drawing.h
out vec4 colour;
void main() {
    vec3 shaded = sense_colour.rgb;
    if (primitive == 0) {
        vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
        shaded *= 0.65 + 0.35 * abs(dot(normal, frame.to_sun.xyz));
    } else if (primitive == 2 && length(gl_PointCoord - 0.5) > 0.5) {
        discard;
    }
    colour = vec4(shaded * sense_colour.a, sense_colour.a);
}
