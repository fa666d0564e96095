// SPDX-License-Identifier: MIT
#include "forest.glsl"
// Layout of the impostor atlas; the C++ side is gl/impl/impostor_atlas.h.
const int kYaws = 8;
const float kElevations[3] = float[](0.0, 0.6108652, 1.3089969); // 0, 35 and 75 degrees
const float kElevationShift = 0.3; // radians, from the first tree to change elevations to the last
const float kImpostorMargin = 1.04;

// Half width, half height and half depth of an impostor from an elevation, m at scale 1.
vec3 picture_size(uint form, int elevation) {
    vec4 cylinder = forms[form].cylinder;
    float half_height = 0.5 * (cylinder.z - cylinder.y);
    float e = kElevations[elevation];
    return kImpostorMargin * vec3(cylinder.x, half_height * cos(e) + cylinder.x * sin(e),
                                  length(vec2(cylinder.x, half_height)));
}
