#include "light.glsl"
#ifdef BLENDS
#include "blend.glsl"
flat in vec2 blend_range;
#endif
// Leaves that are lit at the corners: of cards that they are cut out of, or of one colour.
#ifdef CUT_OUT
layout(binding = 2) uniform sampler2D leaf_texture;
in vec2 uv;
in vec3 front; // what a white leaf sends to the eye from either side
in vec3 back;
in vec3 haze;
#else
in vec3 front; // what is displayed
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
    colour = displayed(texel.rgb * (gl_FrontFacing ? front : back) + haze);
#else
    colour = vec4(gl_FrontFacing ? front : back, 1.0);
#endif
}
