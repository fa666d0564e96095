#include "frame.glsl"
layout(binding = 0) uniform sampler2DShadow shadow_map;

vec3 sky_colour(vec3 direction) {
    float up = max(direction.y, 0.0);
    vec3 colour = mix(frame.horizon.rgb, frame.sky.rgb, 1.0 - pow(1.0 - up, 3.0));
    float near_sun = max(dot(direction, frame.to_sun.xyz), 0.0);
    return colour + frame.sun.rgb * (0.05 * pow(near_sun, 16.0) + 0.25 * pow(near_sun, 400.0));
}

// How much of the sun is seen from a place, 0 to 1; `normal` moves the place off its surface.
float sunlight(vec3 place, vec3 normal) {
    if (frame.to_sun.w == 0.0) {
        return 1.0;
    }
    vec4 at = frame.shadow_from_world * vec4(place, 1.0);
    vec2 texel = 1.0 / vec2(textureSize(shadow_map, 0));
    float texel_size = 2.0 * texel.x / length(vec3(frame.shadow_from_world[0].x,
                                                   frame.shadow_from_world[1].x,
                                                   frame.shadow_from_world[2].x));
    at = frame.shadow_from_world * vec4(place + normal * (1.5 * texel_size), 1.0);
    vec2 corner = at.xy * 0.5 + 0.5;
    if (any(lessThan(corner, vec2(0.0))) || any(greaterThan(corner, vec2(1.0))) || at.z > 1.0) {
        return 1.0;
    }
    float lit = 0.0;
    lit += texture(shadow_map, vec3(corner + texel * vec2(-0.75, -0.25), at.z));
    lit += texture(shadow_map, vec3(corner + texel * vec2(0.25, -0.75), at.z));
    lit += texture(shadow_map, vec3(corner + texel * vec2(0.75, 0.25), at.z));
    lit += texture(shadow_map, vec3(corner + texel * vec2(-0.25, 0.75), at.z));
    return 0.25 * lit;
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

// Through the air between eye and place, then as the eye adapts to it, as sRGB.
vec3 seen(vec3 radiance, vec3 place) {
    vec3 way = place - frame.eye_time.xyz;
    float clear = exp(-frame.sun.w * length(way));
    vec3 flat_way = normalize(vec3(way.x, max(way.y, 0.0), way.z) + vec3(1e-6, 0.0, 0.0));
    return mix(sky_colour(flat_way), radiance, clear);
}

vec4 displayed(vec3 radiance) {
    vec3 x = radiance * frame.sky.w;
    vec3 mapped = clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
    vec3 low = mapped * 12.92;
    vec3 high = 1.055 * pow(mapped, vec3(1.0 / 2.4)) - 0.055;
    return vec4(mix(high, low, lessThan(mapped, vec3(0.0031308))), 1.0);
}
