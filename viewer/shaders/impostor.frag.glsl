#include "light.glsl"
layout(binding = 3) uniform sampler2DArray albedos; // square roots; opacity
layout(binding = 4) uniform sampler2DArray normals; // octahedral normal, depth, of light through it
in vec3 place;
in vec3 corner;
flat in vec4 to_eye;
flat in float yaw;
in vec3 within;
flat in vec3 deeper;
#if !defined(SHADOW) && !defined(DEPTH)
layout(early_fragment_tests) in; // where the depth is that of the tree
out vec4 colour;
#endif
void main() {
    vec4 albedo = texture(albedos, corner);
#if defined(SHADOW) || defined(DEPTH)
    if (albedo.a < 0.5) {
        discard;
    }
#endif
#ifndef DEPTH
    vec4 shape = texture(normals, corner);
    vec3 there = place + to_eye.xyz * (to_eye.w * (2.0 * shape.z - 1.0));
#ifdef SHADOW
    gl_FragDepth = (frame.shadow_from_world * vec4(there, 1.0)).z + 0.0004;
#else
    vec2 e = 2.0 * shape.xy - 1.0;
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) {
        n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    }
    float s = sin(yaw), c = cos(yaw);
    n = normalize(vec3(c * n.x + s * n.z, n.y, c * n.z - s * n.x));
    vec3 part = within + deeper * (2.0 * shape.z - 1.0);
    if (shape.w > 0.5) {
        n = leaf_normal(n, part);
    }
    float lit = sunlight(there, n, sun_within(part));
    colour = displayed(seen(
        shade_within(albedo.rgb * albedo.rgb, n, lit, 0.5 * shape.w, openness(part)), there));
#endif
#endif
}
