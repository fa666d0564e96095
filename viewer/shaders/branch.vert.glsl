// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "forest.glsl"
#include "motion.glsl"
// Materials; the C++ side is gl/impl/forest_buffers.cpp.
struct Material {
    vec3 colour;
    uint kind;
};
layout(std430, binding = 3) readonly buffer Materials { Material materials[]; };
// First one entry per form: index of the form's first colour, 0 for natural colours. Then the
// colours of the instances, as square roots of linear RGB.
layout(std430, binding = 5) readonly buffer BranchColours { uint branch_colours[]; };
const uint kColoured = 8u; // bit of Material.kind: one colour for all of the branch
layout(location = 0) in vec3 position;  // from the hero's origin, in units of cylinder.w
layout(location = 1) in uint material_index;
layout(location = 2) in vec2 normal;    // octahedral
layout(location = 3) in vec2 texture_coordinate;
layout(location = 4) in uint branch;    // BranchEntry: index in branches; bits from 24 on: blending
#ifdef PICK
flat out uint item;
#endif
#ifdef BLENDS
flat out vec2 blend_range;
#endif
out vec2 uv;
// Values that vary little over a triangle are computed at vertices; for leaves, all of the lighting.
#ifdef LIT_AT_CORNERS
out vec3 front; // inputs of leaf.frag.glsl
out vec3 back;
#ifdef CUT_OUT
out vec3 fog_light;
flat out uint kind;
#endif
#else
out vec3 world_normal;
flat out vec3 tint;
flat out uint kind;
out vec3 crown_position; // relative to the crown's centre, in crown axes
#endif
#if defined(BAKE)
out vec3 world_position;
#elif !defined(LIT_AT_CORNERS)
out vec3 shadow_position;
out vec2 fog;
out vec3 from_eye;
#endif
#ifdef MOVES
out vec3 moved; // world position in the previous picture minus that in this one, m
#endif
void main() {
    Branch at = branches[branch & 0xFFFFFFu];
#ifdef BLENDS
    float weight = float(branch >> 24 & 127u) / 127.0;
    blend_range = (branch >> 31) != 0u ? vec2(weight, 1.0) : vec2(0.0, weight);
#endif
#ifdef PICK
    item = branch & 0xFFFFFFu;
#endif
    UnpackedTree tree = unpack_tree(at.rotation_mesh_tree.w);
    vec4 turn = normalize(vec4(unpackSnorm2x16(at.rotation_mesh_tree.x),
                               unpackSnorm2x16(at.rotation_mesh_tree.y)));
    float size = at.position_scale.w * forms[tree.form].cylinder.w;
    vec3 world = at.position_scale.xyz + rotate(turn, size * position);
    vec3 in_crown = (world - crown_centre(tree)) / crown_axes(tree);
    vec3 shadow_place = world; // position for the shadow map, which shows the trees without wind
#ifdef CUT_OUT
    const float kFlutter = 1.0;
#else
    const float kFlutter = 0.0;
#endif
    world = swayed(world, tree, kFlutter);
#ifdef MOVES
    moved = swayed_before(shadow_place, tree, kFlutter) - world;
#endif
#if QUALITY > 1
    shadow_place = world; // with QUALITY 2 the shadow map shows the trees in the wind
#endif
    vec3 surface = rotate(turn, octahedral(normal));
    uv = texture_coordinate;
    Material material = materials[material_index];
    uint first_colour = branch_colours[tree.form];
    if (first_colour != 0u) {
        vec3 root = unpackUnorm4x8(branch_colours[first_colour + at.rotation_mesh_tree.z]).rgb;
        material.colour = root * root;
        material.kind = (material.kind & ~1u) | kColoured;
    }
#ifdef LIT_AT_CORNERS
    float lit =
        sunlight_at(shadow_map_position(shadow_place, frame.to_sun.xyz), crown_sunlight(in_crown));
    lit = sunlight_near(world, frame.to_sun.xyz, lit);
    float visibility = ambient_visibility(in_crown);
    vec2 fog = fog_to(world);
    vec3 fogged_albedo = fog.y * material.colour;
    float translucency = float(material.kind >> 8u & 0x1FFu) / 256.0;
    front = shade_crown(fogged_albedo, leaf_normal(surface, in_crown), lit, translucency,
                        visibility);
    back = shade_crown(fogged_albedo, leaf_normal(-surface, in_crown), lit, translucency,
                       visibility);
    vec3 fog_only = apply_fog(vec3(0.0), fog);
#if QUALITY > 0
    // Light that the side towards the eye reflects has the colour of the light.
    vec3 to_eye = normalize(frame.eye_time.xyz - world);
    vec3 shown = dot(surface, to_eye) < 0.0 ? -surface : surface;
    fog_only += fog.y * gloss(shown, to_eye, float(material.kind >> 20u & 0xFFu) / 255.0,
                              lit * (0.4 + 0.6 * visibility), visibility);
#endif
#ifdef CUT_OUT
    fog_light = fog_only;
    kind = material.kind;
#else
    front = tone_mapped(front + fog_only).rgb;
    back = tone_mapped(back + fog_only).rgb;
#endif
#else
    world_normal = surface;
    tint = material.colour;
    kind = material.kind;
    crown_position = in_crown;
#endif
#if defined(BAKE)
    world_position = world;
#elif !defined(LIT_AT_CORNERS)
    shadow_position = shadow_map_position(shadow_place, frame.to_sun.xyz);
    fog = fog_to(world);
    from_eye = world - frame.eye_time.xyz;
#endif
    gl_Position = frame.view_projection * vec4(world, 1.0);
}
