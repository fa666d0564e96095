#include "light.glsl"
layout(location = 0) uniform vec4 disc;
layout(location = 1) uniform float unit; // m, between the lines of the grid
in vec3 place;
out vec4 colour;

// How much of a pixel lies on lines that are `step` metres apart.
float lines(vec2 at, float step) {
    vec2 cell = at / step;
    vec2 width = fwidth(cell);
    vec2 away = abs(fract(cell - 0.5) - 0.5) / max(width, vec2(1e-6));
    float strength = clamp(1.0 - 4.0 * max(width.x, width.y), 0.0, 1.0);
    return strength * (1.0 - min(min(away.x, away.y), 1.0));
}

void main() {
    float far = length(place.xz - disc.xz) / disc.w;
    vec3 albedo = vec3(0.33, 0.33, 0.30);
    albedo *= 1.0 - 0.25 * lines(place.xz, unit) - 0.35 * lines(place.xz, 10.0 * unit);
    vec3 up = vec3(0.0, 1.0, 0.0);
    vec3 radiance = seen(shade(albedo, up, place, sunlight(place, up, 1.0), 0.0), place);
    vec3 way = normalize(place - frame.eye_time.xyz);
    vec3 behind = sky_colour(normalize(vec3(way.x, 0.0, way.z)));
    colour = displayed(mix(radiance, behind, smoothstep(0.25, 0.95, far)));
}
