// SPDX-License-Identifier: MIT
// Occlusion by the ground: GroundHorizon::occludes(). culling_horizon.comp.glsl makes the slopes.
layout(binding = 6) uniform sampler2D horizon; // slope by distance (x) and direction (y)
const int kDirections = 512;
const float kTurn = 6.28318530718;
const float kFirst = 2.0; // m
const float kRatio = 1.06;

bool is_occluded(vec3 low, vec3 high) {
    if (culling.ground.x == 0.0 || culling.heights.y == 0u) {
        return false;
    }
    vec3 eye = culling.eye_pixels.xyz;
    float nearest = length(clamp(eye.xz, low.xz, high.xz) - eye.xz);
    if (nearest <= kFirst * kRatio) {
        return false;
    }
    vec2 middle = 0.5 * (low.xz + high.xz) - eye.xz;
    float left = 0.0;
    float right = 0.0;
    float farthest = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 corner = vec2((i & 1) == 0 ? low.x : high.x, (i & 2) == 0 ? low.z : high.z) - eye.xz;
        float angle = atan(corner.x * middle.y - corner.y * middle.x, dot(corner, middle));
        left = min(left, angle);
        right = max(right, angle);
        farthest = max(farthest, length(corner));
    }
    const float kSlopeMargin = 5e-4;
    float rise = high.y - eye.y;
    float slope = rise / (rise > 0.0 ? nearest : farthest) + kSlopeMargin;
    int distances = int(culling.heights.y);
    int last = clamp(int(log(nearest / kFirst) / log(kRatio)) - 1, 0, distances - 1);
    float ahead = atan(middle.x, middle.y);
    const float kSlack = 1e-4;
    int end = int(floor((ahead + right + kSlack) / kTurn * float(kDirections)));
    for (int sector = int(floor((ahead + left - kSlack) / kTurn * float(kDirections)));
         sector <= end; ++sector) {
        int index = (sector % kDirections + kDirections) % kDirections;
        if (texelFetch(horizon, ivec2(last, index), 0).r <= slope) {
            return false;
        }
    }
    return true;
}
