// SPDX-License-Identifier: MIT
// AxisReader: reads the joints of one axis, ready for rings. It leaves out joints and edges that
// cannot be drawn, so that later steps need no checks.
#pragma once

#include "runtime/meshing/impl/axes.h"
#include "runtime/meshing/impl/polygon_sides.h"
#include "runtime/meshing/impl/stem_base.h"
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
    float radius = 0.0F; // distance of the ring's corners from `centre`; 0 only at a pointed end
    glm::vec3 heading{}; // unit, along the edge; last joint: of the edge before
    float length = 0.0F; // length of the edge; 0 at the last joint
    ItemColour colour = 0;
    std::uint8_t sides = 0;
    std::uint8_t rings = 1; // more where the axis bends by more than 60 degrees
};

enum class TubeEnd : std::uint8_t {
    Point,  // the radius is 0
    Flat,   // closed by a disc
    Blunt,  // closed by a low cone
    Ball,   // closed by a half ball, from which branches begin
    Open,   // inside of another tube
    Round,  // closed by a half ball
    Broken, // closed by a jagged break
};

/// Number of rings that close a run after the ring of its last joint.
[[nodiscard]] inline std::uint32_t closing_rings(TubeEnd end) {
    return end == TubeEnd::Ball ? 1 : end == TubeEnd::Round || end == TubeEnd::Broken ? 2 : 0;
}

/// At least two joints without a gap between them.
struct Run {
    std::span<const Joint> joints;
    /// Radii of the joints before they were widened for fewer sides; empty if no joint was widened.
    std::span<const float> radii;
    TubeEnd begin = TubeEnd::Flat;
    TubeEnd end = TubeEnd::Blunt;
    glm::vec3 side{}; // direction of u = 0; about perpendicular to the first heading
    std::uint32_t first_segment = 0;
    bool has_roots = false; // the buttress roots of Skeleton::tube_shape
};

/// Run::side for a run that begins with the segment `first_segment`.
[[nodiscard]] inline glm::vec3 side_of(const Skeleton& skeleton, std::uint32_t first_segment) {
    return skeleton.segments[first_segment].frame * glm::vec3(1.0F, 0.0F, 0.0F);
}

/// The radius that can be drawn around `centre`; 0 if none can.
[[nodiscard]] float drawn_radius(float radius, const glm::vec3& centre, std::uint32_t sides);

/// Whether two centres of joints with this radius are too near for floats to tell apart.
[[nodiscard]] bool coincide(const glm::vec3& a, const glm::vec3& b, float radius);

struct CurveStart; // joint_curves.h

class AxisReader {
public:
    AxisReader(const Skeleton& skeleton, const Axes& axes, const MeshOptions& options);

    /// Begins to read the axis whose first segment is `first_segment`.
    void start(std::uint32_t first_segment);
    /// Reads the next run of the axis, valid until the next call; false after the last one.
    [[nodiscard]] bool next(Run& run);
    /// Moves the joints of the last run and their radii into the arguments; the spans of the run
    /// stay valid.
    void take(LargeVector<Joint>& joints, LargeVector<float>& radii) {
        joints = std::exchange(joints_, {});
        radii = std::exchange(radii_, {});
    }

private:
    bool read(Run& run);                            // joints up to a gap; false if there are none
    void add(const Segment& segment, float radius); // adds the joint at the base of the segment
    /// Adds the last joint; false if the run is too short or too thin to draw.
    bool add_end(const glm::vec3& centre, float radius);
    /// Fits the base into the tube of the parent segment; returns false if the base lies outside of
    /// it.
    bool fit_into_parent(const Run& run, std::optional<CurveStart>& start);
    /// The tangent at the tip of a segment of a smooth curve through the tip. `next`: the segment
    /// that continues it.
    [[nodiscard]] glm::vec3 tip_tangent(const Segment& segment, std::uint32_t next) const;
    /// Length of the collar along the first edge of the run.
    [[nodiscard]] float collar_length(const Segment& parent, float parent_radius) const;
    /// Adds the collar: a cone by which the run widens towards its parent.
    void add_collar(const Segment& parent, float parent_radius);
    /// Sets base_widening_ for `#set collar`; returns false if the branch has no such collar.
    bool set_wide_collar(const Segment& child, float parent_radius);
    void widen_base(bool open); // applies base_widening_
    void add_root_sides();      // enough sides to show buttress roots
    [[nodiscard]] bool is_shaped(const Segment& segment) const; // may have a collar or a shaped tip
    void subdivide(); // cuts edges into pieces that noise can move
    void fit_sides(); // reduces the sides to what MeshOptions::deviation needs
    /// Sets Joint::rings by the bend, and widens joints that are too thin for their neighbours.
    void set_rings();
    [[nodiscard]] std::uint8_t sides_of(const Segment& segment) const {
        return sides_[segment.sides];
    }

    const Skeleton& skeleton_;
    const Axes& axes_;
    const MeshOptions& options_;
    std::array<std::uint8_t, 256> sides_{}; // drawn sides, by Segment::sides
    std::array<float, 256> widening_{};     // factor of the radius, by Segment::sides
    // If a deviation is set, sides_ and the joints have the sides of level 0 until fit_sides() is
    // called.
    std::optional<SideCounts> counts_;                    // set if MeshOptions::deviation is set
    std::array<std::uint8_t, kMaxSides + 1> max_sides_{}; // at options_.level, by sides of level 0
    BaseWidening base_widening_;                          // widening of the current run
    float max_base_radius_ = 0.0F; // max radius of the corners of an open base
    std::array<float, 2> flare_{}; // radii at both ends of the longest possible collar; 0: none
    LargeVector<float> radii_;
    LargeVector<Joint> joints_;
    LargeVector<Joint> spare_;           // memory to reuse
    std::uint32_t segment_ = kNoSegment; // the next segment to read
    bool attached_ = false;              // no segment of the axis has been left out so far
    bool rings_final_ = true; // the rings of all joints are final: set_rings() is not needed
    bool stale_ = false;      // heading and length of the last joint are outdated
};

} // namespace lsys
