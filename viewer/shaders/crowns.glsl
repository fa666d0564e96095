// SPDX-License-Identifier: MIT
// Ambient light on the ground, from a map of crowns and feet of trunks seen from above. Include after
// frame.glsl.
layout(binding = 9) uniform sampler2D crown_map;
// Fractions of the light that crowns (x) and feet of trunks (y) let through at a place.
vec2 openness_at(vec2 place) {
    vec2 at = (place - frame.crowns.xy) / frame.crowns.z;
    float edge = max(abs(at.x), abs(at.y));
    if (frame.crowns.w == 0.0 || edge >= 1.0) {
        return vec2(1.0);
    }
    return mix(textureLod(crown_map, at * 0.5 + 0.5, 0.0).rg, vec2(1.0),
               smoothstep(0.8, 1.0, edge));
}
// Fraction of the ambient light that arrives at a place with that openness.
float ambient_left(vec2 openness) {
    return mix(0.55, 1.0, openness.x) * mix(0.35, 1.0, openness.y);
}
