// Uniforms shared by all shaders; the C++ side is FrameBlock in gl/impl/frame_block.h.
layout(std140, binding = 0) uniform FrameBlock {
    mat4 view_projection;
    mat4 clip_to_world; // for view rays
    mat4 shadow_from_world;
    vec4 eye_time;  // m; w: s
    vec4 to_sun;    // unit; w: 1 with shadows
    vec4 sun;       // linear RGB; w: extinction of the air, 1/m
    vec4 sky;       // ambient from above; w: exposure
    vec4 horizon;   // at the horizon; w: texel of the shadow map, m
    vec4 ground;    // ambient from below; w: texel of the shadow map, in 1/side
    vec4 wind;      // m/s; w: part of gusts
    vec4 viewport;  // pixels: x, y, width, height of the whole picture
} frame;
