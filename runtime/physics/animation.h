// SPDX-License-Identifier: MIT
// PlantAnimation: poses of a moving plant, for exporters of skins. Made by record(). Objects and
// polygons move rigidly with their parent segment; without a parent they do not move. With
// PhysicsOptions::ground, an end of an object or a corner of a polygon that is above y = 0 at rest
// is never below y = 0 in a frame: the segment that carries the object or polygon turns up or, if
// that is not enough, moves up.
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
    LargeVector<SegmentPlace> places; // frame by frame; within a frame by segment

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

/// A clip that repeats: a PlantAnimation whose last frame equals its first.
struct PlantLoop {
    PlantAnimation animation;
    /// Max distance that an end of a segment had between the first and the last frame before these
    /// frames were blended, as a fraction of the plant's size.
    double mismatch = 0.0;
    std::uint32_t run_in = 0; // number of loops simulated before the recorded loop
};

/// Memory of record_loop() in bytes.
[[nodiscard]] constexpr std::uint64_t loop_bytes(std::uint64_t segments, std::uint64_t frames) {
    return 2 * animation_bytes(segments, frames);
}

/// Records the motion in gusts as a clip that repeats: frame `frames` - 1 equals frame 0. The
/// period of the gusts is the duration of the clip. The plant starts at rest in the mean wind and
/// moves until the first and the last pose of a clip agree, for at most 30 s or four clips,
/// whichever is longer. Blending the clip with the clip before it, joint by joint, removes the
/// remaining difference, so that the motion is smooth from the last frame to the first, too. Fewer
/// than 3 frames count as 3.
[[nodiscard]] PlantLoop
record_loop(PlantPhysics& physics, std::uint32_t frames, float frames_per_second);

/// Writes to `out` the plant with its segments at `places`, one for each segment; objects and
/// polygons move rigidly with their parent segments.
void pose_at(const Skeleton& rest, std::span<const SegmentPlace> places, Skeleton& out);

/// Simulates the plant and records a frame every 1 / `frames_per_second` seconds, the first at time
/// 0. The steps between two frames are equal, and none is longer than the plant's time step. A
/// `frames_per_second` outside of 0.1 to 10,000 is replaced by 24.
[[nodiscard]] PlantAnimation
record(PlantPhysics& physics, std::uint32_t frames, float frames_per_second);

} // namespace lsys
