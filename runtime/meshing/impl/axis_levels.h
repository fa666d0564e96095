#pragma once

#include "runtime/meshing/impl/axis_reader.h"

namespace lsys {

/// Removes joints that lie within `tolerance` radii, or `error` metres, of the edge that replaces
/// them: where the axis is nearly straight and its radius nearly linear. Ends and changes of colour
/// stay; changes of sides stay unless there is an `error`. `scratch`: memory to reuse.
void leave_out_joints(LargeVector<Joint>& joints,
                      LargeVector<Joint>& scratch,
                      float tolerance,
                      float error);

/// Sets heading and length of the edge from `from` to `to`.
void aim(Joint& from, const glm::vec3& to);

} // namespace lsys
