// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "motion.glsl"
#if defined(BLENDS) || (defined(CUT_OUT) && !defined(BAKE))
#include "blend.glsl"
#endif
#ifdef BLENDS
flat in vec2 blend_range;
#endif
layout(binding = 1) uniform sampler2DArray bark_texture;
layout(binding = 2) uniform sampler2DArray leaf_texture;
in vec3 world_normal;
in vec2 uv;
flat in vec3 tint;
flat in uint kind; // flags: 1 textured, 2 translucent, 4 bumpy, 8 one colour;
                      // bits from 8 on: translucency in 1/256; from 20 on: roughness in 1/255;
                      // from 28 on: layer of the textures
in vec3 crown_position;
#ifdef BAKE
in vec3 world_position;
// Baking of impostors, before lighting.
layout(location = 2) uniform vec4 centre; // xyz: centre of the impostor, m; w: its half depth, m
layout(location = 3) uniform vec3 to_eye;
layout(location = 4) uniform vec3 right;
layout(location = 5) uniform vec3 up;
layout(location = 0) out vec4 albedo_out; // square roots of linear RGB; opacity
// Normal in the frame of the impostor (2 channels); depth; translucency.
layout(location = 1) out vec4 normal_out;
// Stereographic projection of a normal to 0..1. The projection is continuous, so that mip levels
// may average its values. impostor.frag.glsl has the inverse.
vec2 projected(vec3 normal) {
    vec2 at = vec2(dot(normal, right), dot(normal, up)) / max(1.0 + dot(normal, to_eye), 1e-3);
    return 0.5 + 0.25 * at * min(1.0, 2.0 / max(length(at), 1e-6));
}
#else
in vec3 shadow_position;
in vec2 fog;
in vec3 from_eye; // m
layout(location = 0) out vec4 colour;
#ifdef MOVES
in vec3 moved;
layout(location = 1) out vec4 motion;
#endif
layout(binding = 5) uniform sampler2DArray normal_map; // normals as in glTF
// Normal with the normal map applied. The axes of the texture come from differences between
// pixels, because vertices have no tangents (Schueler 2006, "Normal Mapping without Precomputed
// Tangents", ShaderX 5). `normal`: the normal of the visible side.
vec3 bumped(vec3 normal) {
    vec3 across = cross(dFdy(from_eye), normal);
    vec3 along = cross(normal, dFdx(from_eye));
    vec2 right = dFdx(uv), up = dFdy(uv);
    vec3 u = across * right.x + along * up.x;
    vec3 v = across * right.y + along * up.y;
    float size = max(dot(u, u), dot(v, v));
    vec3 bump = texture(normal_map, vec3(uv, float(kind >> 28u))).xyz * 2.0 - 1.0;
    vec3 turned = size > 0.0 ? (u * bump.x - v * bump.y) * inversesqrt(size) : vec3(0.0);
    return normalize(turned + normal * bump.z);
}
#endif
void main() {
#if defined(BLENDS) && !defined(CUT_OUT)
    keep_range(blend_range);
#endif
    vec3 albedo = tint;
    bool is_translucent = (kind & 2u) != 0u;
#ifdef CUT_OUT
#ifdef BAKE
    vec4 texel = texture(leaf_texture, vec3(uv, float(kind >> 28u)), -2.0);
#else
    vec4 texel = texture(leaf_texture, vec3(uv, float(kind >> 28u)));
#endif
#if defined(BAKE)
    if (texel.a < 0.5) {
        discard;
    }
#elif defined(BLENDS)
    keep_cover_in_range(texel.a, blend_range);
#else
    keep_cover(texel.a);
#endif
    if ((kind & 8u) == 0u) {
        albedo *= texel.rgb;
    }
#else
    if ((kind & 1u) != 0u) {
        albedo *= texture(bark_texture, vec3(uv, float(kind >> 28u))).rgb;
    }
#endif
    vec3 normal = normalize(world_normal);
    if (!gl_FrontFacing) {
        normal = -normal;
    }
#ifndef BAKE
    if ((kind & 4u) != 0u) {
        normal = bumped(normal);
    }
#endif
    if (is_translucent) {
        normal = leaf_normal(normal, crown_position);
    }
#ifdef BAKE
    albedo_out = vec4(sqrt(albedo), 1.0);
    float depth = dot(world_position - centre.xyz, to_eye) / centre.w;
    normal_out = vec4(projected(normal), 0.5 + 0.5 * depth, min(float(kind >> 8u & 0x1FFu) / 128.0, 1.0));
#else
    float lit = sunlight_near(from_eye + frame.eye_time.xyz, frame.to_sun.xyz,
                              sunlight_at(shadow_position, crown_sunlight(crown_position)));
    float translucency = float(kind >> 8u & 0x1FFu) / 256.0;
    float visibility = ambient_visibility(crown_position);
    vec3 radiance = shade_crown(albedo, normal, lit, translucency, visibility);
#if QUALITY > 0
    radiance += gloss(normal, -normalize(from_eye), float(kind >> 20u & 0xFFu) / 255.0,
                      lit * (0.4 + 0.6 * visibility), visibility);
#endif
    colour = tone_mapped(apply_fog(radiance, fog));
#ifdef MOVES
    motion = vec4(moved, 0.0);
#endif
#endif
}
