#include "light.glsl"
#include "impostor.glsl"
layout(std430, binding = 4) readonly buffer Boxes { vec4 boxes[]; }; // what is there of each tile
layout(location = 0) in uint index; // of the tree
layout(location = 1) in vec2 range;
#ifdef BLENDS
flat out vec2 blend_range;
#endif
flat out int is_cluster;
invariant gl_Position; // depths are drawn first, and compared
out vec3 corner;      // in its layer, which goes along
out vec3 sun_map;     // of the picture's middle plane
flat out vec3 nearer; // what the depth of the picture adds to it
#ifndef SHADOW
out vec2 air;
out vec3 within;      // from the middle, as parts of the crown's axes
flat out vec3 deeper; // what the depth of the picture adds to it
flat out mat3 turn;   // of what is seen in the picture
#endif
void main() {
#ifdef BLENDS
    blend_range = range;
#endif
    TreeAt tree = tree_at(index);
    vec3 middle = middle_of(tree);
#ifdef SHADOW
    vec3 eye = frame.to_sun.xyz;
#else
    vec3 eye = normalize(frame.eye_time.xyz - middle);
#endif
    float upwards = asin(clamp(eye.y, 0.0, 1.0));
    int elevation = upwards < 0.3054 ? 0 : upwards < 0.9599 ? 1 : 2;
    float turns = (atan(eye.x, eye.z) - tree.yaw) / 6.2831853;
    is_cluster = int(forms[tree.form].pictures.y);
    // Cells stand side by side: the next view does not take over of all of them along one line.
    float early = is_cluster != 0 ? 0.8 * (tree.phase - 0.5) : 0.0;
    int view = int(floor(fract(turns) * float(kYaws) + 0.5 + early + float(kYaws))) % kYaws;
    vec3 right = normalize(vec3(eye.z, 0.0, -eye.x) + vec3(1e-6, 0.0, 0.0));
    vec3 up = cross(eye, right);
    uint tile = (uint(forms[tree.form].pictures.x) + tree.impostor) * uint(3 * kYaws) +
                uint(elevation * kYaws + view);
    vec2 at = mix(boxes[tile].xy, boxes[tile].zw, vec2(gl_VertexID & 1, gl_VertexID >> 1));
    vec3 size = tree.scale * picture_size(tree.form, elevation);
    vec3 place = middle + (2.0 * at.x - 1.0) * size.x * right + (2.0 * at.y - 1.0) * size.y * up;
    vec3 still = place;
    place = in_wind(place, tree, 0.0);
    corner = vec3((vec2(view, elevation) + at) / vec2(kYaws, 3),
                  forms[tree.form].pictures.x + float(tree.impostor));
    nearer = mat3(frame.shadow_from_world) * (eye * size.z);
#ifdef SHADOW
    sun_map = (frame.shadow_from_world * vec4(place, 1.0)).xyz;
    gl_Position = frame.shadow_from_world * vec4(place, 1.0);
#else
    vec3 axes = crown_of(tree);
    within = (still - middle) / axes;
    deeper = eye * size.z / axes;
    sun_map = in_sun_map(place, frame.to_sun.xyz);
    air = air_to(place);
    float across = tree.yaw + float(view) * (6.2831853 / float(kYaws));
    vec3 from = about_up(across, vec3(0.0, sin(kElevations[elevation]), cos(kElevations[elevation])));
    vec3 aside = about_up(across, vec3(1.0, 0.0, 0.0));
    turn = mat3(aside, cross(from, aside), from);
    gl_Position = frame.view_projection * vec4(place, 1.0);
#endif
}
