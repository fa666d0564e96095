// SPDX-License-Identifier: MIT
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

// Position in the shadow map, moved along `offset` against self-shadowing.
vec3 shadow_map_position(vec3 world_position, vec3 offset) {
    vec3 moved = world_position + offset * (1.5 * frame.horizon.w);
    return (frame.shadow_from_world * vec4(moved, 1.0)).xyz;
}

// Shadows whose edges widen with the distance from the caster, as the disc of the sun makes them
// (Fernando 2005, "Percentage-Closer Soft Shadows"): the mean depth of the casters around the place
// gives the width of the edge. `at`: position in the map, 0 to 1; `depth`: depth of the map / width.
#if QUALITY > 1
const float kSunSpread = 0.00465; // tangent of half the angle that the sun fills
const int kDepthTaps = 12;
const int kSoftTaps = 20;
// Place number `index` of `count` places that fill a unit disc evenly (Vogel 1979). `turn`: angle.
vec2 disc_place(int index, int count, float turn) {
    float angle = 2.3999632 * float(index) + turn;
    return sqrt((float(index) + 0.5) / float(count)) * vec2(cos(angle), sin(angle));
}
float soft_sunlight(sampler2DShadow map, sampler2D depths, vec3 at, float depth) {
    float texel = frame.ground.w;
    float spread = kSunSpread * depth; // radius of the edge per depth
    // Each place turns the disc by another angle; else the taps would show copies of an edge.
    vec2 cell = floor(at.xy / texel * 2.0);
    float turn = 6.2831853 * fract(52.9829189 * fract(dot(cell, vec2(0.06711056, 0.00583715))));
    float search = max(spread * at.z, 2.0 * texel);
    float sum = 0.0, count = 0.0;
    for (int i = 0; i < kDepthTaps; ++i) {
        float caster =
            textureLod(depths, at.xy + search * disc_place(i, kDepthTaps, turn), 0.0).r;
        if (caster < at.z) {
            sum += caster;
            count += 1.0;
        }
    }
    if (count == 0.0) {
        return 1.0;
    }
    float radius = max(spread * (at.z - sum / count), 1.25 * texel);
    // Far from the middle of the disc the surface itself may be nearer to the sun.
    float receiver = at.z - 0.5 * radius / depth;
    float lit = 0.0;
    for (int i = 0; i < kSoftTaps; ++i) {
        lit += texture(map, vec3(at.xy + radius * disc_place(i, kSoftTaps, turn), receiver));
    }
    return lit / float(kSoftTaps);
}
#if !defined(ONE_TAP) && !defined(TWO_TAPS)
layout(binding = 12) uniform sampler2D shadow_depths;
#endif
#endif

// Visible fraction of the sun at a position in the shadow map. `outside`: value outside the map.
// Reads the map four times, once with ONE_TAP, twice with TWO_TAPS; each read filters four texels.
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
#elif QUALITY > 1
    lit = soft_sunlight(shadow_map, shadow_depths, vec3(corner, at.z), 1.0);
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

// Visible fraction of the sun at a place, from the shadow maps near the eye. `offset`: direction in
// which the place is moved against self-shadowing; `lit`: value of the map of the whole view.
#if QUALITY > 0
layout(binding = 7) uniform sampler2DShadow nearest_map;
layout(binding = 8) uniform sampler2DShadow near_map;
#if QUALITY > 1
layout(binding = 10) uniform sampler2D nearest_depths;
layout(binding = 11) uniform sampler2D near_depths;
const float kMapDepths[2] = float[](4.0, 1.0); // depth / width; kNearMapSpecs has them too
#endif
float sunlight_of_map(sampler2DShadow map, int which, vec3 place, vec3 offset, float lit) {
    vec3 moved = place + offset * (1.5 * frame.near_maps[which]);
    vec3 at = (frame.near_from_world[which] * vec4(moved, 1.0)).xyz;
    float edge = max(abs(at.x), abs(at.y));
    if (edge >= 1.0 || at.z <= 0.0 || at.z >= 1.0) {
        return lit;
    }
#if QUALITY > 1
    vec3 corner = vec3(at.xy * 0.5 + 0.5, at.z);
    float sunlit = which == 0 ? soft_sunlight(map, nearest_depths, corner, kMapDepths[0])
                              : soft_sunlight(map, near_depths, corner, kMapDepths[1]);
    return mix(sunlit, lit, smoothstep(0.8, 1.0, edge));
#else
    float sum = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            vec2 aside = ((which == 0 ? 2.5 : 1.5) * frame.ground.w) * vec2(x, y);
            sum += texture(map, vec3(at.xy * 0.5 + 0.5 + aside, at.z));
        }
    }
    return mix(sum / 9.0, lit, smoothstep(0.8, 1.0, edge));
#endif
}
float sunlight_near(vec3 place, vec3 offset, float lit) {
    if (frame.near_maps.z == 0.0) {
        return lit;
    }
    return sunlight_of_map(nearest_map, 0, place, offset,
                           sunlight_of_map(near_map, 1, place, offset, lit));
}
#else
float sunlight_near(vec3 place, vec3 offset, float lit) {
    return lit;
}
#endif

// Visible fraction of the sun at a surface; the position is moved along its normal.
float sunlight(vec3 world_position, vec3 normal, float outside) {
    return sunlight_at(shadow_map_position(world_position, normal), outside);
}

