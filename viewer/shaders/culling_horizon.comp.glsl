// SPDX-License-Identifier: MIT
// Computes the slopes of the horizon, as GroundHorizon::slopes_of(): a workgroup per direction, an
// invocation per distance.
#include "culling.glsl"
layout(local_size_x = 256) in;
layout(binding = 1) uniform sampler2DArray heights; // as in terrain.vert.glsl
layout(binding = 0, r32f) writeonly uniform image2D slopes;
// 256 distances, m; then sine and cosine of the angles that bound the directions.
layout(std430, binding = 3) readonly buffer Rays { float rays[]; };
shared float steepest[256];

const float kFinestCell = 0.5;    // m
const float kNearestRange = 34.0; // m
const float kInfinity = uintBitsToFloat(0x7F800000u);

// Min height, m, of the drawn ground at a distance, between the angles that bound a direction.
float min_height_between(uint direction, float distance) {
    float away = length(vec2(distance, culling.ground.y));
    uint level = 0u;
    while (level < culling.heights.x && away >= kNearestRange * float(1u << level)) {
        ++level;
    }
    if (level == culling.heights.x) {
        return -kInfinity;
    }
    float cell = kFinestCell * float(1u << level);
    vec2 eye = culling.eye_pixels.xz;
    uint at = 256u + 2u * direction;
    vec2 first = (eye + distance * vec2(rays[at], rays[at + 1u])) / cell;
    vec2 last = (eye + distance * vec2(rays[at + 2u], rays[at + 3u])) / cell;
    ivec2 low = ivec2(floor(min(first, last))) - 1;
    ivec2 high = ivec2(floor(max(first, last))) + 2;
    float lowest = kInfinity;
    for (int z = low.y; z <= high.y; ++z) {
        for (int x = low.x; x <= high.x; ++x) {
            ivec2 texel = ivec2(x, z) - culling.origins[level].xy;
            lowest = min(lowest, texelFetch(heights, ivec3(texel, level), 0).r);
        }
    }
    return lowest;
}

void main() {
    uint index = gl_LocalInvocationIndex;
    uint direction = gl_WorkGroupID.x;
    float slope = -kInfinity;
    if (index < culling.heights.y) {
        float distance = rays[index];
        slope = (min_height_between(direction, distance) - culling.eye_pixels.y) / distance;
    }
    steepest[index] = slope;
    memoryBarrierShared();
    barrier();
    for (uint step = 1u; step < 256u; step *= 2u) {
        float other = index >= step ? steepest[index - step] : -kInfinity;
        memoryBarrierShared();
        barrier();
        steepest[index] = max(steepest[index], other);
        memoryBarrierShared();
        barrier();
    }
    imageStore(slopes, ivec2(index, direction), vec4(steepest[index]));
}
