// SPDX-License-Identifier: MIT
#include "light.glsl"
#if !defined(PICTURE) && !defined(GROUND)
#define NOISE
#include "ground_look.glsl"
out float widest; // widest_noise()
#endif
// CDLOD (Strugar 2010): vertices morph to the next level and reach it at the distance where it
// begins.
layout(binding = 1) uniform sampler2DArray heights; // a layer per level, vertices at texels
layout(binding = 5) uniform sampler2DArray covers;  // fraction hidden by crowns
layout(location = 0) uniform ivec2 origins[14];     // by layer, in cells of its level
// Finest cell, m; range of level 0, m; fraction of the range where morphing starts; eye above ground, m.
layout(location = 14) uniform vec4 ranges;
layout(location = 15) uniform int levels;
layout(location = 0) in uvec2 corner;
layout(location = 1) in ivec3 patch_at; // x, z in cells of its level; the level
out vec3 world_position;
out vec3 world_normal;
out vec3 shadow_position;
out vec3 fog; // xy: fog_to(); z: distance, m
out float cover;

float height_at(ivec2 at, int level) {
    return texelFetch(heights, ivec3(at - origins[level], level), 0).r;
}

vec3 normal_at(ivec2 at, int level) {
    float cell = ranges.x * float(1 << level);
    return normalize(vec3(height_at(at - ivec2(1, 0), level) - height_at(at + ivec2(1, 0), level),
                          2.0 * cell,
                          height_at(at - ivec2(0, 1), level) - height_at(at + ivec2(0, 1), level)));
}

void main() {
    int level = patch_at.z;
    ivec2 at = patch_at.xy + ivec2(corner);
    ivec2 even = at - (at & 1);
    float cell = ranges.x * float(1 << level);
    float range = ranges.y * float(1 << level);
    vec2 ground = vec2(at) * cell;
    float away = length(vec3(ground - frame.eye_time.xz, ranges.w));
    float morph = clamp((away - ranges.z * range) / (range - ranges.z * range), 0.0, 1.0);
    vec3 normal = normal_at(at, level);
    if (level + 1 == levels) {
        morph = 0.0;
    } else {
        normal = mix(normal, normal_at(even / 2, level + 1), morph);
    }
    ground = mix(ground, vec2(even) * cell, morph);
    float here = height_at(at, level);
    world_position = vec3(ground.x, here + morph * (height_at(even, level) - here), ground.y);
    world_normal = normal;
    cover = texelFetch(covers, ivec3(at - origins[level], level), 0).r;
    shadow_position = shadow_map_position(world_position, normal);
#ifdef NOISE
    const float kNoiseTexel = 611.0 / 128.0; // m
    widest = widest_noise(ground, max(log2(cell / kNoiseTexel) + morph, 0.0));
#endif
    fog = vec3(fog_to(world_position), distance(world_position, frame.eye_time.xyz));
    // The drawn ground ends at a stepped border of whole patches, so it fades into the horizon
    // before the border.
    fog.y *= 1.0 - smoothstep(0.7, 0.95, away / (ranges.y * float(1 << (levels - 1))));
    gl_Position = frame.view_projection * vec4(world_position, 1.0);
}