vec3 ambient(vec3 normal) {
    return mix(frame.ground.rgb, mix(frame.horizon.rgb, frame.sky.rgb, 0.6), 0.5 + 0.5 * normal.y);
}

// Radiance that the surface itself reflects: of the sun by GGX (Walter, Marschner, Li, Torrance
// 2007), of the sky by a fit of its integral (Karis 2013, "Physically Based Shading on Mobile").
// `to_eye`: unit vector; `roughness`: 0, a mirror, to 1.
vec3 gloss(vec3 normal, vec3 to_eye, float roughness, float lit, float visibility) {
    const float kHeadOn = 0.04; // reflected part of light from straight ahead
    float n_eye = max(dot(normal, to_eye), 1e-3);
    float n_sun = max(dot(normal, frame.to_sun.xyz), 0.0);
    vec3 between = normalize(to_eye + frame.to_sun.xyz + vec3(1e-6));
    float n_between = max(dot(normal, between), 0.0);
    float alpha = max(roughness * roughness, 2e-3);
    float spread = n_between * n_between * (alpha * alpha - 1.0) + 1.0;
    float grazing = 1.0 - max(dot(to_eye, between), 0.0);
    float grazing2 = grazing * grazing;
    float fresnel = kHeadOn + (1.0 - kHeadOn) * grazing2 * grazing2 * grazing;
    float masking = 0.5 / mix(2.0 * n_sun * n_eye, n_sun + n_eye, alpha);
    // frame.sun is the irradiance of the sun divided by pi, as in shade().
    float of_sun = alpha * alpha / (spread * spread) * masking * fresnel * n_sun * lit;
    vec4 fit = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float rim = min(fit.x * fit.x, exp2(-9.28 * n_eye)) * fit.x + fit.y;
    float of_sky = kHeadOn * (fit.z - 1.04 * rim) + fit.w + 1.04 * rim;
    return frame.sun.rgb * min(of_sun, 8.0) +
           ambient(reflect(-to_eye, normal)) * (max(of_sky, 0.0) * visibility);
}

// Radiance of a surface. `translucency`: fraction of the light from behind that passes through.
vec3 shade(vec3 albedo, vec3 normal, vec3 world_position, float lit, float translucency) {
    float front = dot(normal, frame.to_sun.xyz);
    float direct = max(front, 0.0) + translucency * max(-front, 0.0);
    return albedo * (ambient(normal) + frame.sun.rgb * (direct * lit));
}

// Fraction of the ambient light that reaches a place in a crown. `crown_position`: the place relative
// to the centre of the crown, in half axes of the crown.
float ambient_visibility(vec3 crown_position) {
    return clamp(0.4 + 0.6 * dot(crown_position, crown_position), 0.4, 1.0);
}

// Normal bent outward from the crown, so that light has no sharp edges at single leaves.
vec3 leaf_normal(vec3 normal, vec3 crown_position) {
    return normalize(normal + 2.0 * normalize(crown_position + vec3(0.0, 1e-3, 0.0)));
}

// Radiance of a surface in a crown. `visibility`: ambient_visibility().
vec3 shade_crown(vec3 albedo, vec3 normal, float lit, float translucency, float visibility) {
    float front = dot(normal, frame.to_sun.xyz);
    float direct = max(front, 0.0) + translucency * max(-front, 0.0);
    // Deep in the crown less sunlight arrives than the coarse shadow map shows.
    return albedo * (visibility * ambient(normal) +
                     frame.sun.rgb * (direct * lit * (0.4 + 0.6 * visibility)));
}

// Fraction of the sunlight that reaches a place in a crown through the rest of the crown.
// `crown_position`: relative to the centre, in axes of the crown. Fitted to the mean of the shadow map
// at such places in a wood, over views from the ground (lower means) and from above.
float crown_sunlight(vec3 crown_position) {
    return clamp(0.58 + 0.45 * dot(crown_position, frame.to_sun.xyz), 0.12, 0.97);
}

// Fog between the eye and a position. x: share of scattered sunlight, y: transmittance.
vec2 fog_to(vec3 world_position) {
    vec3 from_eye = world_position - frame.eye_time.xyz;
    float away = length(from_eye);
    // The wide glow around the sun, as in sky_colour() just above the horizon.
    float near_sun = max(dot(from_eye, frame.to_sun.xyz) / max(away, 1e-6), 0.0);
    near_sun *= near_sun;
    near_sun *= near_sun;
    near_sun *= near_sun;
    return vec2(0.05 * near_sun * near_sun, exp(-frame.sun.w * away));
}
vec3 apply_fog(vec3 radiance, vec2 fog) {
    vec3 air = frame.horizon.rgb + frame.sun.rgb * fog.x;
#if QUALITY > 0
    air *= frame.near_maps.w;
#endif
    return mix(air, radiance, fog.y);
}
vec3 fogged(vec3 radiance, vec3 world_position) {
    return apply_fog(radiance, fog_to(world_position));
}

// Exposure, tone mapping and sRGB. The curve after the square root is within 0.0035 of the filmic
// (2.51 x^2 + 0.03 x) / (2.43 x^2 + 0.59 x + 0.14) followed by the sRGB transfer function.
vec4 tone_mapped(vec3 radiance) {
    vec3 root = sqrt(radiance * frame.sky.w);
    return vec4(clamp(root * (5.954052 * root - 0.104695) /
                          (1.0 + root * (5.964331 * root - 0.525280)),
                      0.0, 1.0),
                1.0);
}
