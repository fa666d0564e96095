// SPDX-License-Identifier: MIT
#include "runtime/physics/animation.h"

#include "grammar/base/trigonometry.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lsys {

namespace {

constexpr double kRestAngle = 1e-6; // rad, tolerance for settle()
constexpr double kMismatch = 1e-3;  // PlantLoop::mismatch at which the motion counts as periodic
constexpr double kMaxRunIn = 30.0;  // s, or kMinRunInLoops loops if they take longer
constexpr std::uint32_t kMinRunInLoops = 4;

float usable_rate(float frames_per_second) {
    const bool is_valid = frames_per_second >= 0.1F && frames_per_second <= 1e4F;
    return is_valid ? frames_per_second : 24.0F;
}

/// Sets a time step of which a whole number fits between two frames; the destructor restores the
/// options.
class FrameSteps {
public:
    FrameSteps(PlantPhysics& physics, float frames_per_second, float gust_period)
        : physics_(physics), before_(physics.options()) {
        // 1e-3 is subtracted, so that a quotient that rounding raised above a whole number adds no
        // step.
        const float steps = 1.0F / (frames_per_second * before_.time_step) - 1e-3F;
        count_ = steps > 1.0F ? std::ceil(std::min(steps, 1e6F)) : 1.0F;
        PhysicsOptions between = before_;
        between.time_step = 1.0F / (frames_per_second * count_);
        between.gust_period = gust_period;
        changed_ = between.time_step != before_.time_step || gust_period != before_.gust_period;
        if (changed_) {
            physics_.set(between);
        }
    }
    FrameSteps(const FrameSteps&) = delete;
    FrameSteps& operator=(const FrameSteps&) = delete;
    ~FrameSteps() {
        if (changed_) {
            physics_.set(before_);
        }
    }

    void next_frame() {
        const auto count = static_cast<std::uint32_t>(count_);
        for (std::uint32_t step = 0; step < count; ++step) {
            physics_.step();
        }
    }

private:
    PlantPhysics& physics_;
    PhysicsOptions before_; // options to restore
    float count_ = 1.0F;    // steps per frame
    bool changed_ = false;  // the options of physics_ were changed
};

PlantAnimation
empty_animation(const PlantPhysics& physics, std::uint32_t frames, float frames_per_second) {
    PlantAnimation animation;
    animation.frames_per_second = frames_per_second;
    animation.frame_count = frames;
    animation.segment_count = static_cast<std::uint32_t>(physics.rest().segments.size());
    animation.places.resize(std::size_t{frames} * animation.segment_count);
    return animation;
}

glm::dquat frame_of(const SegmentPlace& place) {
    return glm::normalize(glm::dquat(place.frame));
}

/// Keeps objects and polygons, which move rigidly with their segments, out of the ground (y = 0).
/// If an object that is above the ground at rest is below it in a frame, its segment turns up about
/// its base, together with all descendants. If turning is not enough, the segment also moves up.
class GroundGuard {
public:
    /// `rest`: the plant at rest. `bound`: the bind pose, relative to which frames move objects.
    GroundGuard(const Skeleton& rest, const Skeleton& bound) {
        std::vector<std::pair<std::uint32_t, glm::dvec3>> found;
        const auto add = [&](std::uint32_t parent, const glm::vec3& still, const glm::vec3& point) {
            if (parent < bound.segments.size() && still.y >= 0.0F && point.y >= -kRounding) {
                const Segment& segment = bound.segments[parent];
                const glm::dquat back = glm::conjugate(glm::normalize(glm::dquat(segment.frame)));
                found.emplace_back(parent, back * glm::dvec3(point - segment.base));
            }
        };
        for (std::size_t i = 0; i < rest.objects.size(); ++i) {
            const PlacedObject& object = bound.objects[i];
            for (const glm::vec3& point : outline_of(object.kind)) {
                add(object.parent, placed(rest.objects[i], point), placed(object, point));
            }
        }
        for (const Polygon& polygon : bound.polygons) {
            for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
                const std::uint32_t corner = polygon.first_corner + c;
                add(polygon.parent, rest.corners[corner], bound.corners[corner]);
            }
        }
        std::stable_sort(found.begin(), found.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        ends_.assign(bound.segments.size(), 0);
        for (const auto& [segment, arm] : found) {
            arms_.push_back(arm);
            ends_[segment] = arms_.size();
        }
        for (std::size_t i = 1; i < ends_.size(); ++i) {
            ends_[i] = std::max(ends_[i], ends_[i - 1]);
        }
    }

