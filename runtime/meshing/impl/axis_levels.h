#pragma once

#include "runtime/meshing/impl/axis_reader.h"

namespace lsys {

/// Removes joints that lie within `tolerance` radii of the edge that replaces them: where the axis
/// is nearly straight and its radius nearly linear. Ends and changes of colour or sides stay.
void leave_out_joints(LargeVector<Joint>& joints, LargeVector<Joint>& scratch, float tolerance);

/// Sets heading and length of the edge from `from` to `to`.
void aim(Joint& from, const glm::vec3& to);

} // namespace lsys
