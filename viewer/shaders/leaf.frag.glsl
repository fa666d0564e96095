#include "light.glsl"
// Leaves that are cut out of cards, lit at the corners of the cards.
layout(binding = 2) uniform sampler2D leaf_texture;
in vec2 uv;
in vec3 front; // what a white leaf sends to the eye from either side
in vec3 back;
in vec3 haze;
out vec4 colour;
void main() {
    vec4 texel = texture(leaf_texture, uv);
    if (texel.a < 0.5) {
        discard;
    }
    colour = displayed(texel.rgb * (gl_FrontFacing ? front : back) + haze);
}