    /// Raises segments of a frame out of the ground. `places`: the poses of all segments.
    void raise(const Skeleton& plant, std::span<SegmentPlace> places) const {
        if (arms_.empty()) {
            return;
        }
        std::vector<Change> changes(places.size());
        for (std::uint32_t i = 0; i < places.size(); ++i) {
            const std::uint32_t parent = plant.segments[i].parent;
            SegmentPlace& place = places[i];
            Change& change = changes[i];
            change.before = glm::dvec3(place.base);
            if (parent < i && changes[parent].is_made) {
                const Change& from = changes[parent];
                const glm::dvec3 base =
                    glm::dvec3(places[parent].base) + from.turn * (change.before - from.before);
                place.base = glm::vec3(base);
                change.is_made = true;
            }
            const std::size_t first = i == 0 ? 0 : ends_[i - 1];
            if (first < ends_[i]) {
                lift(std::span(arms_).subspan(first, ends_[i] - first), place, change);
            }
        }
    }

private:
    struct Change {
        bool is_made = false;
        glm::dvec3 before{0.0};              // base of the segment before it was raised
        glm::dquat turn{1.0, 0.0, 0.0, 0.0}; // rotation by which it was raised, in world axes
    };

    static constexpr float kRounding = 1e-5F; // m, depth of points on the ground due to rounding

    static glm::vec3 placed(const PlacedObject& object, const glm::vec3& point) {
        return object.position + object.size * (object.frame * point);
    }

    /// Outermost points of an object of size 1 (docs/language.md section 7.4); its ends come first.
    static std::vector<glm::vec3> outline_of(TurtleOperation kind) {
        std::vector<glm::vec3> out{glm::vec3(0.0F), glm::vec3(0.0F, 1.0F, 0.0F)};
        const auto add_ring = [&](float radius, float along) {
            constexpr int kPoints = 8;
            for (int i = 0; i < kPoints; ++i) {
                const SineCosine turn = sine_cosine(i * 2.0 * std::numbers::pi / kPoints);
                out.emplace_back(radius * static_cast<float>(turn.cosine), along,
                                 radius * static_cast<float>(turn.sine));
            }
        };
        switch (kind) {
        case TurtleOperation::Leaf:
            out.emplace_back(-0.25F, 0.5F, 0.0F);
            out.emplace_back(0.25F, 0.5F, 0.0F);
            break;
        case TurtleOperation::Flower:
            add_ring(0.68F, 1.0F); // the tips of its petals
            break;
        case TurtleOperation::Sphere:
        case TurtleOperation::Heterocyst:
            add_ring(0.5F, 0.5F);
            break;
        case TurtleOperation::Cylinder:
        case TurtleOperation::Cube:
            add_ring(0.5F, 1.0F);
            [[fallthrough]];
        case TurtleOperation::Cone:
            add_ring(0.5F, 0.0F);
            break;
        case TurtleOperation::Disk:
            out.pop_back();
            add_ring(0.5F, 0.0F);
            break;
        default:
            break;
        }
        return out;
    }

    static void lift(std::span<const glm::dvec3> arms, SegmentPlace& place, Change& change) {
        constexpr int kPasses = 4;     // turning up one point may sink another
        constexpr double kNear = 1e-6; // relative to the largest distance of a point from the base
        const glm::dquat frame = frame_of(place);
        const auto base = static_cast<double>(place.base.y);
        double deepest = 0.0;
        for (int pass = 0; pass <= kPasses; ++pass) {
            glm::dvec3 arm_sum(0.0); // sum of the arms of points below the ground
            deepest = 0.0;
            double reach = 0.0;
            for (const glm::dvec3& own : arms) {
                const glm::dvec3 arm = change.turn * (frame * own);
                reach = std::max(reach, glm::length(arm));
                deepest = std::min(deepest, base + arm.y);
                arm_sum += base + arm.y < 0.0 ? arm : glm::dvec3(0.0);
            }
            if (!(deepest < -kNear * reach)) {
                return;
            }
            const double level = glm::length(glm::dvec2(arm_sum.x, arm_sum.z));
            if (pass == kPasses) {
                break;
            }
            const glm::dvec3 way = level > 0.0 ? glm::dvec3(arm_sum.x, 0.0, arm_sum.z) / level
                                               : glm::dvec3(1.0, 0.0, 0.0);
            double angle = 0.0;
            for (const glm::dvec3& own : arms) {
                const glm::dvec3 arm = change.turn * (frame * own);
                const double along = glm::dot(arm, way);
                if (base + arm.y < 0.0 && along >= 0.0) {
                    const double length = glm::length(glm::dvec2(along, arm.y));
                    angle = std::max(angle, arc_sine(std::clamp(-base / length, -1.0, 1.0)) -
                                                arc_tangent(arm.y, along));
                }
            }
            if (!(angle > 0.0)) {
                break;
            }
            // A rotation about (-z, 0, x) turns the level direction (x, 0, z) towards +Y.
            const glm::dvec3 axis(-way.z, 0.0, way.x);
            const SineCosine half = sine_cosine(0.5 * angle);
            const glm::dquat up(half.cosine, half.sine * axis);
            change.turn = glm::normalize(up * change.turn);
            change.is_made = true;
            place.frame = glm::quat(glm::normalize(change.turn * frame));
        }
        place.base.y -= static_cast<float>(deepest);
        change.is_made = true;
    }

