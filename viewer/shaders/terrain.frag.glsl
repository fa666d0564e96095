// SPDX-License-Identifier: MIT
#include "light.glsl"
#ifdef PICTURE
layout(binding = 3) uniform sampler2D colours;
layout(binding = 4) uniform sampler2D normal_map; // normals as in glTF
layout(location = 16) uniform vec4 tiles;     // a corner of a tile; its sides; m
layout(location = 17) uniform vec3 mean;      // mean of the colours
layout(location = 18) uniform int has_normal_map;
#else
layout(binding = 2) uniform sampler2D noise; // tileable
layout(location = 20) uniform vec2 widest_shift;    // place of the origin in the turned noise tile
layout(location = 21) uniform vec2 noise_shifts[3]; // place of the origin in the other tiles
#endif
layout(location = 24) uniform vec3 canopy;       // colour of crowns
layout(location = 25) uniform vec2 canopy_range; // m, where the canopy begins and is complete; y 0: none
in vec3 world_position;
in vec3 world_normal;
in vec3 shadow_position;
in vec3 fog; // xy: fog_to(); z: distance, m
in float cover;
out vec4 colour;
#ifdef PICTURE
void main() {
    vec3 up = normalize(world_normal);
    vec2 uv = (world_position.xz - tiles.xy) / tiles.zw;
    vec3 normal = up;
    // Far away, use the mean colour: repeated tiles would be visible as rows.
    float far = smoothstep(25.0, 100.0, fog.z * inversesqrt(tiles.z * tiles.w));
    vec3 albedo = mix(texture(colours, uv).rgb, mean, far);
    if (has_normal_map != 0) {
        vec3 bump = texture(normal_map, uv).xyz * 2.0 - 1.0;
        vec3 along = normalize(vec3(up.y, -up.x, 0.0)); // x of the picture
        normal = normalize(along * bump.x + cross(up, along) * bump.y + up * bump.z);
        normal = normalize(mix(normal, up, far));
    }
#else
// Grass on level ground, earth on steep ground and in bare patches.
void main() {
    vec3 up = normalize(world_normal);
    // Noise tiles of 173, 37 and 3.1 m; the two smaller ones fade before their repetition shows. A
    // tile of 611 m, turned by the angle of a 3-4-5 triangle, hides the repetition of the largest.
    float away = fog.z;
    vec4 widest_noise =
        texture(noise, mat2(0.8, 0.6, -0.6, 0.8) * world_position.xz * (1.0 / 611.0) + widest_shift);
    vec4 large_noise = texture(noise, world_position.xz * (1.0 / 173.0) + noise_shifts[0]);
    vec4 medium_noise = mix(vec4(0.5), texture(noise, world_position.zx * (1.0 / 37.0) + noise_shifts[1].yx),
                       clamp(2.0 - away / 150.0, 0.0, 1.0));
    vec4 small_noise = mix(vec4(0.5), texture(noise, world_position.xz * (1.0 / 3.1) + noise_shifts[2]),
                     clamp(2.0 - away / 15.0, 0.0, 1.0));
    float wide = 0.5 + 0.8 * (large_noise.r - 0.5) + 0.8 * (widest_noise.b - 0.5);
    float middle = 0.4 * large_noise.g + 0.4 * medium_noise.r + 0.2 * small_noise.r;
    float fine = 0.5 * (medium_noise.g + small_noise.b);
    float steep = 1.0 - up.y;
    float patches = 0.55 * wide + 0.35 * middle + 0.25 * fine - 0.1;
    float bare = smoothstep(0.42, 0.72, patches + 2.0 * steep);
    vec3 grass = mix(vec3(0.028, 0.056, 0.012), vec3(0.066, 0.086, 0.026), middle);
    vec3 earth = mix(vec3(0.060, 0.045, 0.030), vec3(0.110, 0.086, 0.058), small_noise.g);
    vec3 albedo = mix(grass, earth, bare) * (0.7 + 0.6 * fine);
    vec3 normal = normalize(up + 0.4 * vec3(fine - 0.5, 0.0, small_noise.g - 0.5));
#endif
    float lit = sunlight_near(world_position, up, sunlight_at(shadow_position, 1.0));
    vec3 light = shade(albedo, normal, world_position, lit, 0.0);
    if (canopy_range.y > 0.0) {
        // Crowns seen from afar: part of their surface is in the shade of others.
        vec3 crowns = shade_crown(canopy, up, 0.8 * lit, 0.0, 0.9);
        light = mix(light, crowns, cover * smoothstep(canopy_range.x, canopy_range.y, fog.z));
    }
    colour = tone_mapped(apply_fog(light, fog.xy));
}
