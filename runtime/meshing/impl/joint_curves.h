// SPDX-License-Identifier: MIT
// Smooth curves through the joints of a run, for MeshOptions::smooth_joints.
#pragma once

#include "runtime/meshing/impl/axis_reader.h"

#include <optional>

namespace lsys {

/// Max number of parts of an edge.
inline constexpr std::size_t kMaxCurveParts = 16;

/// The base of a branch that leaves its parent in the direction of the parent's axis.
struct CurveStart {
    glm::vec3 tangent{}; // unit, of the curve at the first joint
    float flare = 0.0F;  // radius at the first joint minus the branch's; may be negative
    float reach = 0.0F;  // length over which the flare fades to 0
};

/// The unit tangent of a curve at a joint between edges of unit headings `in` and `out`: their
/// bisector. None if the axis turns back there.
[[nodiscard]] std::optional<glm::vec3> joint_tangent(const glm::vec3& in, const glm::vec3& out);

/// Whether a branch of unit heading `heading` can begin in the direction `tangent`, and turns
/// enough to need more rings.
[[nodiscard]] bool can_leave_along(const glm::vec3& tangent, const glm::vec3& heading);

/// Replaces edges by parts of a centripetal Catmull-Rom curve through the joints, which stay where
/// they are (Yuksel, Schaefer and Keyser 2011, "Parameterization and applications of Catmull-Rom
/// curves": no edge has a cusp or a loop). Consecutive parts turn by about the same angle, at most
/// 15 degrees. The radius is a linear function of arc length, plus the flare of `start`. An edge
/// stays straight if its rings would cross, or if it does not bend. Returns whether any edge was
/// replaced.
bool bend_edges(LargeVector<Joint>& joints,
                LargeVector<Joint>& scratch,
                const std::optional<CurveStart>& start);

} // namespace lsys