    std::vector<glm::dvec3> arms_;  // points relative to the base, in the axes of their segments
    std::vector<std::size_t> ends_; // by segment: index after its last arm
};

/// Records all frames; the plant must be in the pose of the first frame.
void record_frames(PlantPhysics& physics, FrameSteps& steps, PlantAnimation& animation) {
    Skeleton pose;
    SegmentPlace* place = animation.places.data();
    for (std::uint32_t frame = 0; frame < animation.frame_count; ++frame) {
        if (frame > 0) {
            steps.next_frame();
        }
        physics.pose(pose);
        for (const Segment& segment : pose.segments) {
            *place++ = {segment.base, segment.frame};
        }
    }
}

glm::dvec3 end_of(const Segment& segment, const SegmentPlace& place) {
    return glm::dvec3(place.base + segment.length * heading(place.frame));
}

/// Longest side in m of the bounding box of the origin and of both ends of all segments.
double size_of(const Skeleton& plant) {
    glm::vec3 low(0.0F);
    glm::vec3 high(0.0F);
    for (const Segment& segment : plant.segments) {
        const glm::vec3 end = segment.base + segment.length * heading(segment.frame);
        low = glm::min(low, glm::min(segment.base, end));
        high = glm::max(high, glm::max(segment.base, end));
    }
    const glm::vec3 size = high - low;
    return static_cast<double>(std::max({size.x, size.y, size.z}));
}

double max_distance(const Skeleton& plant,
                    std::span<const SegmentPlace> a,
                    std::span<const SegmentPlace> b) {
    double max_displacement = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Segment& segment = plant.segments[i];
        max_displacement =
            std::max(max_displacement, glm::length(end_of(segment, a[i]) - end_of(segment, b[i])));
    }
    return max_displacement;
}

/// Moves `places` towards `other` by the fraction `share`. Interpolates the rotations of joints
/// relative to their parents, so that segments stay joined.
void blend(const Skeleton& plant,
           std::span<const SegmentPlace> other,
           double share,
           std::span<SegmentPlace> places) {
    std::vector<SegmentPlace> old(places.begin(), places.end());
    const auto mixed = [share](const glm::dquat& from, glm::dquat to) {
        to = glm::dot(from, to) < 0.0 ? -to : to;
        return glm::normalize((1.0 - share) * from + share * to);
    };
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        const std::uint32_t parent = plant.segments[i].parent;
        if (parent >= i) { // a root: its base does not move
            places[i].frame = glm::quat(mixed(frame_of(old[i]), frame_of(other[i])));
            continue;
        }
        const glm::dquat back = glm::conjugate(frame_of(old[parent]));
        const glm::dquat other_back = glm::conjugate(frame_of(other[parent]));
        const glm::dquat turn = mixed(back * frame_of(old[i]), other_back * frame_of(other[i]));
        const glm::dvec3 arm = back * glm::dvec3(old[i].base - old[parent].base);
        const glm::dvec3 other_arm = other_back * glm::dvec3(other[i].base - other[parent].base);
        const glm::dquat frame = frame_of(places[parent]);
        places[i].base = glm::vec3(glm::dvec3(places[parent].base) +
                                   frame * ((1.0 - share) * arm + share * other_arm));
        places[i].frame = glm::quat(glm::normalize(frame * turn));
    }
}

} // namespace

