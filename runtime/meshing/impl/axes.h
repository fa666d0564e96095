// Axes: which segments make one tube. An axis goes from a segment to the child that continues it.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <vector>

namespace lsys {

class Workers;

/// In Axes::next: nothing goes on, but branches begin there.
inline constexpr std::uint32_t kForked = kNoSegment - 1;

struct Axes {
    /// The segment that continues each one, kForked, or kNoSegment.
    LargeVector<std::uint32_t> next;
    std::vector<std::uint16_t> colours; // that segments have, rising
};

/// heading() of a unit quaternion in half the operations.
[[nodiscard]] inline glm::vec3 direction(const glm::quat& q) {
    return {2.0F * (q.x * q.y - q.w * q.z), 1.0F - 2.0F * (q.x * q.x + q.z * q.z),
            2.0F * (q.y * q.z + q.w * q.x)};
}

/// Whether `child` begins where `parent`, its parent, ends, as far as floats can tell. A segment
/// drawn backwards was turned around and ends elsewhere.
[[nodiscard]] bool joins(const Segment& parent, const Segment& child);

/// A segment is continued by its linked child of the same order; of several, by the one that bends
/// least, and of equal ones by the first. The same for any number of workers.
[[nodiscard]] Axes find_axes(const Skeleton& skeleton, Workers& workers);

/// Whether an axis begins with `segment`.
[[nodiscard]] inline bool
begins_axis(const Axes& axes, const Segment& segment, std::uint32_t index) {
    return segment.parent >= index || axes.next[segment.parent] != index;
}

} // namespace lsys
