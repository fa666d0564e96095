// SPDX-License-Identifier: MIT
#include "runtime/turtle/growth.h"

#include "runtime/turtle/impl/correspondence.h"
#include "runtime/turtle/organs.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace lsys {

namespace {

/// The value of a quantity in the earlier drawing, at index 0, and in the later drawing, at index
/// 1.
template <typename T>
using BeforeAndAfter = std::array<T, 2>;

/// A frame and the point that children start from.
struct Joint {
    glm::dquat frame{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 tip{};
};

/// The motion of an item, relative to its parent.
struct Motion {
    BeforeAndAfter<glm::quat> turn;    // rotation from the parent's frame
    BeforeAndAfter<glm::vec3> offset;  // vector from the parent's tip, in the parent's frame
    std::uint32_t parent = kNoSegment; // index in State::segments
    bool eases = false;                // grows from size 0 or shrinks to size 0
};

struct MovingSegment {
    Motion motion;
    BeforeAndAfter<float> length{};
    BeforeAndAfter<float> base_radius{};
    BeforeAndAfter<float> tip_radius{};
    bool is_apart = false; // linked in `after` only: there may be a gap to its parent before time 1
};

struct MovingObject {
    Motion motion;
    BeforeAndAfter<float> size{};
    /// Index in before.objects of the organ that it continues, if that has as many points or fewer.
    std::uint32_t old = kNone;
};

struct MovingPolygon {
    Motion motion;                  // motion of the polygon's frame
    std::uint32_t first_corner = 0; // index in State::corners
};

double interpolated(float before, float after, double part) {
    return static_cast<double>(before) +
           part * (static_cast<double>(after) - static_cast<double>(before));
}

glm::dvec3 interpolated(const BeforeAndAfter<glm::vec3>& ends, double part) {
    return glm::dvec3(ends[0]) + part * (glm::dvec3(ends[1]) - glm::dvec3(ends[0]));
}

/// Precondition: use_shorter_turn(ends) was called.
glm::dquat interpolated(const BeforeAndAfter<glm::quat>& ends, double part) {
    return glm::normalize(glm::dquat(ends[0]) * (1.0 - part) + glm::dquat(ends[1]) * part);
}

/// Negates the later turn if the rotation between the two is then shorter: a quaternion and its
/// negative are the same turn.
void use_shorter_turn(BeforeAndAfter<glm::quat>& turn) {
    if (glm::dot(turn[0], turn[1]) < 0.0F) {
        turn[1] = -turn[1];
    }
}

/// Smoothstep of `part`.
double eased(double part) {
    return part * part * (3.0 - 2.0 * part);
}

glm::dvec3 tip_of(const glm::dvec3& base, const glm::dquat& frame, double length) {
    return base + frame * glm::dvec3(0.0, length, 0.0);
}

/// Max rounding error of the distance from a parent's tip, relative to the size of coordinates.
constexpr double kRounding = 1e-5;

} // namespace

struct SkeletonGrowth::State {
    Skeleton before; // of the earlier word
    Skeleton after;  // of the later word
    GrowthCounts counts;
    LargeVector<MovingSegment> segments; // segments of `after`, then segments that shrink
    LargeVector<MovingObject> objects;
    LargeVector<MovingPolygon> polygons;
    /// Vectors from the parent's tip, in the parent's frame.
    LargeVector<BeforeAndAfter<glm::vec3>> corners;
    LargeVector<std::uint32_t> shrinking_segments; // indexes in `before`
    LargeVector<std::uint32_t> shrinking_objects;
    LargeVector<std::uint32_t> shrinking_polygons;
    // Used only by the constructor.
    LargeVector<BeforeAndAfter<Joint>> joints; // by index in `segments`
    LargeVector<std::uint32_t> new_segments; // by segment of `before`: index in `segments`, or none

