#include "light.glsl"
layout(binding = 3) uniform sampler2DArray albedos; // square roots; opacity
layout(binding = 4) uniform sampler2DArray normals; // normal, depth, of light through it
#ifdef BLENDS
#include "blend.glsl"
flat in vec2 blend_range;
#endif
in vec3 corner;
in vec3 sun_map;     // of the picture's middle plane
flat in vec3 nearer; // what the depth of the picture adds to it
#ifndef SHADOW
in vec2 air;
in vec3 within;
flat in vec3 deeper;
flat in mat3 turn; // of what is seen in the picture
flat in int is_cluster;
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
#ifdef BLENDS
    keep_range(blend_range);
#endif
#ifndef DEPTH
    vec4 shape = texture(normals, corner);
    float depth = 2.0 * shape.z - 1.0;
#ifdef SHADOW
    gl_FragDepth = sun_map.z + nearer.z * depth + 0.0004;
#else
    vec2 at = 4.0 * shape.xy - 2.0;
    float away = dot(at, at);
    vec3 n = turn * (vec3(2.0 * at, 1.0 - away) / (1.0 + away));
    vec3 part = within + deeper * depth;
    if (is_cluster != 0) {
        // Within the crown of one of its trees, whose leaves face outwards.
        part = vec3(0.25 * n.x, 0.05 + 0.85 * part.y, 0.25 * n.z);
    }
    float lit = sun_within(part);
    if (is_cluster == 0) {
        lit = sunlight_at(sun_map + nearer * depth, lit);
    }
    colour = displayed(through_air(
        shade_within(albedo.rgb * albedo.rgb, n, lit, 0.5 * shape.w, openness(part)), air));
#endif
#endif
}
