// SPDX-License-Identifier: MIT
// Axes: chains of segments, each of which becomes one tube. An axis goes from a segment to the
// child that continues it.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <vector>

namespace lsys {

class Workers;

/// In Axes::next: no child continues the segment, but branches begin at its tip.
inline constexpr std::uint32_t kForked = kNoSegment - 1;

struct Axes {
    /// Per segment: the segment that continues it, kForked, or kNoSegment.
    LargeVector<std::uint32_t> next;
    std::vector<ItemColour> colours; // colours of all segments, ascending
};

/// Equal to heading() for a unit quaternion, in half the operations.
[[nodiscard]] inline glm::vec3 direction(const glm::quat& q) {
    return {2.0F * (q.x * q.y - q.w * q.z), 1.0F - 2.0F * (q.x * q.x + q.z * q.z),
            2.0F * (q.y * q.z + q.w * q.x)};
}

/// Whether `child` is linked and begins at the tip of `parent`, within a tolerance. A parent drawn
/// backwards is stored reversed, so its children begin at its base.
[[nodiscard]] bool joins(const Segment& parent, const Segment& child);

/// Finds for each segment the child that continues it: among the children of the same order that
/// joins() accepts, the one that bends least; with equal bends, the first. The result does not
/// depend on the number of workers.
[[nodiscard]] Axes find_axes(const Skeleton& skeleton, Workers& workers);

/// Whether an axis begins with `segment`.
[[nodiscard]] inline bool
begins_axis(const Axes& axes, const Segment& segment, std::uint32_t index) {
    return segment.parent >= index || axes.next[segment.parent] != index;
}

} // namespace lsys
