// SPDX-License-Identifier: MIT
// Uniforms shared by all shaders; the C++ side is FrameBlock in gl/impl/frame_block.h.
layout(std140, binding = 0) uniform FrameBlock {
    mat4 view_projection;
    mat4 clip_to_world; // for view rays
    mat4 shadow_from_world;
    vec4 eye_time;  // xyz: eye, m; w: time of the wind, s
    vec4 to_sun;    // xyz: unit direction; w: 1 with shadows, else 0
    vec4 sun;       // rgb: light of the sun, linear; w: extinction of the air, 1/m
    vec4 sky;       // rgb: ambient light from above; w: exposure
    vec4 horizon;   // rgb: sky at the horizon; w: side of a texel of the shadow map, m
    vec4 ground;    // rgb: ambient light from below; w: horizon.w as a fraction of the map's side
    vec4 wind;      // xyz: velocity, m/s; w: fraction that varies in gusts
    mat4 near_from_world[2]; // clip space of the shadow maps near the eye, the nearest first
    // xy: sides of their texels, m; z: 1 if they are drawn, else 0; w: factor of the light of sky and
    // air, below 1 where the exposure is raised for the shade below crowns.
    vec4 near_maps;
    vec4 crowns;    // xy: middle of the map of crowns, m; z: half its side, m; w: 1 if it is drawn
    vec4 hills;     // x: distance of the hills at the horizon, m, 0: none; y: altitude of their foot, m
    vec4 wind_before; // `wind` in the previous picture; only with QUALITY 2
    vec4 time_before; // x: time of that wind, s; y: index of the subpixel shift, 0: none
    vec4 viewport;  // xy: corner of the drawn area, zw: size of the whole picture; pixels
} frame;
