#include "runtime/physics/animation.h"

#include <algorithm>
#include <cmath>

namespace lsys {

PlantAnimation record(PlantPhysics& physics, std::uint32_t frames, float frames_per_second) {
    const bool is_valid = frames_per_second >= 0.1F && frames_per_second <= 1e4F;
    PlantAnimation animation;
    animation.frames_per_second = is_valid ? frames_per_second : 24.0F;
    animation.frame_count = frames;
    animation.segment_count = static_cast<std::uint32_t>(physics.rest().segments.size());
    animation.places.resize(std::size_t{frames} * animation.segment_count);

    const PhysicsOptions before = physics.options();
    // A rounding error above a whole number of steps gives no further step.
    const float steps = 1.0F / (animation.frames_per_second * before.time_step) - 1e-3F;
    const float count = steps > 1.0F ? std::ceil(std::min(steps, 1e6F)) : 1.0F;
    PhysicsOptions between = before;
    between.time_step = 1.0F / (animation.frames_per_second * count);
    if (frames > 1 && between.time_step != before.time_step) {
        physics.set(between);
    }
    Skeleton pose;
    SegmentPlace* place = animation.places.data();
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        for (float step = 0.0F; frame > 0 && step < count; step += 1.0F) {
            physics.step();
        }
        physics.pose(pose);
        for (const Segment& segment : pose.segments) {
            *place++ = {segment.base, segment.frame};
        }
    }
    if (frames > 1 && between.time_step != before.time_step) {
        physics.set(before);
    }
    return animation;
}

} // namespace lsys
