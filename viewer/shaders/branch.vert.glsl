#include "light.glsl"
#include "forest.glsl"
// What parts of a tree look like; the C++ side is gl/forest_buffers.cpp.
struct Look {
    vec3 colour;
    uint kind;
};
layout(std430, binding = 3) readonly buffer Looks { Look looks[]; };
layout(location = 0) in vec3 position;  // in the heroes' box
layout(location = 1) in uint material;
layout(location = 2) in vec2 normal;    // octahedral
layout(location = 3) in vec2 texture_coordinate;
layout(location = 4) in uint branch;    // in branches; the upper 8 bits: the part of it
#ifdef BLENDS
flat out vec2 blend_range;
#endif
out vec2 uv;
// What varies little along a triangle is found at its corners: of leaves, all light.
#ifdef LIT_AT_CORNERS
out vec3 front; // what leaf.frag.glsl asks for
out vec3 back;
#ifdef CUT_OUT
out vec3 haze;
#endif
#else
out vec3 across;
flat out vec3 tint;
flat out uint kind;
out vec3 part; // from the middle of the crown, as parts of its axes
#endif
#if defined(BAKE)
out vec3 place;
#elif !defined(LIT_AT_CORNERS)
out vec3 sun_map;
out vec2 air;
#endif
void main() {
    Branch at = branches[branch & 0xFFFFFFu];
#ifdef BLENDS
    blend_range = vec2(0.0, float(branch >> 24) / 255.0);
#endif
    TreeAt tree = tree_at(at.turn.w);
    vec4 turn = vec4(unpackSnorm2x16(at.turn.x), unpackSnorm2x16(at.turn.y));
    turn = normalize(turn);
    float size = at.place_scale.w * forms[tree.form].cylinder.w;
    vec3 world = at.place_scale.xyz + turned(turn, size * position);
    vec3 in_crown = (world - middle_of(tree)) / crown_of(tree);
#ifdef CUT_OUT
    world = in_wind(world, tree, 1.0);
#else
    world = in_wind(world, tree, 0.0);
#endif
    vec3 surface = turned(turn, octahedral(normal));
    uv = texture_coordinate;
    Look look = looks[material];
#ifdef LIT_AT_CORNERS
    float lit = sunlight_at(in_sun_map(world, frame.to_sun.xyz), sun_within(in_crown));
    float open = openness(in_crown);
    vec2 air = air_to(world);
    vec3 seen_of = air.y * look.colour;
    front = shade_within(seen_of, leaf_normal(surface, in_crown), lit, 0.5, open);
    back = shade_within(seen_of, leaf_normal(-surface, in_crown), lit, 0.5, open);
    vec3 air_alone = through_air(vec3(0.0), air);
#ifdef CUT_OUT
    haze = air_alone;
#else
    front = displayed(front + air_alone).rgb;
    back = displayed(back + air_alone).rgb;
#endif
#else
    across = surface;
    tint = look.colour;
    kind = look.kind;
    part = in_crown;
#endif
#if defined(BAKE)
    place = world;
#elif !defined(LIT_AT_CORNERS)
    sun_map = in_sun_map(world, frame.to_sun.xyz);
    air = air_to(world);
#endif
    gl_Position = frame.view_projection * vec4(world, 1.0);
}
