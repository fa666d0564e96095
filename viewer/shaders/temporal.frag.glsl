// SPDX-License-Identifier: MIT
// Mixes a picture with the history, the mix of earlier pictures: each pixel finds its place in
// the history, whose colour there is limited to the colours around the pixel now (Karis
// 2014, "High-Quality Temporal Supersampling"; Salvi 2016, "An Excursion in Temporal Supersampling").
#include "frame.glsl"
layout(binding = 1) uniform sampler2D picture;
layout(binding = 2) uniform sampler2D motions; // world position: previous picture minus this one, m
layout(binding = 3) uniform sampler2D depths;  // 0 at infinity
layout(binding = 4) uniform sampler2D history;
layout(location = 0) uniform mat4 before_from_world; // to the previous clip space, without shift
layout(location = 1) uniform mat4 now_from_world;    // to clip space, without shift
layout(location = 2) uniform float weight; // of the picture, against the history
layout(location = 3) uniform int moves;    // 1: the motions are set
out vec4 colour;

// Luma and two chromas; boxes of colours are smaller in this space.
vec3 to_ycocg(vec3 c) {
    return vec3(0.25 * (c.r + 2.0 * c.g + c.b), 0.5 * (c.r - c.b), 0.25 * (2.0 * c.g - c.r - c.b));
}
vec3 from_ycocg(vec3 c) {
    return vec3(c.x - c.z + c.y, c.x + c.z, c.x - c.z - c.y);
}
// A texture read with the Catmull-Rom filter, without its corners: bilinear filtering would blur the
// mix more with each picture.
vec3 sharp_history(vec2 uv) {
    vec2 size = vec2(textureSize(history, 0));
    vec2 middle = floor(uv * size - 0.5) + 0.5;
    vec2 f = uv * size - middle;
    vec2 first = f * (-0.5 + f * (1.0 - 0.5 * f));
    vec2 last = f * f * (-0.5 + 0.5 * f);
    vec2 between = 1.0 - first - last;
    vec2 second = f * (0.5 + f * (2.0 - 1.5 * f));
    vec2 p0 = (middle - 1.0) / size, p1 = (middle + second / between) / size;
    vec2 p2 = (middle + 2.0) / size;
    vec4 sum = vec4(texture(history, p1).rgb, 1.0) * (between.x * between.y);
    sum += vec4(texture(history, vec2(p1.x, p0.y)).rgb, 1.0) * (between.x * first.y);
    sum += vec4(texture(history, vec2(p0.x, p1.y)).rgb, 1.0) * (first.x * between.y);
    sum += vec4(texture(history, vec2(p2.x, p1.y)).rgb, 1.0) * (last.x * between.y);
    sum += vec4(texture(history, vec2(p1.x, p2.y)).rgb, 1.0) * (between.x * last.y);
    return max(sum.rgb / sum.a, vec3(0.0));
}
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(picture, 0) - 1;
    vec3 now = texelFetch(picture, at, 0).rgb;
    vec3 mean = vec3(0.0), squares = vec3(0.0);
    ivec2 nearest = at; // edges move with the surface in front
    float depth = -1.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 beside = clamp(at + ivec2(x, y), ivec2(0), last);
            vec3 c = to_ycocg(texelFetch(picture, beside, 0).rgb);
            mean += c / 9.0;
            squares += c * c / 9.0;
            float d = texelFetch(depths, beside, 0).r;
            if (d > depth) {
                depth = d;
                nearest = beside;
            }
        }
    }
    vec2 size = vec2(last + 1);
    vec4 place = frame.clip_to_world *
                 vec4((vec2(nearest) + 0.5) / size * 2.0 - 1.0, depth, 1.0);
    vec4 place_before = place;
    if (moves != 0) {
        place_before.xyz += place.w * texelFetch(motions, nearest, 0).xyz;
    }
    vec4 clip = now_from_world * place, clip_before = before_from_world * place_before;
    vec2 step = 0.5 * (clip_before.xy / clip_before.w - clip.xy / clip.w);
    vec2 uv = gl_FragCoord.xy / size + step;
    if (weight >= 1.0 || clip_before.w <= 0.0 || any(lessThan(uv, vec2(0.0))) ||
        any(greaterThan(uv, vec2(1.0)))) {
        colour = vec4(now, 1.0);
        return;
    }
    vec3 spread = sqrt(max(squares - mean * mean, vec3(0.0)));
    // The colours of the history have wider limits where the surface is at rest.
    float still = 1.0 - smoothstep(0.02, 0.3, length(step * size));
    vec3 box = mix(1.0, 3.0, still) * spread + vec3(1e-3);
    vec3 old = to_ycocg(sharp_history(uv)) - mean;
    vec3 beyond = abs(old) / box;
    old = mean + old / max(max(beyond.x, max(beyond.y, beyond.z)), 1.0);
    colour = vec4(mix(from_ycocg(old), now, weight), 1.0);
}
