// SPDX-License-Identifier: MIT
#include "frame.glsl"
#ifdef BLENDS
#include "blend.glsl"
flat in vec2 blend_range;
#endif
// Writes kind and index of the part that a pixel shows, for Renderer::pick().
layout(location = 20) uniform uint content; // PickedKind
#if defined(PLANT)
layout(binding = 1) uniform sampler2D leaf_texture;
layout(location = 1) uniform ivec4 kind; // x: textured, z: alpha mask
layout(location = 2) uniform uint first_triangle;
in vec2 uv;
#elif defined(CUT_OUT)
layout(binding = 2) uniform sampler2DArray leaf_texture;
in vec2 uv;
flat in uint kind; // from bit 28 on: layer of the texture
#endif
#if !defined(PLANT) && !defined(GROUND)
flat in uint item; // index of the branch or of the impostor
#endif
layout(location = 0) out uvec4 picked;
void main() {
#ifdef BLENDS
    keep_range(blend_range);
#endif
#if defined(PLANT)
    if (kind.x != 0 && kind.z != 0 && texture(leaf_texture, uv).a < 0.5) {
        discard;
    }
    picked = uvec4(content, first_triangle + uint(gl_PrimitiveID), 0u, 0u);
#elif defined(GROUND)
    picked = uvec4(content, 0u, 0u, 0u);
#else
#ifdef CUT_OUT
    if (texture(leaf_texture, vec3(uv, float(kind >> 28u))).a < 0.5) {
        discard;
    }
#endif
    picked = uvec4(content, item, 0u, 0u);
#endif
}
