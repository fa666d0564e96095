#include "light.glsl"
#include "blend.glsl"
layout(binding = 3) uniform sampler2DArray albedos; // square roots; opacity
layout(binding = 4) uniform sampler2DArray normals; // octahedral normal, depth, of light through it
flat in float shown; // the part of it that is drawn
in vec3 corner;
in vec3 sun_map;     // of the picture's middle plane
flat in vec3 nearer; // what the depth of the picture adds to it
#ifndef SHADOW
in vec2 air;
in vec3 within;
flat in vec3 deeper;
flat in vec2 yaw; // cosine and sine
#endif
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
#ifdef DEPTH
    keep_part(shown);
#endif
#ifndef DEPTH
    vec4 shape = texture(normals, corner);
    float depth = 2.0 * shape.z - 1.0;
#ifdef SHADOW
    gl_FragDepth = sun_map.z + nearer.z * depth + 0.0004;
#else
    vec2 e = 2.0 * shape.xy - 1.0;
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) {
        n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    }
    n = normalize(vec3(yaw.x * n.x + yaw.y * n.z, n.y, yaw.x * n.z - yaw.y * n.x));
    vec3 part = within + deeper * depth;
    if (shape.w > 0.5) {
        n = leaf_normal(n, part);
    }
    float lit = sunlight_at(sun_map + nearer * depth, sun_within(part));
    colour = displayed(through_air(
        shade_within(albedo.rgb * albedo.rgb, n, lit, 0.5 * shape.w, openness(part)), air));
#endif
#endif
}
