// AxisReader: the joints of one axis, ready to be given rings. What cannot be drawn is left out
// here, so that what follows need not look for it.
#pragma once

#include "runtime/meshing/impl/axes.h"
#include "runtime/meshing/impl/polygon_sides.h"
#include "runtime/meshing/mesh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace lsys {

/// A joint, and the edge from it to the next one.
struct Joint {
    glm::vec3 centre{};
    float radius = 0.0F; // of the corners of the ring; 0 only at a pointed end
    glm::vec3 heading{}; // unit, of the edge; at the last joint of the edge before
    float length = 0.0F; // of the edge; 0 at the last joint
    std::uint16_t colour = 0;
    std::uint8_t sides = 0;
    std::uint8_t rings = 1; // more where the axis bends by more than 60 degrees
};

enum class TubeEnd : std::uint8_t {
    Point, // the radius is 0
    Flat,  // closed by a disc
    Blunt, // closed by a low cone
    Ball,  // closed by a half ball, which branches leave
    Open,  // inside of another tube
};

/// Joints without a gap, at least two.
struct Run {
    std::span<const Joint> joints;
    /// Of the joints, before each was widened for its own number of sides; empty if all have what
    /// they were asked to have.
    std::span<const float> radii;
    TubeEnd begin = TubeEnd::Flat;
    TubeEnd end = TubeEnd::Blunt;
    glm::vec3 side{}; // about perpendicular to the first heading, where u is 0
    std::uint32_t first_segment = 0;
};

/// Run::side of a run that begins with a segment.
[[nodiscard]] inline glm::vec3 side_of(const Skeleton& skeleton, std::uint32_t first_segment) {
    return skeleton.segments[first_segment].frame * glm::vec3(1.0F, 0.0F, 0.0F);
}

class AxisReader {
public:
    AxisReader(const Skeleton& skeleton, const Axes& axes, const MeshOptions& options);

    void start(std::uint32_t first_segment);
    /// The next run of the axis; false after the last one. It is good until the next call.
    [[nodiscard]] bool next(Run& run);
    /// The joints of the last run and their radii, which stay where they are.
    void take(LargeVector<Joint>& joints, LargeVector<float>& radii) {
        joints = std::exchange(joints_, {});
        radii = std::exchange(radii_, {});
    }

private:
    bool read(Run& run);
    void add(const Segment& segment, float radius);
    bool add_end(const glm::vec3& centre, float radius);
    bool begins_in_parent(Run& run);
    void add_collar(const Segment& parent, float parent_radius);
    void subdivide();
    void fit_sides();
    void set_rings();
    [[nodiscard]] std::uint8_t sides_of(const Segment& segment) const {
        return sides_[segment.sides];
    }

    const Skeleton& skeleton_;
    const Axes& axes_;
    const MeshOptions& options_;
    std::array<std::uint8_t, 256> sides_{}; // by those of the segment
    std::array<float, 256> widening_{};     // of the radius, for fewer sides
    // Where sides depend on the radius, sides_ and joints have those of level 0, until fit_sides().
    std::optional<SideCounts> counts_;
    std::array<std::uint8_t, kMaxSides + 1> most_sides_{}; // of the level, by those of level 0
    float hidden_ = 0.0F;          // radius that the corners of an open base have at most
    std::array<float, 2> flare_{}; // radii of the collar at any angle; 0: none
    LargeVector<float> radii_;
    LargeVector<Joint> joints_;
    LargeVector<Joint> spare_;
    std::uint32_t segment_ = kNoSegment; // the next one to read
    bool attached_ = false;              // nothing of the axis was left out so far
    bool plain_ = true;                  // no joint has to be looked at again
    bool stale_ = false;                 // the last joint's heading is not known
};

} // namespace lsys
