#include "forest.glsl"
layout(location = 0) in vec3 position;  // in the heroes' box
layout(location = 1) in uint material;
layout(location = 2) in vec2 normal;    // octahedral
layout(location = 3) in vec2 texture_coordinate;
layout(location = 4) in uint branch;    // in branches
out vec3 place;
out vec3 across;
out vec2 uv;
flat out uint look;
out vec3 part; // from the middle of the crown, as parts of its axes
void main() {
    Branch at = branches[branch];
    TreeAt tree = tree_at(at.turn.w);
    vec4 turn = vec4(unpackSnorm2x16(at.turn.x), unpackSnorm2x16(at.turn.y));
    turn = normalize(turn);
    float size = at.place_scale.w * forms[tree.form].cylinder.w;
    place = at.place_scale.xyz + turned(turn, size * position);
    part = (place - middle_of(tree)) / crown_of(tree);
#ifdef CUT_OUT
    place = in_wind(place, tree, 1.0);
#else
    place = in_wind(place, tree, 0.0);
#endif
    across = turned(turn, octahedral(normal));
    uv = texture_coordinate;
    look = material;
#ifdef SHADOW
    gl_Position = frame.shadow_from_world * vec4(place, 1.0);
#else
    gl_Position = frame.view_projection * vec4(place, 1.0);
#endif
}
