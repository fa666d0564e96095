// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "dither.glsl"
#include "motion.glsl"
layout(binding = 3) uniform sampler2DArray albedos; // square roots of linear RGB; opacity
layout(binding = 4) uniform sampler2DArray normals; // normal (2 channels), depth, translucency
#if defined(BLENDS) || defined(DEPTH)
#include "blend.glsl"
#endif
#ifdef BLENDS
flat in vec2 blend_range;
#endif
#if QUALITY > 0 && !defined(SHADOW)
#define TURNS
flat in vec3 next_view;
#ifndef DEPTH
flat in mat3 next_world_from_impostor;
#endif
#endif
in vec3 layer_uv;
in vec3 plane_shadow_position; // at the middle plane of the impostor
flat in vec3 shadow_step;      // per unit of depth
#ifndef SHADOW
in vec2 fog;
in vec3 plane_crown_position;
flat in vec3 crown_step;
flat in mat3 world_from_impostor; // for normals
flat in int is_cluster;
#endif
#ifdef PICK
layout(location = 20) uniform uint content; // PickedKind
flat in uint item;
layout(location = 0) out uvec4 picked;
#endif
#if !defined(SHADOW) && !defined(DEPTH)
layout(early_fragment_tests) in; // the depth pass has drawn the depth
layout(location = 0) out vec4 colour;
#ifdef MOVES
in vec3 moved;
layout(location = 1) out vec4 motion;
#endif
#endif
#if QUALITY > 0 && !defined(SHADOW) && !defined(DEPTH)
// Mean of sunlight_at() over two texels of the shadow map: leaves cast no sharp shadows on a crown.
float sunlight_on_crown(vec3 at, float outside) {
    float turn = 6.2831853 * stratified_random(374761393u, 0.25);
    vec2 aside = 3.4 * frame.ground.w * vec2(cos(turn), sin(turn));
    vec2 across = 0.6 * vec2(-aside.y, aside.x);
    return 0.25 * (sunlight_at(at + vec3(aside, 0.0), outside) +
                   sunlight_at(at - vec3(aside, 0.0), outside) +
                   sunlight_at(at + vec3(across, 0.0), outside) +
                   sunlight_at(at - vec3(across, 0.0), outside));
}
#endif
#ifdef TURNS
// Range of the dither thresholds of the nearest view; next_view has the rest.
vec2 nearest_range() {
    return next_view.y > 0.0 ? vec2(0.0, next_view.y) : vec2(next_view.z, 1.0);
}
#ifdef DEPTH
// Part of a range of thresholds that a view with this opacity covers, within the LOD band.
vec2 covered_part(vec2 range, float opacity) {
#ifdef ONE_SAMPLE
    float cover = step(0.5, opacity);
#else
    float cover = cut_out_cover(opacity);
#endif
    vec2 part = vec2(range.x, mix(range.x, range.y, cover));
#ifdef BLENDS
    part = vec2(max(part.x, blend_range.x), min(part.y, blend_range.y));
#endif
    return part;
}
#endif
#endif
void main() {
#ifdef TURNS
    bool has_next = next_view.y < next_view.z;
    vec2 across = dFdx(layer_uv.xy), along = dFdy(layer_uv.xy);
    vec3 next_uv = layer_uv + vec3(next_view.x, 0.0, 0.0);
    vec4 albedo = textureGrad(albedos, layer_uv, across, along);
    vec4 next_albedo = has_next ? textureGrad(albedos, next_uv, across, along) : vec4(0.0);
#else
    vec4 albedo = texture(albedos, layer_uv);
#endif
#if defined(DEPTH) && defined(TURNS)
    vec2 seen = covered_part(nearest_range(), albedo.a);
    vec2 next_seen = has_next ? covered_part(next_view.yz, next_albedo.a) : vec2(0.0);
#ifdef ONE_SAMPLE
    float threshold = stratified_random(0u, 0.25);
    if (!is_in_range(threshold, seen) && !is_in_range(threshold, next_seen)) {
        discard;
    }
#else
    keep_samples(samples_in(seen) | samples_in(next_seen));
#endif
#elif defined(DEPTH) && defined(BLENDS)
    keep_cover_in_range(albedo.a, blend_range);
#elif defined(DEPTH)
    keep_cover(albedo.a);
#elif defined(BLENDS)
    keep_range(blend_range);
#elif defined(SHADOW)
    if (albedo.a < 0.5) {
        discard;
    }
#endif
#ifdef PICK
    picked = uvec4(content, item, 0u, 0u);
#endif
#ifndef DEPTH
#ifdef TURNS
    vec4 shape = textureGrad(normals, layer_uv, across, along);
#else
    vec4 shape = texture(normals, layer_uv);
#endif
#ifndef SHADOW
    vec2 at = 4.0 * shape.xy - 2.0;
    float radius2 = dot(at, at);
    vec3 n = world_from_impostor * (vec3(2.0 * at, 1.0 - radius2) / (1.0 + radius2));
#ifdef TURNS
    if (has_next) { // mix both views by the parts of the pixel that they cover
        vec4 next_shape = textureGrad(normals, next_uv, across, along);
        float share = next_view.z - next_view.y;
        float part = share * next_albedo.a / max(mix(albedo.a, next_albedo.a, share), 1e-3);
        vec2 next_at = 4.0 * next_shape.xy - 2.0;
        float next2 = dot(next_at, next_at);
        n = mix(n, next_world_from_impostor * (vec3(2.0 * next_at, 1.0 - next2) / (1.0 + next2)),
                part);
        n = normalize(n + vec3(0.0, 1e-4, 0.0));
        albedo.rgb = mix(albedo.rgb, next_albedo.rgb, part);
        shape = mix(shape, next_shape, part);
    }
#endif
#endif
    float depth = 2.0 * shape.z - 1.0;
#ifdef SHADOW
    gl_FragDepth = plane_shadow_position.z + shadow_step.z * depth + 0.0004;
#else
    vec3 crown_position = plane_crown_position + crown_step * depth;
    if (is_cluster != 0) {
        // Assume a place in the crown of one tree of the cluster, with leaves facing outward.
        crown_position = vec3(0.25 * n.x, 0.05 + 0.85 * crown_position.y, 0.25 * n.z);
    }
    float lit = crown_sunlight(crown_position);
    if (is_cluster == 0) {
#if QUALITY > 0
        lit = sunlight_on_crown(plane_shadow_position + shadow_step * depth, lit);
#else
        lit = sunlight_at(plane_shadow_position + shadow_step * depth, lit);
#endif
    }
    colour = tone_mapped(apply_fog(
        shade_crown(albedo.rgb * albedo.rgb, n, lit, 0.5 * shape.w,
                    ambient_visibility(crown_position)),
        fog));
#ifdef MOVES
    motion = vec4(moved, 0.0);
#endif
#endif
#endif
}
