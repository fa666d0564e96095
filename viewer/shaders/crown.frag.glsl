// SPDX-License-Identifier: MIT
in vec2 from_trunk;
flat in vec2 radii;
out vec4 openness; // multiplied into the map of openness_at(); x: crown, y: foot of the trunk
void main() {
    float away = length(from_trunk);
    float foot = away / radii.y;
    openness = vec4(1.0 - 0.5 * (1.0 - smoothstep(0.3, 1.0, away / radii.x)),
                    1.0 - 0.8 * exp(-foot * foot), 1.0, 1.0);
}
