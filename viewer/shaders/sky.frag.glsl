// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "dither.glsl"
in vec3 view_ray;
out vec4 colour;
void main() {
    vec3 direction = normalize(view_ray);
    float disc = smoothstep(0.99993, 0.99997, dot(direction, frame.to_sun.xyz));
    colour = tone_mapped(sky_colour(direction) + frame.sun.rgb * (4.0 * disc));
    colour.rgb += (dither_threshold() - 0.5) / 255.0; // a smooth sky would show bands of 8 bits
}
