#include "light.glsl"
// What parts of a tree look like; the C++ side is gl/forest_buffers.h.
struct Look {
    vec4 colour;
    uvec4 kind; // textured, of light through it
};
layout(std430, binding = 3) readonly buffer Looks { Look looks[]; };
layout(binding = 1) uniform sampler2D bark_texture;
layout(binding = 2) uniform sampler2D leaf_texture;
in vec3 place;
in vec3 across;
in vec2 uv;
flat in uint look;
in vec3 part;
#ifdef PORTRAIT
// Seen from outside, for impostors: what light does is not known yet.
layout(location = 2) uniform vec4 middle; // of the picture, m; its depth
layout(location = 3) uniform vec3 to_eye;
layout(location = 0) out vec4 albedo_out; // square roots; opacity
layout(location = 1) out vec4 normal_out; // octahedral normal, depth, of light through it
vec2 folded(vec3 n) {
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    vec2 e = n.z >= 0.0 ? n.xy
                        : (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    return 0.5 * e + 0.5;
}
#else
out vec4 colour;
#endif
void main() {
    Look of = looks[look];
    vec3 albedo = of.colour.rgb;
#ifdef CUT_OUT
    vec4 texel = texture(leaf_texture, uv);
    if (texel.a < 0.5) {
        discard;
    }
    albedo *= texel.rgb;
#else
    if (of.kind.x != 0u) {
        albedo *= texture(bark_texture, uv).rgb;
    }
#endif
    vec3 normal = normalize(across);
    if (!gl_FrontFacing) {
        normal = -normal;
    }
#ifdef PORTRAIT
    albedo_out = vec4(sqrt(albedo), 1.0);
    float depth = dot(place - middle.xyz, to_eye) / middle.w;
    normal_out = vec4(folded(normal), 0.5 + 0.5 * depth, of.kind.y != 0u ? 1.0 : 0.0);
#else
    if (of.kind.y != 0u) {
        normal = leaf_normal(normal, part);
    }
    float lit = sunlight(place, normal, sun_within(part));
    float through = of.kind.y != 0u ? 0.5 : 0.0;
    colour = displayed(seen(shade_within(albedo, normal, lit, through, openness(part)), place));
#endif
}
