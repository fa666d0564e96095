// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/meshing/impl/axis_reader.h"

namespace lsys {

/// Simplifies an axis: removes joints that are within `tolerance` radii, or `error` metres, of the
/// edge that replaces them, if the radius changes nearly linearly along this edge. Both ends and
/// joints where the colour changes stay; joints where the number of sides changes stay if `error`
/// is 0. `scratch`: memory to reuse.
void leave_out_joints(LargeVector<Joint>& joints,
                      LargeVector<Joint>& scratch,
                      float tolerance,
                      float error);

/// Sets heading and length of the edge from `from` to `to`.
void aim(Joint& from, const glm::vec3& to);

} // namespace lsys
