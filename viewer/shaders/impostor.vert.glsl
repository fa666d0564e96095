// SPDX-License-Identifier: MIT
#include "light.glsl"
#include "impostor.glsl"
#include "motion.glsl"
// Bounds of the opaque texels of each tile, 0 to 1: low corner (xy), high corner (zw).
layout(std430, binding = 4) readonly buffer Boxes { vec4 boxes[]; };
layout(location = 0) in uint index; // index of the tree or cluster
layout(location = 1) in vec2 range;
#ifdef BLENDS
flat out vec2 blend_range;
#endif
flat out int is_cluster;
#ifdef PICK
flat out uint item;
#endif
#if QUALITY > 0 && !defined(SHADOW)
#define TURNS
// The second nearest view. x: offset of its tile in the atlas from the tile of the nearest view, in
// texture coordinates; yz: range of the dither thresholds of its pixels.
flat out vec3 next_view;
#ifndef DEPTH
flat out mat3 next_world_from_impostor;
#endif
#endif
invariant gl_Position; // the colour pass compares depths
out vec3 layer_uv;              // uv; layer
out vec3 plane_shadow_position; // at the middle plane of the impostor
flat out vec3 shadow_step;      // per unit of depth
#ifndef SHADOW
out vec2 fog;
out vec3 plane_crown_position;       // at the middle plane, in axes of the crown
flat out vec3 crown_step;            // per unit of depth
flat out mat3 world_from_impostor;   // for normals
#endif
#ifdef MOVES
out vec3 moved; // world position in the previous picture minus that in this one, m
#endif
// Axes of a view, for normals.
mat3 axes_of(float yaw, int view, int elevation) {
    float tile_yaw = yaw + float(view) * (6.2831853 / float(kYaws));
    vec3 from = rotate_y(tile_yaw, vec3(0.0, sin(kElevations[elevation]),
                                        cos(kElevations[elevation])));
    vec3 aside = rotate_y(tile_yaw, vec3(1.0, 0.0, 0.0));
    return mat3(aside, cross(from, aside), from);
}
void main() {
#ifdef BLENDS
    blend_range = range;
#endif
#ifdef PICK
    item = index;
#endif
    UnpackedTree tree = unpack_tree(index);
    vec3 centre = crown_centre(tree);
#ifdef SHADOW
    vec3 to_eye = frame.to_sun.xyz;
#else
    vec3 to_eye = normalize(frame.eye_time.xyz - centre);
#endif
    is_cluster = int(forms[tree.form].layers.y);
    float upwards = asin(clamp(to_eye.y, 0.0, 1.0));
#ifndef SHADOW
    // Trees change elevations at shifted angles, so that the changes form no visible line.
    upwards += is_cluster != 0 ? 0.0 : kElevationShift * (tree.phase - 0.5);
#endif
    int elevation = upwards < 0.3054 ? 0 : upwards < 0.9599 ? 1 : 2;
    float turns = (atan(to_eye.x, to_eye.z) - tree.yaw) / 6.2831853;
    // Adjacent clusters change views at shifted angles, so that the changes form no visible line.
    float view_shift = is_cluster != 0 ? 0.8 * (tree.phase - 0.5) : 0.0;
    float views = fract(turns) * float(kYaws) + 0.5 + view_shift + float(kYaws);
    int view = int(floor(views)) % kYaws;
    vec3 right = normalize(vec3(to_eye.z, 0.0, -to_eye.x) + vec3(1e-6, 0.0, 0.0));
    vec3 up = cross(to_eye, right);
    uint tile = (uint(forms[tree.form].layers.x) + tree.impostor) * uint(3 * kYaws) +
                uint(elevation * kYaws + view);
    vec4 box = boxes[tile];
#ifdef TURNS
    // Near the limit between two views both are drawn, each in a part of the pixels.
    const float kBlend = 0.1; // fraction of the width of a view, on each side of its limits
    float from_limit = fract(views + 0.5) - 0.5;
    int next = (view + (from_limit < 0.0 ? 1 : kYaws - 1)) % kYaws;
    float share = max(0.5 - 0.5 * abs(from_limit) / kBlend, 0.0);
    // The view that follows at larger angles has the higher thresholds, so that no pixel changes
    // where the views change places.
    next_view = vec3(float(next - view) / float(kYaws),
                     from_limit < 0.0 ? vec2(1.0 - share, 1.0) : vec2(0.0, share));
    if (share > 0.0) {
        vec4 other = boxes[tile + uint(next) - uint(view)];
        box = vec4(min(box.xy, other.xy), max(box.zw, other.zw));
    }
#endif
    vec2 at = mix(box.xy, box.zw, vec2(gl_VertexID & 1, gl_VertexID >> 1));
    vec3 size = tree.scale * picture_size(tree.form, elevation);
    vec3 world_position = centre + (2.0 * at.x - 1.0) * size.x * right +
                          (2.0 * at.y - 1.0) * size.y * up;
    vec3 unswayed = world_position;
    world_position = swayed(unswayed, tree, 0.0);
#ifdef MOVES
    moved = swayed_before(unswayed, tree, 0.0) - world_position;
#endif
    // Place for the shadow map: with QUALITY 2 it shows the trees in the wind, else without wind.
#if QUALITY > 1
    vec3 shadow_place = world_position;
#else
    vec3 shadow_place = unswayed;
#endif
    layer_uv = vec3((vec2(view, elevation) + at) / vec2(kYaws, 3),
                  forms[tree.form].layers.x + float(tree.impostor));
    shadow_step = mat3(frame.shadow_from_world) * (to_eye * size.z);
#ifdef SHADOW
    plane_shadow_position = (frame.shadow_from_world * vec4(shadow_place, 1.0)).xyz;
    gl_Position = frame.shadow_from_world * vec4(shadow_place, 1.0);
#else
    vec3 axes = crown_axes(tree);
    plane_crown_position = (unswayed - centre) / axes;
    crown_step = to_eye * size.z / axes;
    plane_shadow_position = shadow_map_position(shadow_place, frame.to_sun.xyz);
    fog = fog_to(world_position);
    world_from_impostor = axes_of(tree.yaw, view, elevation);
#if defined(TURNS) && !defined(DEPTH)
    next_world_from_impostor = axes_of(tree.yaw, next, elevation);
#endif
    gl_Position = frame.view_projection * vec4(world_position, 1.0);
#endif
}
