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
    float near64 = near16 * near16 * near16 * near16;
    float near256 = near64 * near64 * near64 * near64;
    return colour + frame.sun.rgb * (0.05 * near16 + 0.25 * near256 * near64 * near64);
}

// Where a place is looked for in the sun's map: a little nearer to the sun.
vec3 in_sun_map(vec3 place, vec3 nearer) {
    return (frame.shadow_from_world * vec4(place + nearer * (1.5 * frame.horizon.w), 1.0)).xyz;
}

// How much of the sun is seen from a place of its map, 0 to 1.
// ONE_TAP, TWO_TAPS: fewer looks at the map, each of which filters four texels.
// `outside`: what is told where the map does not reach.
float sunlight_at(vec3 at, float outside) {
    if (frame.to_sun.w == 0.0) {
        return 1.0;
    }
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

// The same for a surface; its normal moves the place off it.
float sunlight(vec3 place, vec3 normal, float outside) {
    return sunlight_at(in_sun_map(place, normal), outside);
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
// middle, as parts of the crown's axes. About the mean of what the sun's map has at such places of
// a wood, seen from the ground (where it is less) and from above.
float sun_within(vec3 part) {
    return clamp(0.58 + 0.45 * dot(part, frame.to_sun.xyz), 0.12, 0.97);
}

// The air between eye and place: how much of the sun's glow it has, and what comes through it.
vec2 air_to(vec3 place) {
    vec3 way = place - frame.eye_time.xyz;
    float away = length(way);
    // The sky just above the horizon there, as sky_colour() has it.
    float near_sun = max(dot(way, frame.to_sun.xyz) / max(away, 1e-6), 0.0);
    near_sun *= near_sun;
    near_sun *= near_sun;
    near_sun *= near_sun;
    return vec2(0.05 * near_sun * near_sun, exp(-frame.sun.w * away));
}
vec3 through_air(vec3 radiance, vec2 air) {
    return mix(frame.horizon.rgb + frame.sun.rgb * air.x, radiance, air.y);
}
vec3 seen(vec3 radiance, vec3 place) {
    return through_air(radiance, air_to(place));
}

// As the eye adapts to it, as sRGB. What follows the square root is one curve for both, within
// 0.0035: tone mapping by (2.51 x^2 + 0.03 x) / (2.43 x^2 + 0.59 x + 0.14), as is common for film,
// and the powers of sRGB.
vec4 displayed(vec3 radiance) {
    vec3 root = sqrt(radiance * frame.sky.w);
    return vec4(clamp(root * (5.954052 * root - 0.104695) /
                          (1.0 + root * (5.964331 * root - 0.525280)),
                      0.0, 1.0),
                1.0);
}
