// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "motion.glsl"
#include "crowns.glsl"
#include "ground_look.glsl"
// Blades of grass around the eye: an instance per cell of a lattice that is fixed in the world. Each
// cell has its own random numbers, so nothing repeats. leaf.frag.glsl draws them.
layout(binding = 1) uniform sampler2DArray heights; // as in terrain.vert.glsl
layout(location = 0) uniform ivec2 heights_origin;  // first texel of level 0
layout(location = 1) uniform ivec4 lattice; // xy: first cell from the origin; zw: origin, in cells
layout(location = 2) uniform ivec2 sides;   // x: cells along a side; y: blades per cell
const float kCell = 0.32;      // m; TerrainPass has it too
const float kHeightCell = 0.5; // m, of level 0
out vec3 front;
out vec3 back;
#ifdef MOVES
out vec3 moved; // world position in the previous picture minus that in this one, m
#endif

uint mixed(uint bits) { // a step of PCG (O'Neill 2014)
    bits = bits * 747796405u + 2891336453u;
    bits = ((bits >> ((bits >> 28u) + 4u)) ^ bits) * 277803737u;
    return (bits >> 22u) ^ bits;
}
float drawn(inout uint state) {
    state = mixed(state);
    return float(state >> 8) / 16777216.0;
}
float height_of(ivec2 at) {
    return texelFetch(heights, ivec3(at - heights_origin, 0), 0).r;
}

void main() {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0); // clipped
    front = back = vec3(0.0);
#ifdef MOVES
    moved = vec3(0.0);
#endif
    ivec2 cell = lattice.xy + ivec2(gl_InstanceID % sides.x, gl_InstanceID / sides.x);
    uvec2 world_cell = uvec2(cell + lattice.zw);
    int blade = gl_VertexID / 9;
    uint state = mixed(world_cell.x + mixed(world_cell.y)) + uint(blade);
    // Blades stand in clumps.
    uint clump = mixed(world_cell.x + mixed(world_cell.y));
    vec2 middle = vec2(drawn(clump), drawn(clump));
    vec2 place = (vec2(cell) + middle + 0.45 * (vec2(drawn(state), drawn(state)) - 0.5)) * kCell;
    float reach = 0.5 * kCell * float(sides.x);
    float away_flat = distance(place, frame.eye_time.xz);
    float size = 1.0 - smoothstep(0.55, 1.0, away_flat / reach);
    if (size <= 0.0) {
        return;
    }
    vec2 at = place / kHeightCell;
    ivec2 corner = ivec2(floor(at));
    vec2 part = at - vec2(corner);
    float h00 = height_of(corner), h10 = height_of(corner + ivec2(1, 0));
    float h01 = height_of(corner + ivec2(0, 1)), h11 = height_of(corner + ivec2(1, 1));
    vec3 root = vec3(place.x, mix(mix(h00, h10, part.x), mix(h01, h11, part.x), part.y), place.y);
    vec3 up = normalize(vec3(h00 - h10, kHeightCell, h00 - h01));
    float away = distance(root, frame.eye_time.xyz);
    GroundLook look = ground_look(place, away, 1.0 - up.y, widest_noise(place, 0.0));
    vec2 openness = openness_at(place);
    float chance = drawn(state);
    if (chance > (1.0 - look.bare) * openness.x * openness.x) {
        return;
    }
    // A bent blade of three triangles.
    const int kPoints[9] = int[](0, 1, 2, 1, 3, 2, 2, 3, 4);
    int point = kPoints[gl_VertexID % 9];
    float along = 0.5 * float(point / 2);
    float side = point == 4 ? 0.0 : float(point % 2) - 0.5;
    float angle = 6.2831853 * drawn(state);
    vec3 lean = vec3(sin(angle), 0.0, cos(angle));
    float turned = angle + 1.5708 + 0.8 * (drawn(state) - 0.5);
    vec3 across = vec3(sin(turned), 0.0, cos(turned));
    float height = size * mix(0.08, 0.30, drawn(state) * (0.4 + 0.6 * look.middle));
    float width = (0.009 + 0.006 * drawn(state)) * (1.0 + 0.12 * away) * (1.0 - 0.45 * along);
    float bend = mix(0.2, 0.9, drawn(state));
    float phase = 0.6 * (place.x + place.y) + angle;
    vec3 push = 0.03 * frame.wind.xyz * (1.0 + sin(2.3 * frame.eye_time.w + phase));
#ifdef MOVES
    vec3 push_before =
        0.03 * frame.wind_before.xyz * (1.0 + sin(2.3 * frame.time_before.x + phase));
    moved = height * along * along * (push_before - push);
#endif
    vec3 world = root + across * (side * width) +
                 height * (up * (along * (1.0 - 0.25 * bend * along)) +
                           (bend * lean + push) * (along * along));
    vec3 normal = normalize(up + 0.5 * lean);
    float lit = sunlight_near(world, up, sunlight_at(shadow_map_position(world, up), 1.0));
    float tint = 0.8 + 0.5 * drawn(state);
    vec3 albedo = grass_colour(look.middle) * tint * mix(0.7, 2.0, along);
    albedo.r *= 1.0 + 0.35 * drawn(state);
    float toward = dot(normal, frame.to_sun.xyz);
    vec3 light = ambient(normal) * ambient_left(openness) * mix(0.6, 1.0, along) +
                 frame.sun.rgb * (lit * (max(toward, 0.0) + 0.4 * max(-toward, 0.0)));
    front = back = tone_mapped(apply_fog(albedo * light, fog_to(world))).rgb;
    gl_Position = frame.view_projection * vec4(world, 1.0);
}
