#include "light.glsl"
layout(binding = 2) uniform sampler2D noise; // repeats
in vec3 place;
in vec3 across;
out vec4 colour;
// Grass where it is level, earth where it is steep or bare, in patches.
void main() {
    vec3 up = normalize(across);
    vec4 coarse = texture(noise, place.xz * (1.0 / 173.0));
    vec4 close = texture(noise, place.xz * (1.0 / 7.7));
    float wide = coarse.r;
    float middle = 0.5 * (coarse.g + close.r);
    float fine = close.b;
    float steep = 1.0 - up.y;
    float bare = smoothstep(0.42, 0.72, 0.55 * wide + 0.35 * middle + 0.25 * fine - 0.1 + 2.0 * steep);
    vec3 grass = mix(vec3(0.020, 0.042, 0.009), vec3(0.048, 0.064, 0.018), middle);
    vec3 earth = mix(vec3(0.045, 0.034, 0.022), vec3(0.085, 0.066, 0.044), close.g);
    vec3 albedo = mix(grass, earth, bare) * (0.7 + 0.6 * fine);
    vec3 normal = normalize(up + 0.4 * vec3(fine - 0.5, 0.0, close.g - 0.5));
    float lit = sunlight(place, up);
    colour = displayed(seen(shade(albedo, normal, place, lit, 0.0), place));
}
