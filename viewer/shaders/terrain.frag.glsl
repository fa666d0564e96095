// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "crowns.glsl"
#ifdef PICTURE
layout(binding = 3) uniform sampler2D colours;
layout(binding = 4) uniform sampler2D normal_map; // normals as in glTF
layout(location = 16) uniform vec4 tiles;     // xy: a corner of a tile, m; zw: its sides, m
layout(location = 17) uniform vec3 mean;      // mean of the colours
layout(location = 18) uniform int has_normal_map;
#else
#include "ground_look.glsl"
#endif
#ifdef CANOPY
layout(location = 24) uniform vec3 canopy;       // colour of crowns
layout(location = 25) uniform vec2 canopy_range; // m, where the canopy begins and is complete
in float cover; // fraction hidden by crowns
#endif
in vec3 world_position;
in vec3 world_normal;
in vec3 shadow_position;
in vec3 fog; // xy: fog_to(); z: distance, m
#ifndef PICTURE
in float widest;
#endif
layout(location = 0) out vec4 colour;
#if QUALITY > 1
layout(location = 1) out vec4 motion; // temporal.frag.glsl
#endif
#ifdef PICTURE
#if QUALITY > 0
// Random value of a unit cell, 0 to 1. noise_at() interpolates between the values of four cells.
float random_at(vec2 cell) {
    return fract(52.9829189 * fract(dot(mod(cell, 289.0), vec2(0.06711056, 0.37583715))));
}
float noise_at(vec2 at) {
    vec2 cell = floor(at), part = smoothstep(0.0, 1.0, at - cell);
    return mix(mix(random_at(cell), random_at(cell + vec2(1.0, 0.0)), part.x),
               mix(random_at(cell + vec2(0.0, 1.0)), random_at(cell + vec2(1.0)), part.x), part.y);
}
#endif
void main() {
    vec3 up = normalize(world_normal);
    vec2 uv = (world_position.xz - tiles.xy) / tiles.zw;
    vec3 normal = up;
    // Far away, use the mean colour: repeated tiles would be visible as rows.
    float far = smoothstep(25.0, 100.0, fog.z * inversesqrt(tiles.z * tiles.w));
    vec3 near_albedo = texture(colours, uv).rgb;
#if QUALITY > 0
    // In patches the picture is turned by the angle of a 3-4-5 triangle, so that no rows of tiles
    // show; wider patches are lighter and darker.
    const mat2 kTurn = mat2(0.8, 0.6, -0.6, 0.8);
    vec2 turned_uv = kTurn * uv + vec2(0.37, 0.71);
    float turned = smoothstep(0.45, 0.55, noise_at(0.7 * uv));
    near_albedo = mix(near_albedo, texture(colours, turned_uv).rgb, turned);
    vec2 place = world_position.xz;
    float lightness = 0.8 + 0.25 * noise_at(place * (1.0 / 6.1)) +
                      0.15 * noise_at(kTurn * place * (1.0 / 23.0) + 7.3);
    vec3 albedo = lightness * mix(near_albedo, mean, far);
#else
    vec3 albedo = mix(near_albedo, mean, far);
#endif
    if (has_normal_map != 0) {
        vec3 bump = texture(normal_map, uv).xyz * 2.0 - 1.0;
#if QUALITY > 0
        vec3 turned_bump = texture(normal_map, turned_uv).xyz * 2.0 - 1.0;
        // y of the normals points against the rows of the picture.
        vec2 along_uv = vec2(turned_bump.x, -turned_bump.y) * kTurn;
        bump = mix(bump, vec3(along_uv.x, -along_uv.y, turned_bump.z), turned);
#endif
        vec3 along = normalize(vec3(up.y, -up.x, 0.0)); // x of the picture
        normal = normalize(along * bump.x + cross(up, along) * bump.y + up * bump.z);
        normal = normalize(mix(normal, up, far));
    }
#else
void main() {
    vec3 up = normalize(world_normal);
    float steep = 1.0 - up.y;
    GroundLook look = ground_look(world_position.xz, fog.z, steep, widest);
    vec3 earth = mix(vec3(0.060, 0.045, 0.030), vec3(0.110, 0.086, 0.058), look.small);
    vec3 albedo = mix(grass_colour(look.middle), earth, look.bare);
#if QUALITY > 0
    // Rock on steep ground, litter under crowns.
    vec3 rock = mix(vec3(0.085, 0.083, 0.078), vec3(0.190, 0.183, 0.170), look.middle);
    albedo = mix(albedo, rock, smoothstep(0.16, 0.30, steep + 0.2 * (look.coarse - 0.5)));
    vec4 detail = mix(vec4(0.5), texture(noise, world_position.xz * (1.0 / 0.7)),
                      clamp(2.0 - fog.z / 8.0, 0.0, 1.0));
    vec3 litter = mix(vec3(0.034, 0.026, 0.016), vec3(0.084, 0.064, 0.040),
                      clamp(0.5 * look.small + 1.6 * (detail.r - 0.5) + 0.25, 0.0, 1.0));
    float shade_of_crowns = 1.0 - openness_at(world_position.xz).x;
    albedo = mix(albedo, litter,
                 0.85 * smoothstep(0.2, 0.8, shade_of_crowns + 0.9 * (look.middle - 0.5) +
                                                 0.3 * (detail.g - 0.5)));
    albedo *= 0.75 + 0.5 * detail.b;
#endif
    albedo *= 0.7 + 0.6 * look.fine;
    vec3 normal = normalize(up + 0.4 * vec3(look.fine - 0.5, 0.0, look.small - 0.5));
#endif
    float lit = sunlight_near(world_position, up, sunlight_at(shadow_position, 1.0));
#if QUALITY > 0
    float left = ambient_left(openness_at(world_position.xz));
    vec3 light = albedo * (left * ambient(normal) +
                           frame.sun.rgb * (lit * max(dot(normal, frame.to_sun.xyz), 0.0)));
#else
    vec3 light = shade(albedo, normal, world_position, lit, 0.0);
#endif
#if QUALITY > 0
    // Pictures from below crowns are exposed for the shade; this darkens sunlit distance again.
    light *= mix(1.0, frame.near_maps.w, smoothstep(50.0, 150.0, fog.z));
#endif
#ifdef CANOPY
    // Crowns seen from afar: part of their surface is in the shade of others.
    vec3 crowns = shade_crown(canopy, up, 0.8 * lit, 0.0, 0.9);
    light = mix(light, crowns, cover * smoothstep(canopy_range.x, canopy_range.y, fog.z));
#endif
    colour = tone_mapped(apply_fog(light, fog.xy));
#if QUALITY > 1
    motion = vec4(0.0);
#endif
}
