// PlantAnimation: poses of a moving plant, for exporters of skins. Made by record(). Objects and
// polygons move rigidly with their parent segment; without a parent they stand still.
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
    LargeVector<SegmentPlace> places; // frame by frame; in each frame by segment

    [[nodiscard]] std::span<const SegmentPlace> frame(std::uint32_t number) const {
        return std::span(places).subspan(std::size_t{number} * segment_count, segment_count);
    }
};

/// Memory of an animation.
[[nodiscard]] constexpr std::uint64_t animation_bytes(std::uint64_t segments,
                                                      std::uint64_t frames) {
    return segments * frames * sizeof(SegmentPlace);
}

/// Moves the plant and records a frame every 1 / frames_per_second seconds, the first at once.
/// Between two frames there are equal steps, none longer than the plant's time step.
/// `frames_per_second` outside 0.1 to 10,000 becomes 24.
[[nodiscard]] PlantAnimation
record(PlantPhysics& physics, std::uint32_t frames, float frames_per_second);

} // namespace lsys
