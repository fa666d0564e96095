#include "frame.glsl"
layout(binding = 0) uniform sampler2DShadow shadow_map;

vec3 sky_colour(vec3 direction) {
    float up = max(direction.y, 0.0);
    float low = 1.0 - up;
    vec3 colour = mix(frame.sky.rgb, frame.horizon.rgb, low * low * low);
    float near_sun = max(dot(direction, frame.to_sun.xyz), 0.0);
    float near2 = near_sun * near_sun;
    float near4 = near2 * near2;
    float near16 = near4 * near4 * near4 * near4;
    return colour + frame.sun.rgb * (0.05 * near16 + 0.25 * pow(near16, 25.0));
}

// How much of the sun is seen from a place, 0 to 1; `normal` moves the place off its surface.
// ONE_TAP, TWO_TAPS: fewer looks at the map, each of which filters four texels.
// `outside`: what is told where the map does not reach.
float sunlight(vec3 place, vec3 normal, float outside) {
    if (frame.to_sun.w == 0.0) {
        return 1.0;
    }
    vec4 at = frame.shadow_from_world * vec4(place + normal * (1.5 * frame.horizon.w), 1.0);
    vec2 corner = at.xy * 0.5 + 0.5;
    if (any(lessThan(corner, vec2(0.0))) || any(greaterThan(corner, vec2(1.0))) || at.z > 1.0) {
        return outside;
    }
    float lit = 0.0;
#if defined(ONE_TAP)
    lit = texture(shadow_map, vec3(corner, at.z));
#elif defined(TWO_TAPS)
    vec2 aside = frame.ground.w * vec2(0.6, 0.35);
    lit = 0.5 * (texture(shadow_map, vec3(corner - aside, at.z)) +
                 texture(shadow_map, vec3(corner + aside, at.z)));
#else
    float texel = frame.ground.w;
    lit += texture(shadow_map, vec3(corner + texel * vec2(-0.75, -0.25), at.z));
    lit += texture(shadow_map, vec3(corner + texel * vec2(0.25, -0.75), at.z));
    lit += texture(shadow_map, vec3(corner + texel * vec2(0.75, 0.25), at.z));
    lit += texture(shadow_map, vec3(corner + texel * vec2(-0.25, 0.75), at.z));
    lit *= 0.25;
#endif
    return mix(lit, outside, smoothstep(0.8, 1.0, max(abs(at.x), abs(at.y))));
}

vec3 ambient(vec3 normal) {
    return mix(frame.ground.rgb, mix(frame.horizon.rgb, frame.sky.rgb, 0.6), 0.5 + 0.5 * normal.y);
}

// What a surface sends to the eye. `through`: part of the light from behind that comes through.
vec3 shade(vec3 albedo, vec3 normal, vec3 place, float lit, float through) {
    float front = dot(normal, frame.to_sun.xyz);
    float direct = max(front, 0.0) + through * max(-front, 0.0);
    return albedo * (ambient(normal) + frame.sun.rgb * (direct * lit));
}

// How much of the light from all around comes to a place of a crown.
float openness(vec3 part) {
    return clamp(0.4 + 0.6 * dot(part, part), 0.4, 1.0);
}

// The normal of a leaf is bent outwards: light that comes to a crown has no sharp edge at a leaf.
vec3 leaf_normal(vec3 normal, vec3 part) {
    return normalize(normal + 2.0 * normalize(part + vec3(0.0, 1e-3, 0.0)));
}

// The same within a crown: `open` is the part of the light from all around that comes there.
vec3 shade_within(vec3 albedo, vec3 normal, float lit, float through, float open) {
    float front = dot(normal, frame.to_sun.xyz);
    float direct = max(front, 0.0) + through * max(-front, 0.0);
    // What is deep within sees less of the sun than a map of texels tells.
    return albedo * (open * ambient(normal) +
                     frame.sun.rgb * (direct * lit * (0.4 + 0.6 * open)));
}

// The part of the sun that comes to a place of a crown through the rest of it. `part`: from the
// middle, as parts of the crown's axes.
float sun_within(vec3 part) {
    return 0.12 + 0.78 * smoothstep(-0.25, 0.95, dot(part, frame.to_sun.xyz));
}

// Through the air between eye and place.
vec3 seen(vec3 radiance, vec3 place) {
    if (frame.sun.w == 0.0) {
        return radiance;
    }
    vec3 way = place - frame.eye_time.xyz;
    float away = length(way);
    // The sky just above the horizon there, as sky_colour() has it.
    float near_sun = max(dot(way, frame.to_sun.xyz) / away, 0.0);
    near_sun *= near_sun;
    near_sun *= near_sun;
    near_sun *= near_sun;
    return mix(frame.horizon.rgb + frame.sun.rgb * (0.05 * near_sun * near_sun), radiance,
               exp(-frame.sun.w * away));
}

// As the eye adapts to it, as sRGB.
vec4 displayed(vec3 radiance) {
    vec3 x = radiance * frame.sky.w;
    vec3 mapped = clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    // The powers of sRGB by roots, within 0.3 %.
    vec3 root2 = sqrt(mapped);
    vec3 root4 = sqrt(root2);
    vec3 high = 0.585122381 * root2 + 0.783140355 * root4 - 0.368262736 * sqrt(root4);
    return vec4(mix(high, mapped * 12.92, lessThan(mapped, vec3(0.0031308))), 1.0);
}