    [[nodiscard]] Joint joint(std::uint32_t segment, std::size_t end) const {
        return segment == kNoSegment ? Joint{} : joints[segment][end];
    }
    /// Index in `segments` of the segment that continues segment `old` of `before`.
    [[nodiscard]] std::uint32_t new_segment_of(std::uint32_t old) const {
        return old == kNoSegment ? kNoSegment : new_segments[old];
    }

    /// Sets the pose in the drawing `end`, an index of BeforeAndAfter.
    void set_end(Motion& motion,
                 std::size_t end,
                 const glm::dvec3& place,
                 const glm::dquat& frame) const {
        const Joint from = joint(motion.parent, end);
        const glm::dquat back = glm::conjugate(from.frame);
        motion.turn[end] = glm::quat(back * frame);
        motion.offset[end] = glm::vec3(back * (place - from.tip));
    }
    /// Sets the pose in the drawing `end`, in which the item has size 0, from the pose in the other
    /// drawing: at the parent's tip, with the same turn relative to the parent. An item without a
    /// parent stays in its place.
    static void set_vanished(Motion& motion, std::size_t end) {
        motion.turn[end] = motion.turn[1 - end];
        motion.offset[end] = motion.parent == kNoSegment ? motion.offset[1 - end] : glm::vec3(0.0F);
        motion.eases = true;
    }

    void add_joints(const MovingSegment& moving) {
        BeforeAndAfter<Joint> made;
        for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
            const Joint from = joint(moving.motion.parent, end);
            made[end].frame = glm::normalize(from.frame * glm::dquat(moving.motion.turn[end]));
            made[end].tip = tip_of(from.tip + from.frame * glm::dvec3(moving.motion.offset[end]),
                                   made[end].frame, static_cast<double>(moving.length[end]));
        }
        joints.push_back(made);
    }

    void set_shape(MovingSegment& moving, std::size_t end, const Segment& segment) {
        moving.length[end] = segment.length;
        moving.base_radius[end] = segment.base_radius;
        moving.tip_radius[end] = segment.tip_radius;
    }

    void add_segment(std::uint32_t index, const SegmentPiece& piece) {
        const Segment& segment = after.segments[index];
        MovingSegment moving;
        moving.motion.parent = segment.parent;
        set_end(moving.motion, 1, segment.base, segment.frame);
        set_shape(moving, 1, segment);
        if (piece.segment == kNoSegment) {
            set_vanished(moving.motion, 0);
            ++counts.grown;
        } else {
            const Segment& old = before.segments[piece.segment];
            const glm::dquat frame(old.frame);
            const double low = static_cast<double>(old.length) * static_cast<double>(piece.low);
            set_end(moving.motion, 0, tip_of(old.base, frame, low), frame);
            moving.length[0] = old.length * (piece.high - piece.low);
            moving.base_radius[0] = static_cast<float>(
                interpolated(old.base_radius, old.tip_radius, static_cast<double>(piece.low)));
            moving.tip_radius[0] = static_cast<float>(
                interpolated(old.base_radius, old.tip_radius, static_cast<double>(piece.high)));
            const glm::vec3& offset = moving.motion.offset[0];
            const double near = kRounding * (1.0 + static_cast<double>(glm::length(old.base)));
            if (segment.linked && static_cast<double>(glm::length(offset)) > near) {
                moving.is_apart = true;
            } else if (segment.linked) {
                moving.motion.offset = {};
            }
            new_segments[piece.segment] = index; // the last piece replaces earlier ones
            ++counts.kept;
        }
        use_shorter_turn(moving.motion.turn);
        add_joints(moving);
        segments.push_back(moving);
    }

    void add_shrinking_segment(std::uint32_t index) {
        const Segment& segment = before.segments[index];
        MovingSegment moving;
        moving.motion.parent = new_segment_of(segment.parent);
        set_end(moving.motion, 0, segment.base, segment.frame);
        set_shape(moving, 0, segment);
        set_vanished(moving.motion, 1);
        new_segments[index] = static_cast<std::uint32_t>(segments.size());
        add_joints(moving);
        segments.push_back(moving);
        shrinking_segments.push_back(index);
        ++counts.vanished;
    }

