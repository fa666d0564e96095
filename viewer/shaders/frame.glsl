// What all shaders of a frame know. The C++ side is FrameBlock in gl/frame_block.h.
layout(std140, binding = 0) uniform FrameBlock {
    mat4 view_projection;
    mat4 clip_to_world; // directions, of the picture's corners
    mat4 shadow_from_world;
    vec4 eye_time;  // m; s
    vec4 to_sun;    // unit; w: 1 if there are shadows
    vec4 sun;       // linear RGB; w: extinction of the air, 1/m
    vec4 sky;       // from above; w: exposure
    vec4 horizon;   // w: side of a texel of the shadow map, m
    vec4 ground;    // from below; w: the same, as a part of the map
    vec4 wind;      // m/s; w: gusts, as a part of it
    vec4 viewport;  // pixels: x, y, width, height of the whole picture
} frame;
