// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "dither.glsl"
in vec3 view_ray;
layout(location = 0) out vec4 colour;
#if QUALITY > 1
layout(location = 1) out vec4 motion; // temporal.frag.glsl
#endif
#if QUALITY > 0
// Height of wooded hills above their foot in a direction, m; crowns make the outline rough.
float hill_height(float azimuth) {
    float hills = 30.0 + 14.0 * sin(3.0 * azimuth + 0.7) + 9.0 * sin(7.0 * azimuth + 2.1) +
                  5.0 * sin(17.0 * azimuth + 4.0);
    float crown = azimuth * 120.0; // crowns of 12 m at 1500 m
    vec2 heights = fract(52.9829189 * fract(0.06711056 * (floor(crown) + vec2(0.0, 1.0))));
    return hills + 4.0 * mix(heights.x, heights.y, smoothstep(0.0, 1.0, fract(crown)));
}
// Covers the sky at the horizon with hills in the haze: beyond the drawn ground there is land too.
vec3 with_hills(vec3 sky, vec3 direction) {
    float slope = direction.y / max(length(direction.xz), 1e-3);
    float pixel = fwidth(slope);
    if (frame.hills.x == 0.0 || slope > 0.1) {
        return sky;
    }
    float top = (hill_height(atan(direction.z, direction.x)) + frame.hills.y - frame.eye_time.y) /
                frame.hills.x;
    vec3 up = vec3(0.0, 1.0, 0.0);
    vec3 woods = vec3(0.035, 0.052, 0.026) *
                 (0.8 * ambient(up) + frame.sun.rgb * (0.5 * max(frame.to_sun.y, 0.0)));
    vec2 fog = fog_to(frame.eye_time.xyz + frame.hills.x * direction);
    return mix(sky, apply_fog(woods, fog), clamp((top - slope) / max(pixel, 1e-5) + 0.5, 0.0, 1.0));
}
#endif
void main() {
    vec3 direction = normalize(view_ray);
    float disc = smoothstep(0.99993, 0.99997, dot(direction, frame.to_sun.xyz));
    vec3 radiance = sky_colour(direction) + frame.sun.rgb * (4.0 * disc);
#if QUALITY > 0
    radiance = with_hills(radiance * frame.near_maps.w, direction);
#endif
    colour = tone_mapped(radiance);
    colour.rgb += (dither_threshold() - 0.5) / 255.0; // a smooth sky would show bands of 8 bits
#if QUALITY > 1
    motion = vec4(0.0);
#endif
}
