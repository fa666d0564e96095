// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "dither.glsl"
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
in vec3 plane_shadow_position; // at the middle plane
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
out vec4 colour;
#endif
void main() {
#ifdef TURNS
    // Random numbers divide the pixels of each LOD band between both views.
    float threshold = random_of_pixel();
    bool is_next = threshold >= next_view.y && threshold < next_view.z;
    vec2 across = dFdx(layer_uv.xy), along = dFdy(layer_uv.xy);
    vec3 at_texel = layer_uv + vec3(is_next ? next_view.x : 0.0, 0.0, 0.0);
#define PICTURE(atlas) textureGrad(atlas, at_texel, across, along)
#else
#define PICTURE(atlas) texture(atlas, layer_uv)
#endif
    vec4 albedo = PICTURE(albedos);
#if defined(DEPTH) && defined(BLENDS)
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
    vec4 shape = PICTURE(normals);
    float depth = 2.0 * shape.z - 1.0;
#ifdef SHADOW
    gl_FragDepth = plane_shadow_position.z + shadow_step.z * depth + 0.0004;
#else
    vec2 at = 4.0 * shape.xy - 2.0;
    float radius2 = dot(at, at);
    vec3 n = vec3(2.0 * at, 1.0 - radius2) / (1.0 + radius2);
#ifdef TURNS
    n = (is_next ? next_world_from_impostor : world_from_impostor) * n;
#else
    n = world_from_impostor * n;
#endif
    vec3 crown_position = plane_crown_position + crown_step * depth;
    if (is_cluster != 0) {
        // Assume a place in the crown of one tree of the cluster, with leaves facing outward.
        crown_position = vec3(0.25 * n.x, 0.05 + 0.85 * crown_position.y, 0.25 * n.z);
    }
    float lit = crown_sunlight(crown_position);
    if (is_cluster == 0) {
        lit = sunlight_at(plane_shadow_position + shadow_step * depth, lit);
    }
    colour = tone_mapped(apply_fog(
        shade_crown(albedo.rgb * albedo.rgb, n, lit, 0.5 * shape.w,
                    ambient_visibility(crown_position)),
        fog));
#endif
#endif
}