    void move_segments(const std::vector<SegmentPiece>& pieces) {
        new_segments.assign(before.segments.size(), kNoSegment);
        for (std::uint32_t i = 0; i < after.segments.size(); ++i) {
            add_segment(i, pieces[i]);
        }
        for (std::uint32_t i = 0; i < before.segments.size(); ++i) {
            if (new_segments[i] == kNoSegment) {
                add_shrinking_segment(i);
            }
        }
    }

    void move_objects(const std::vector<std::uint32_t>& old_of) {
        std::vector<bool> is_kept(before.objects.size(), false);
        for (std::uint32_t i = 0; i < after.objects.size(); ++i) {
            const PlacedObject& object = after.objects[i];
            MovingObject moving;
            moving.motion.parent = object.parent;
            set_end(moving.motion, 1, object.position, object.frame);
            moving.size[1] = object.size;
            if (old_of[i] == kNone) {
                set_vanished(moving.motion, 0);
                ++counts.grown;
            } else {
                const PlacedObject& old = before.objects[old_of[i]];
                set_end(moving.motion, 0, old.position, old.frame);
                moving.size[0] = old.size;
                if (is_organ(object) &&
                    points_of(before, old).size() <= points_of(after, object).size()) {
                    moving.old = old_of[i];
                }
                is_kept[old_of[i]] = true;
                ++counts.kept;
            }
            use_shorter_turn(moving.motion.turn);
            objects.push_back(moving);
        }
        for (std::uint32_t i = 0; i < before.objects.size(); ++i) {
            if (is_kept[i]) {
                continue;
            }
            const PlacedObject& object = before.objects[i];
            MovingObject moving;
            moving.motion.parent = new_segment_of(object.parent);
            set_end(moving.motion, 0, object.position, object.frame);
            moving.size[0] = object.size;
            set_vanished(moving.motion, 1);
            objects.push_back(moving);
            shrinking_objects.push_back(i);
            ++counts.vanished;
        }
    }

    /// The corner of a polygon relative to the parent's tip, in the parent's frame.
    [[nodiscard]] glm::vec3
    local_corner(const glm::vec3& corner, std::uint32_t parent, std::size_t end) const {
        const Joint from = joint(parent, end);
        return {glm::conjugate(from.frame) * (glm::dvec3(corner) - from.tip)};
    }

    /// Adds the corners in the drawing `end`; in the other drawing all corners are one point.
    void add_corners(const glm::vec3* first,
                     std::uint32_t count,
                     std::uint32_t parent,
                     std::size_t end) {
        const glm::vec3 vanished =
            parent == kNoSegment ? local_corner(*first, parent, end) : glm::vec3(0.0F);
        for (std::uint32_t i = 0; i < count; ++i) {
            BeforeAndAfter<glm::vec3>& corner = corners.emplace_back();
            corner[end] = local_corner(first[i], parent, end);
            corner[1 - end] = vanished;
        }
    }

