// SPDX-License-Identifier: MIT
// Grass on level ground, earth on steep ground and in bare patches.
layout(binding = 2) uniform sampler2D noise; // tileable
layout(location = 20) uniform vec2 widest_shift;    // uv of the origin in the turned noise tile
layout(location = 21) uniform vec2 noise_shifts[3]; // uv of the origin in the other tiles
struct GroundLook {
    float bare; // 0: grass, 1: earth
    float middle;
    float fine;
    float small;
    float coarse;
};
// Noise of a tile of 611 m, turned by the angle of a 3-4-5 triangle: hides the repetition of the
// other tiles. Its texels are 4.8 m wide: vertices of the ground lie close enough to read it.
// `level`: mip level.
float widest_noise(vec2 place, float level) {
    vec2 at = mat2(0.8, 0.6, -0.6, 0.8) * place * (1.0 / 611.0) + widest_shift;
    return textureLod(noise, at, level).b;
}
// Look of a place `away` m from the eye. `steep`: 1 - cosine of slope; `widest`: widest_noise().
GroundLook ground_look(vec2 place, float away, float steep, float widest) {
    // Noise tiles of 173, 37 and 3.1 m; the two smaller ones fade before their repetition shows.
    vec4 large_noise = texture(noise, place * (1.0 / 173.0) + noise_shifts[0]);
    vec4 medium_noise = mix(vec4(0.5), texture(noise, place.yx * (1.0 / 37.0) + noise_shifts[1].yx),
                            clamp(2.0 - away / 150.0, 0.0, 1.0));
    vec4 small_noise = mix(vec4(0.5), texture(noise, place * (1.0 / 3.1) + noise_shifts[2]),
                           clamp(2.0 - away / 15.0, 0.0, 1.0));
    float wide = 0.5 + 0.8 * (large_noise.r - 0.5) + 0.8 * (widest - 0.5);
    GroundLook look;
    look.middle = 0.4 * large_noise.g + 0.4 * medium_noise.r + 0.2 * small_noise.r;
    look.fine = 0.5 * (medium_noise.g + small_noise.b);
    look.small = small_noise.g;
    look.coarse = medium_noise.b;
    float patches = 0.55 * wide + 0.35 * look.middle + 0.25 * look.fine - 0.1;
    look.bare = smoothstep(0.42, 0.72, patches + 2.0 * steep);
    return look;
}
vec3 grass_colour(float middle) {
    return mix(vec3(0.028, 0.056, 0.012), vec3(0.066, 0.086, 0.026), middle);
}