PlantAnimation record(PlantPhysics& physics, std::uint32_t frames, float frames_per_second) {
    PlantAnimation animation = empty_animation(physics, frames, usable_rate(frames_per_second));
    if (frames > 1) {
        FrameSteps steps(physics, animation.frames_per_second, physics.options().gust_period);
        Skeleton first;
        physics.pose(first);
        record_frames(physics, steps, animation);
        if (physics.options().ground) {
            const GroundGuard guard(physics.rest(), first);
            for (std::uint32_t frame = 1; frame < frames; ++frame) {
                guard.raise(physics.rest(), animation.frame(frame));
            }
        }
    } else if (frames == 1) {
        Skeleton pose;
        physics.pose(pose);
        std::transform(pose.segments.begin(), pose.segments.end(), animation.places.begin(),
                       [](const Segment& segment) {
                           return SegmentPlace{segment.base, segment.frame};
                       });
    }
    return animation;
}

PlantLoop record_loop(PlantPhysics& physics, std::uint32_t frames, float frames_per_second) {
    frames = std::max(frames, 3U);
    const float rate = usable_rate(frames_per_second);
    const float period = static_cast<float>(frames - 1) / rate;
    PlantLoop loop;
    loop.animation = empty_animation(physics, frames, rate);
    const Skeleton& plant = physics.rest();
    if (plant.segments.empty()) {
        return loop;
    }
    const double size = std::max(size_of(plant), 1e-30);
    physics.settle(kRestAngle, settle_rounds(plant.segments.size()));
    FrameSteps steps(physics, rate, period);
    const auto most_loops = std::max(
        kMinRunInLoops, static_cast<std::uint32_t>(kMaxRunIn / static_cast<double>(period)));
    PlantAnimation before = loop.animation;
    record_frames(physics, steps, before);
    for (loop.run_in = 1;; ++loop.run_in) {
        record_frames(physics, steps, loop.animation);
        loop.mismatch =
            max_distance(plant, loop.animation.frame(0), loop.animation.frame(frames - 1)) / size;
        if (loop.mismatch <= kMismatch || loop.run_in >= most_loops) {
            break;
        }
        std::swap(before, loop.animation);
    }
    const std::span<SegmentPlace> places(loop.animation.places);
    for (std::uint32_t frame = 1; frame + 1 < frames; ++frame) {
        const double part = static_cast<double>(frame) / static_cast<double>(frames - 1);
        blend(plant, before.frame(frame), part * part * (3.0 - 2.0 * part),
              places.subspan(std::size_t{frame} * plant.segments.size(), plant.segments.size()));
    }
    if (physics.options().ground) {
        const GroundGuard guard(plant, plant);
        for (std::uint32_t frame = 0; frame + 1 < frames; ++frame) {
            guard.raise(plant, loop.animation.frame(frame));
        }
    }
    const std::span<const SegmentPlace> first = std::as_const(loop.animation).frame(0);
    std::copy(first.begin(), first.end(), places.end() - static_cast<std::ptrdiff_t>(first.size()));
    return loop;
}

void pose_at(const Skeleton& rest, std::span<const SegmentPlace> places, Skeleton& out) {
    out = rest;
    const auto turn_of = [&](std::uint32_t segment) {
        const glm::dquat frame = frame_of(places[segment]);
        return frame * glm::conjugate(glm::normalize(glm::dquat(rest.segments[segment].frame)));
    };
    const auto moved = [&](std::uint32_t segment, const glm::vec3& point) {
        const glm::dvec3 arm(point - rest.segments[segment].base);
        return glm::vec3(glm::dvec3(places[segment].base) + turn_of(segment) * arm);
    };
    const auto turned = [&](std::uint32_t segment, const glm::quat& frame) {
        return glm::quat(glm::normalize(turn_of(segment) * glm::dquat(frame)));
    };
    for (std::size_t i = 0; i < places.size(); ++i) {
        out.segments[i].base = places[i].base;
        out.segments[i].frame = places[i].frame;
    }
    for (PlacedObject& object : out.objects) {
        if (object.parent < places.size()) {
            object.position = moved(object.parent, object.position);
            object.frame = turned(object.parent, object.frame);
        }
    }
    for (Polygon& polygon : out.polygons) {
        if (polygon.parent < places.size()) {
            for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
                glm::vec3& corner = out.corners[polygon.first_corner + c];
                corner = moved(polygon.parent, corner);
            }
            polygon.frame = turned(polygon.parent, polygon.frame);
        }
    }
}

} // namespace lsys