    void move_polygons(const std::vector<std::uint32_t>& old_of) {
        std::vector<bool> is_kept(before.polygons.size(), false);
        for (std::uint32_t i = 0; i < after.polygons.size(); ++i) {
            const Polygon& polygon = after.polygons[i];
            MovingPolygon moving;
            moving.first_corner = static_cast<std::uint32_t>(corners.size());
            moving.motion.parent = polygon.parent;
            set_end(moving.motion, 1, {}, polygon.frame);
            add_corners(&after.corners[polygon.first_corner], polygon.corner_count, polygon.parent,
                        1);
            if (old_of[i] == kNone) {
                set_vanished(moving.motion, 0);
                ++counts.grown;
            } else {
                const Polygon& old = before.polygons[old_of[i]];
                set_end(moving.motion, 0, {}, old.frame);
                for (std::uint32_t k = 0; k < polygon.corner_count; ++k) {
                    // If the polygon has more corners than the old one, several adjacent corners
                    // begin at one old corner.
                    const auto at = static_cast<std::uint32_t>(std::uint64_t{k} * old.corner_count /
                                                               polygon.corner_count);
                    corners[moving.first_corner + k][0] =
                        local_corner(before.corners[old.first_corner + at], polygon.parent, 0);
                }
                is_kept[old_of[i]] = true;
                counts.polygons_with_fewer_corners +=
                    polygon.corner_count < old.corner_count ? 1 : 0;
                ++counts.kept;
            }
            use_shorter_turn(moving.motion.turn);
            polygons.push_back(moving);
        }
        for (std::uint32_t i = 0; i < before.polygons.size(); ++i) {
            if (is_kept[i]) {
                continue;
            }
            const Polygon& polygon = before.polygons[i];
            MovingPolygon moving;
            moving.first_corner = static_cast<std::uint32_t>(corners.size());
            moving.motion.parent = new_segment_of(polygon.parent);
            set_end(moving.motion, 0, {}, polygon.frame);
            set_vanished(moving.motion, 1);
            add_corners(&before.corners[polygon.first_corner], polygon.corner_count,
                        moving.motion.parent, 0);
            polygons.push_back(moving);
            shrinking_polygons.push_back(i);
            ++counts.vanished;
        }
    }

    static void copy_drawing(const Skeleton& from, Skeleton& out) {
        out.segments = from.segments;
        out.objects = from.objects;
        out.polygons = from.polygons;
        out.corners = from.corners;
        out.organs = from.organs;
        out.organ_points = from.organ_points;
    }

    /// Copies the drawing of `after`, then the shrinking items of `before`. pose() then moves all
    /// items.
    void copy_fixed(Skeleton& out) const {
        copy_drawing(after, out);
        for (const std::uint32_t index : shrinking_segments) {
            out.segments.push_back(before.segments[index]);
        }
        for (const std::uint32_t index : shrinking_objects) {
            PlacedObject object = before.objects[index];
            copy_organ(before, object, out);
            out.objects.push_back(object);
        }
        for (const std::uint32_t index : shrinking_polygons) {
            out.polygons.push_back(before.polygons[index]);
        }
        out.corners.resize(corners.size());
    }

    /// Moves the points of the organ `object` from those of object `old` of `before` towards their
    /// places in `after`. Points that the old organ lacks start at its last point.
    void pose_organ(std::uint32_t old,
                    double progress,
                    const PlacedObject& object,
                    Skeleton& out) const {
        const std::span<const OrganPoint> from = points_of(before, before.objects[old]);
        const Organ& organ = out.organs[object.mesh_file];
        const auto part = static_cast<float>(progress);
        for (std::uint32_t k = 0; k < organ.point_count; ++k) {
            const OrganPoint& old_point = from[std::min<std::size_t>(k, from.size() - 1)];
            OrganPoint& point = out.organ_points[organ.first_point + k];
            point.position = glm::mix(old_point.position, point.position, part);
            BeforeAndAfter<glm::quat> turn{old_point.frame, point.frame};
            use_shorter_turn(turn);
            point.frame = glm::quat(interpolated(turn, progress));
            point.width = glm::mix(old_point.width, point.width, part);
        }
    }

