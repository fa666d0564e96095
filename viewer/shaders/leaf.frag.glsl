// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "motion.glsl"
#if defined(BLENDS) || defined(CUT_OUT)
#include "blend.glsl"
#endif
#ifdef BLENDS
flat in vec2 blend_range;
#endif
// Leaves lit at vertices: cards with an alpha mask, or polygons of one colour.
#ifdef CUT_OUT
layout(binding = 2) uniform sampler2DArray leaf_texture;
in vec2 uv;
in vec3 front; // radiance of the front, dimmed by fog, where the leaf texture is white
in vec3 back;
in vec3 fog_light;
flat in uint kind; // kind & 8: one colour; from bit 28 on: layer of the texture
#else
in vec3 front; // tone-mapped
in vec3 back;
#endif
layout(location = 0) out vec4 colour;
#ifdef MOVES
in vec3 moved; // world position in the previous picture minus that in this one, m
layout(location = 1) out vec4 motion;
#endif
void main() {
#ifdef MOVES
    motion = vec4(moved, 0.0);
#endif
#ifdef CUT_OUT
    vec4 texel = texture(leaf_texture, vec3(uv, float(kind >> 28u)));
#ifdef BLENDS
    keep_cover_in_range(texel.a, blend_range);
#else
    keep_cover(texel.a);
#endif
    vec3 albedo = (kind & 8u) != 0u ? vec3(1.0) : texel.rgb;
    colour = tone_mapped(albedo * (gl_FrontFacing ? front : back) + fog_light);
#else
#ifdef BLENDS
    keep_range(blend_range);
#endif
    colour = vec4(gl_FrontFacing ? front : back, 1.0);
#endif
}
