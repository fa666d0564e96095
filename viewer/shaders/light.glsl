#include "frame.glsl"
layout(binding = 0) uniform sampler2DShadow shadow_map;

vec3 sky_colour(vec3 direction) {
    float up = max(direction.y, 0.0);
    vec3 colour = mix(frame.horizon.rgb, frame.sky.rgb, 1.0 - pow(1.0 - up, 3.0));
    float near_sun = max(dot(direction, frame.to_sun.xyz), 0.0);
    return colour + frame.sun.rgb * (0.05 * pow(near_sun, 16.0) + 0.25 * pow(near_sun, 400.0));
}

// How much of the sun is seen from a place, 0 to 1; `normal` moves the place off its surface.
// ONE_TAP: one look at the map, which filters four texels, where pictures are filled many times.
float sunlight(vec3 place, vec3 normal) {
    if (frame.to_sun.w == 0.0) {
        return 1.0;
    }
    vec4 at = frame.shadow_from_world * vec4(place + normal * (1.5 * frame.horizon.w), 1.0);
    vec2 corner = at.xy * 0.5 + 0.5;
    if (any(lessThan(corner, vec2(0.0))) || any(greaterThan(corner, vec2(1.0))) || at.z > 1.0) {
        return 1.0;
    }
#ifdef ONE_TAP
    return texture(shadow_map, vec3(corner, at.z));
#else
    float texel = frame.ground.w;
    float lit = 0.0;
    lit += texture(shadow_map, vec3(corner + texel * vec2(-0.75, -0.25), at.z));
    lit += texture(shadow_map, vec3(corner + texel * vec2(0.25, -0.75), at.z));
    lit += texture(shadow_map, vec3(corner + texel * vec2(0.75, 0.25), at.z));
    lit += texture(shadow_map, vec3(corner + texel * vec2(-0.25, 0.75), at.z));
    return 0.25 * lit;
#endif
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
