// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "blend.glsl"
layout(binding = 1) uniform sampler2D base_texture;
layout(binding = 2) uniform sampler2D normal_texture;
layout(location = 0) uniform vec4 base_colour; // w: roughness
layout(location = 1) uniform ivec4 kind; // x: textured, y: bumpy, z: alpha mask, w: translucency in 1/256
in vec3 world_position;
in vec3 world_normal;
in vec2 uv;
in vec4 world_tangent;
layout(location = 0) out vec4 colour;
#if QUALITY > 1
layout(location = 1) out vec4 motion; // temporal.frag.glsl
#endif
void main() {
    vec3 albedo = base_colour.rgb;
    float opacity = 1.0;
    if (kind.x != 0) {
        vec4 texel = texture(base_texture, uv);
        opacity = kind.z != 0 ? texel.a : 1.0;
        albedo *= texel.rgb;
    }
    keep_cover(opacity);
    vec3 geometric = normalize(world_normal);
    vec3 normal = geometric;
    if (kind.y != 0) {
        vec3 t = normalize(world_tangent.xyz - geometric * dot(geometric, world_tangent.xyz));
        vec3 b = cross(geometric, t) * world_tangent.w;
        vec3 bump = texture(normal_texture, uv).xyz * 2.0 - 1.0;
        normal = normalize(t * bump.x + b * bump.y + geometric * bump.z);
    }
    if (!gl_FrontFacing) {
        normal = -normal;
        geometric = -geometric;
    }
    float translucency = float(kind.w) / 256.0;
    // Light that passes through a surface arrives on its other side.
    bool is_lit_from_behind = translucency > 0.0 && dot(geometric, frame.to_sun.xyz) < 0.0;
    float lit = sunlight(world_position, is_lit_from_behind ? -geometric : geometric, 1.0);
    vec3 radiance = shade(albedo, normal, world_position, lit, translucency);
#if QUALITY > 0
    vec3 to_eye = normalize(frame.eye_time.xyz - world_position);
    radiance += gloss(normal, to_eye, base_colour.w, lit, 1.0);
#endif
    colour = tone_mapped(fogged(radiance, world_position));
#if QUALITY > 1
    motion = vec4(0.0);
#endif
}
