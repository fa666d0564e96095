#include "light.glsl"
#ifdef BLENDS
#include "blend.glsl"
flat in vec2 blend_range;
#endif
layout(binding = 1) uniform sampler2D bark_texture;
layout(binding = 2) uniform sampler2D leaf_texture;
in vec3 across;
in vec2 uv;
flat in vec3 tint;
flat in uint kind; // bits: 1 textured, 2 of light through it
in vec3 part;
#ifdef BAKE
in vec3 place;
// Seen from outside, for impostors: what light does is not known yet.
layout(location = 2) uniform vec4 middle; // of the picture, m; its depth
layout(location = 3) uniform vec3 to_eye;
layout(location = 4) uniform vec3 right;
layout(location = 5) uniform vec3 up;
layout(location = 0) out vec4 albedo_out; // square roots; opacity
layout(location = 1) out vec4 normal_out; // seen from the eye; depth; of light through it
// A normal as two parts of 1: projected from what faces away from the eye, so that normals side by
// side stay so, and smaller pictures may have their mean. impostor.frag.glsl has the inverse.
vec2 projected(vec3 normal) {
    vec2 at = vec2(dot(normal, right), dot(normal, up)) / max(1.0 + dot(normal, to_eye), 1e-3);
    return 0.5 + 0.25 * at * min(1.0, 2.0 / max(length(at), 1e-6));
}
#else
in vec3 sun_map;
in vec2 air;
out vec4 colour;
#endif
void main() {
#ifdef BLENDS
    keep_range(blend_range);
#endif
    vec3 albedo = tint;
    bool is_through = (kind & 2u) != 0u;
#ifdef CUT_OUT
    vec4 texel = texture(leaf_texture, uv);
    if (texel.a < 0.5) {
        discard;
    }
    albedo *= texel.rgb;
#else
    if ((kind & 1u) != 0u) {
        albedo *= texture(bark_texture, uv).rgb;
    }
#endif
    vec3 normal = normalize(across);
    if (!gl_FrontFacing) {
        normal = -normal;
    }
    if (is_through) {
        normal = leaf_normal(normal, part);
    }
#ifdef BAKE
    albedo_out = vec4(sqrt(albedo), 1.0);
    float depth = dot(place - middle.xyz, to_eye) / middle.w;
    normal_out = vec4(projected(normal), 0.5 + 0.5 * depth, is_through ? 1.0 : 0.0);
#else
    float lit = sunlight_at(sun_map, sun_within(part));
    float through = is_through ? 0.5 : 0.0;
    colour =
        displayed(through_air(shade_within(albedo, normal, lit, through, openness(part)), air));
#endif
}
