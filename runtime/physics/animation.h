// PlantAnimation: the poses of a plant that moves, for exporters of skins. Made by record().
// Objects and polygons go rigidly with the segments that are their parents; without a parent they
// stay.
#pragma once

#include "runtime/base/large_vector.h"
#include "runtime/physics/physics.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace lsys {

struct SegmentPlace {
    glm::vec3 base{};
    glm::quat frame{1.0F, 0.0F, 0.0F, 0.0F};
};

struct PlantAnimation {
    float frames_per_second = 24.0F;
    std::uint32_t frame_count = 0;
    std::uint32_t segment_count = 0;
    LargeVector<SegmentPlace> places; // frame by frame, in each all segments in order

    [[nodiscard]] std::span<const SegmentPlace> frame(std::uint32_t number) const {
        return std::span(places).subspan(std::size_t{number} * segment_count, segment_count);
    }
};

/// What such an animation takes in memory.
[[nodiscard]] constexpr std::uint64_t animation_bytes(std::uint64_t segments,
                                                      std::uint64_t frames) {
    return segments * frames * sizeof(SegmentPlace);
}

/// Moves the plant on and takes a frame every 1 / frames_per_second seconds, the first as it is
/// now. Between two frames there are equal steps, none longer than the plant's time step.
/// `frames_per_second` is 0.1 to 10,000, else 24.
[[nodiscard]] PlantAnimation
record(PlantPhysics& physics, std::uint32_t frames, float frames_per_second);

} // namespace lsys
