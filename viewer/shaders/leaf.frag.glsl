// SPDX-License-Identifier: MIT
#include "light.glsl"
#ifdef BLENDS
#include "blend.glsl"
flat in vec2 blend_range;
#endif
// Leaves lit at vertices: cards with an alpha mask, or polygons of one colour.
#ifdef CUT_OUT
layout(binding = 2) uniform sampler2D leaf_texture;
in vec2 uv;
in vec3 front; // radiance of the front, dimmed by fog, where the leaf texture is white
in vec3 back;
in vec3 fog_light;
flat in uint kind; // kind & 8: one colour
#else
in vec3 front; // tone-mapped
in vec3 back;
#endif
out vec4 colour;
void main() {
#ifdef BLENDS
    keep_range(blend_range);
#endif
#ifdef CUT_OUT
    vec4 texel = texture(leaf_texture, uv);
    if (texel.a < 0.5) {
        discard;
    }
    vec3 albedo = (kind & 8u) != 0u ? vec3(1.0) : texel.rgb;
    colour = tone_mapped(albedo * (gl_FrontFacing ? front : back) + fog_light);
#else
    colour = vec4(gl_FrontFacing ? front : back, 1.0);
#endif
}
