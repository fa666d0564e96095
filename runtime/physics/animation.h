// SPDX-License-Identifier: MIT
// PlantAnimation: poses of a moving plant, for exporters of skins. Made by record(). Objects and
// polygons move rigidly with their parent segment; without a parent they stand still. With
// PhysicsOptions::ground no end of an object and no corner of a polygon that is above y = 0 at rest
// is below y = 0 in a frame: the segment that carries it turns up or, if that is not enough, moves
// up.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/physics/physics.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace lsys {

struct SegmentPlace {
    glm::vec3 base{}; // m
    glm::quat frame{1.0F, 0.0F, 0.0F, 0.0F};
};

struct PlantAnimation {
    float frames_per_second = 24.0F;
    std::uint32_t frame_count = 0;
    std::uint32_t segment_count = 0;
    LargeVector<SegmentPlace> places; // frame by frame; in each frame by segment

    [[nodiscard]] std::span<const SegmentPlace> frame(std::uint32_t number) const {
        return std::span(places).subspan(std::size_t{number} * segment_count, segment_count);
    }
    [[nodiscard]] std::span<SegmentPlace> frame(std::uint32_t number) {
        return std::span(places).subspan(std::size_t{number} * segment_count, segment_count);
    }
};

/// Memory of an animation in bytes.
[[nodiscard]] constexpr std::uint64_t animation_bytes(std::uint64_t segments,
                                                      std::uint64_t frames) {
    return segments * frames * sizeof(SegmentPlace);
}

/// A clip that loops: a PlantAnimation whose last frame equals its first.
struct PlantLoop {
    PlantAnimation animation;
    /// Max distance of an end of a segment between the first and the last frame before they were
    /// blended, as a fraction of the plant's size.
    double mismatch = 0.0;
    std::uint32_t run_in = 0; // number of loops simulated before the recorded loop
};

/// Memory of record_loop() in bytes.
[[nodiscard]] constexpr std::uint64_t loop_bytes(std::uint64_t segments, std::uint64_t frames) {
    return 2 * animation_bytes(segments, frames);
}

/// Records the motion in gusts as a loop: frame `frames` - 1 equals frame 0. The gusts repeat with
/// the period of the clip. The plant starts at rest in the mean wind and moves until the start and
/// the end of a loop agree, for at most 30 s or four loops, whichever is longer. The remaining
/// difference is removed by blending the clip with the loop before it, joint by joint, so that the
/// motion is smooth at the seam too. Fewer than 3 frames count as 3.
[[nodiscard]] PlantLoop
record_loop(PlantPhysics& physics, std::uint32_t frames, float frames_per_second);

/// Writes to `out` the plant with its segments at `places`, one for each segment: objects and
/// polygons move rigidly with their parent.
void pose_at(const Skeleton& rest, std::span<const SegmentPlace> places, Skeleton& out);

/// Moves the plant and records a frame every 1 / frames_per_second seconds, the first at time 0.
/// Between two frames there are equal steps, none longer than the plant's time step.
/// `frames_per_second` outside 0.1 to 10,000 becomes 24.
[[nodiscard]] PlantAnimation
record(PlantPhysics& physics, std::uint32_t frames, float frames_per_second);

} // namespace lsys
