// SPDX-License-Identifier: MIT
#include "light.glsl"
layout(location = 0) uniform vec4 disc;
layout(location = 1) uniform float grid_step; // m, between the lines of the grid
in vec3 world_position;
out vec4 colour;

// Coverage of a pixel by lines `step` metres apart.
float lines(vec2 at, float step) {
    vec2 cell = at / step;
    vec2 width = fwidth(cell);
    vec2 away = abs(fract(cell - 0.5) - 0.5) / max(width, vec2(1e-6));
    float strength = clamp(1.0 - 4.0 * max(width.x, width.y), 0.0, 1.0);
    return strength * (1.0 - min(min(away.x, away.y), 1.0));
}

void main() {
    float far = length(world_position.xz - disc.xz) / disc.w;
    vec3 albedo = vec3(0.33, 0.33, 0.30);
    albedo *= 1.0 - 0.25 * lines(world_position.xz, grid_step) -
              0.35 * lines(world_position.xz, 10.0 * grid_step);
    vec3 up = vec3(0.0, 1.0, 0.0);
    vec3 radiance = fogged(
        shade(albedo, up, world_position, sunlight(world_position, up, 1.0), 0.0), world_position);
    vec3 view_ray = normalize(world_position - frame.eye_time.xyz);
    vec3 behind = sky_colour(normalize(vec3(view_ray.x, 0.0, view_ray.z)));
    colour = tone_mapped(mix(radiance, behind, smoothstep(0.25, 0.95, far)));
}
