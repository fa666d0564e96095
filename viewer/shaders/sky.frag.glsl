#include "light.glsl"
in vec3 way;
out vec4 colour;
void main() {
    vec3 direction = normalize(way);
    float disc = smoothstep(0.99993, 0.99997, dot(direction, frame.to_sun.xyz));
    colour = displayed(sky_colour(direction) + frame.sun.rgb * (4.0 * disc));
}