    void pose(double part, Skeleton& out) const {
        const double ease = eased(part);
        std::vector<Joint> placed(segments.size());
        const Joint root;
        const auto joint_of = [&](const Motion& motion) -> const Joint& {
            return motion.parent == kNoSegment ? root : placed[motion.parent];
        };
        const auto place_of = [&](const Motion& motion, double now_part) {
            const Joint& from = joint_of(motion);
            return Joint{glm::normalize(from.frame * interpolated(motion.turn, now_part)),
                         from.tip + from.frame * interpolated(motion.offset, now_part)};
        };
        for (std::size_t i = 0; i < segments.size(); ++i) {
            const MovingSegment& moving = segments[i];
            const double progress = moving.motion.eases ? ease : part;
            const Joint base = place_of(moving.motion, progress);
            const double length = interpolated(moving.length[0], moving.length[1], progress);
            placed[i] = {base.frame, tip_of(base.tip, base.frame, length)};
            Segment& segment = out.segments[i];
            segment.base = base.tip;
            segment.frame = base.frame;
            segment.length = static_cast<float>(length);
            segment.base_radius = static_cast<float>(
                interpolated(moving.base_radius[0], moving.base_radius[1], progress));
            segment.tip_radius = static_cast<float>(
                interpolated(moving.tip_radius[0], moving.tip_radius[1], progress));
            segment.parent = moving.motion.parent;
            segment.linked = segment.linked && !moving.is_apart;
        }
        for (std::size_t i = 0; i < objects.size(); ++i) {
            const MovingObject& moving = objects[i];
            const double progress = moving.motion.eases ? ease : part;
            const Joint at = place_of(moving.motion, progress);
            PlacedObject& object = out.objects[i];
            object.position = at.tip;
            object.frame = at.frame;
            object.size =
                static_cast<float>(interpolated(moving.size[0], moving.size[1], progress));
            object.parent = moving.motion.parent;
            if (moving.old != kNone) {
                pose_organ(moving.old, progress, object, out);
            }
        }
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            const MovingPolygon& moving = polygons[i];
            const double progress = moving.motion.eases ? ease : part;
            const Joint& from = joint_of(moving.motion);
            Polygon& polygon = out.polygons[i];
            polygon.frame = place_of(moving.motion, progress).frame;
            polygon.parent = moving.motion.parent;
            polygon.first_corner = moving.first_corner;
            for (std::uint32_t k = 0; k < polygon.corner_count; ++k) {
                out.corners[polygon.first_corner + k] =
                    from.tip +
                    from.frame * interpolated(corners[moving.first_corner + k], progress);
            }
        }
    }
};

SkeletonGrowth::SkeletonGrowth(Skeleton before,
                               Skeleton after,
                               std::uint32_t generation,
                               std::span<const Origin> ancestors)
    : state_(std::make_unique<State>()) {
    State& state = *state_;
    state.before = std::move(before);
    state.after = std::move(after);
    const Correspondence found =
        find_correspondence(state.before, state.after, generation, ancestors);
    state.move_segments(found.pieces);
    state.move_objects(found.objects);
    state.move_polygons(found.polygons);
    state.joints = {};
    state.new_segments = {};
}

SkeletonGrowth::~SkeletonGrowth() = default;
SkeletonGrowth::SkeletonGrowth(SkeletonGrowth&&) noexcept = default;
SkeletonGrowth& SkeletonGrowth::operator=(SkeletonGrowth&&) noexcept = default;

void SkeletonGrowth::pose(double part, Skeleton& out) const {
    out.mesh_files = state_->after.mesh_files;
    out.looks = state_->after.looks;
    out.contours = state_->after.contours;
    out.l3d_compatible_surface = state_->after.l3d_compatible_surface;
    out.leaf_droop = state_->after.leaf_droop;
    out.box_segments = state_->after.box_segments;
    out.tube_shape = state_->after.tube_shape;
    if (part <= 0.0) {
        State::copy_drawing(state_->before, out);
    } else if (part >= 1.0) {
        State::copy_drawing(state_->after, out);
    } else {
        state_->copy_fixed(out);
        state_->pose(part, out);
    }
}

const Skeleton& SkeletonGrowth::before() const {
    return state_->before;
}
const Skeleton& SkeletonGrowth::after() const {
    return state_->after;
}
Skeleton SkeletonGrowth::take_after() {
    return std::move(state_->after);
}
const GrowthCounts& SkeletonGrowth::counts() const {
    return state_->counts;
}
std::uint64_t SkeletonGrowth::byte_count() const {
    return state_->before.byte_count() + state_->after.byte_count() +
           state_->segments.size() * sizeof(MovingSegment) +
           state_->objects.size() * sizeof(MovingObject) +
           state_->polygons.size() * sizeof(MovingPolygon) +
           state_->corners.size() * sizeof(BeforeAndAfter<glm::vec3>);
}

} // namespace lsys
