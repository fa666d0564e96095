// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/axis_reader.h"

#include "runtime/meshing/impl/axis_levels.h"
#include "runtime/meshing/impl/directions.h"
#include "runtime/meshing/impl/joint_curves.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

// Points nearer to each other than this fraction of their coordinates count as equal.
constexpr float kResolution = 4e-6F;
// A radius below this fraction of the coordinates counts as 0.
constexpr float kNoRadius = 1e-8F;
// Min radius per side, as a fraction of the coordinates: keeps the corners of a ring apart.
constexpr float kRadiusPerSide = 4e-7F;
// Min radius of a ring relative to the edges beside it, so that its triangles have an area.
constexpr float kThinnest = 1e-9F;
constexpr float kMinRadius = 1e-36F;    // m; a thinner ring counts as a point
constexpr float kMaxRadius = 1e36F;     // m
constexpr std::uint32_t kMaxLevels = 8; // a higher MeshOptions::level counts as this
// Max radius of the hidden ring of a branch, as a fraction of the inner radius of its parent.
constexpr float kHidden = 0.9F;
constexpr float kThickestBranch = 1.5F; // in radii of the parent; thicker ones have closed bases
constexpr float kCollarSlope = 0.13F;   // increase of radius per length towards the base
constexpr float kMinSine = 0.5F;     // min sine of a branch's angle, for the length of its collar
constexpr float kMaxCollar = 0.7F;   // max length of a collar per length of its edge
constexpr float kCollarReach = 1.5F; // by `#set collar`, from the surface, in radii of the parent
constexpr std::array<std::uint32_t, kMaxShapedLevel + 1> kSidesPerRoot{6, 4}; // by level
constexpr float kMaxParts = 16.0F;      // max pieces into which an edge is cut for noise
constexpr std::size_t kExtraJoints = 2; // joints beside those of segments: a collar and the tip

float max_coordinate(const glm::vec3& v) {
    return std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
}

/// Whether a ring is thick enough relative to the joint before it and to the edge after it, of
/// `length`, so that its triangles have an area.
bool is_ring_thick_enough(float radius, const Joint& before, float length) {
    return radius >= kThinnest * std::max(std::max(before.radius, before.length), length);
}

/// Number of rings at a joint: one for bends up to 60 degrees, two up to 120 degrees, else three.
std::uint8_t rings_of_bend(const glm::vec3& before, const glm::vec3& after) {
    const float cosine = glm::dot(before, after);
    return cosine >= 0.5F ? 1 : cosine >= -0.5F ? 2 : 3;
}

/// An odd number near `sides`. The width of a polygon varies with the view by 1 / cos(pi / 2n) for
/// odd n and by 1 / cos(pi / n) for even n: five sides are nearer to round than eight, and three
/// are as near as six.
std::uint32_t fewer_sides(std::uint32_t sides) {
    return sides <= 3 ? 3 : sides == 4 ? 5 : (sides - 1) | 1U;
}

/// Prefetches both cache lines that the segment may lie in.
void prefetch(const Segment& segment) {
    __builtin_prefetch(&segment);
    __builtin_prefetch(&segment.sides);
}

} // namespace

float drawn_radius(float radius, const glm::vec3& centre, std::uint32_t sides) {
    const float far = max_coordinate(centre);
    if (!(radius > std::max(kNoRadius * far, kMinRadius))) {
        return 0.0F;
    }
    return std::min(std::max(radius, kRadiusPerSide * static_cast<float>(sides) * far), kMaxRadius);
}

bool coincide(const glm::vec3& a, const glm::vec3& b, float radius) {
    return !(max_coordinate(b - a) > kResolution * (max_coordinate(a) + radius));
}

AxisReader::AxisReader(const Skeleton& skeleton, const Axes& axes, const MeshOptions& options)
    : skeleton_(skeleton), axes_(axes), options_(options) {
    const std::uint32_t level = std::min(options.level, kMaxLevels);
    if (options.deviation > 0.0F) {
        counts_.emplace(options.deviation);
    }
    for (std::uint32_t i = 0; i < sides_.size(); ++i) {
        const std::uint32_t whole = usable_sides(options.sides != 0 ? options.sides : i);
        const std::uint32_t fewer = level == 0 ? whole : fewer_sides(whole >> level);
        sides_[i] = static_cast<std::uint8_t>(counts_ ? whole : fewer);
        widening_[i] = counts_ ? 1.0F : widening(whole, fewer);
        max_sides_[whole] = static_cast<std::uint8_t>(fewer);
    }
}

void AxisReader::start(std::uint32_t first_segment) {
    segment_ = first_segment;
    attached_ = true;
    std::size_t segments = 0;
    for (std::uint32_t at = first_segment; at < kForked; at = axes_.next[at]) {
        ++segments;
    }
    joints_.clear();
    if (const std::size_t joints = segments + kExtraJoints; joints > joints_.capacity()) {
        // All memory is reserved at once: growing the array later would need as much memory again.
        joints_.reserve(std::max(joints, 2 * joints_.capacity()));
    }
}

bool AxisReader::next(Run& run) {
    while (segment_ < kForked) {
        if (read(run)) {
            return true;
        }
        attached_ = false;
    }
    return false;
}

/// Reads joints up to a gap or the end of the axis. Returns false if there are none.
bool AxisReader::read(Run& run) {
    joints_.clear();
    stale_ = false;
    rings_final_ = true;
    flare_ = {};
    base_widening_ = {};
    run.has_roots = false;
    const Segment* last = nullptr;
    bool pointed = false;
    std::uint32_t at = segment_;
    for (std::uint32_t after = 0; at < kForked; at = after) {
        after = axes_.next[at];
        if (after < kForked) {
            // In memory, the next segment of the axis lies behind the segments of the branches.
            prefetch(skeleton_.segments[after]);
        }
        const Segment& segment = skeleton_.segments[at];
        if (!(segment.length > 0.0F)) {
            continue;
        }
        const float wider = widening_[segment.sides];
        const float radius =
            drawn_radius(segment.base_radius * wider, segment.base, sides_of(segment));
        const bool draws = radius > 0.0F || drawn_radius(segment.tip_radius * wider, segment.base,
                                                         sides_of(segment)) > 0.0F;
        pointed = last != nullptr && radius == 0.0F;
        if (pointed || (last != nullptr && !draws)) {
            pointed = draws;
            break;
        }
        if (!draws) {
            attached_ = false;
            continue;
        }
        if (last == nullptr) {
            run.first_segment = at;
        }
        add(segment, radius);
        last = &segment;
    }
    segment_ = at;
    if (last == nullptr) {
        return false;
    }
    const glm::vec3 end = tip(*last);
    const float end_radius =
        pointed ? 0.0F
                : drawn_radius(last->tip_radius * widening_[last->sides], end, sides_of(*last));
    if (!add_end(end, end_radius)) {
        return false;
    }
    run.side = side_of(skeleton_, run.first_segment);
    run.end = joints_.back().radius == 0.0F ? TubeEnd::Point
              : at == kForked               ? TubeEnd::Ball
                                            : TubeEnd::Blunt;
    const TubeShape& shape = skeleton_.tube_shape;
    if (shape.tips != TipShape::Flat && run.end == TubeEnd::Blunt && is_shaped(*last)) {
        run.end = shape.tips == TipShape::Round ? TubeEnd::Round : TubeEnd::Broken;
    }
    std::optional<CurveStart> start;
    const bool open = attached_ && fit_into_parent(run, start);
    run.begin = joints_.front().radius == 0.0F ? TubeEnd::Point
                : open                         ? TubeEnd::Open
                                               : TubeEnd::Flat;
    attached_ = false;
    if (shape.has_flare() && stands_on_ground(skeleton_.segments[run.first_segment], shape.flare)) {
        base_widening_ = widening_of(shape.flare);
        run.has_roots = shape.flare.roots > 0 && options_.level <= kMaxShapedLevel;
    }
    if (base_widening_.end > 0.0F) {
        widen_base(open);
    }
    if (options_.smooth_joints && bend_edges(joints_, spare_, start)) {
        rings_final_ = false;
    }
    const bool leaves_out = options_.level > 0 || options_.axis_error > 0.0F;
    if (leaves_out) {
        const float tolerance =
            std::min(0.05F * static_cast<float>(1U << std::min(options_.level, kMaxLevels)), 0.5F);
        leave_out_joints(joints_, spare_, tolerance, options_.axis_error);
    }
    const bool has_normal_map = options_.bark_noise > 0.0F || options_.grooves > 0.0F;
    if (has_normal_map) {
        subdivide();
    }
    if (counts_) {
        fit_sides();
        joints_.front().radius =
            open ? std::min(joints_.front().radius, max_base_radius_) : joints_.front().radius;
        run.radii = radii_;
    }
    if (run.has_roots) {
        add_root_sides();
    }
    if (!rings_final_ || counts_ || leaves_out || has_normal_map) {
        set_rings();
    }
    run.joints = joints_;
    return true;
}

void AxisReader::add(const Segment& segment, float radius) {
    glm::vec3 centre = segment.base;
    if (!joints_.empty()) {
        Joint& before = joints_.back();
        if (coincide(before.centre, centre, radius)) {
            centre = before.centre;
            joints_.pop_back();
            stale_ = true;
            rings_final_ = false;
        } else if (stale_) {
            aim(before, centre);
            stale_ = false;
        }
    }
    // Constructed in place: copying a joint just written would stall on store forwarding.
    Joint& joint = joints_.emplace_back();
    joint.centre = centre;
    joint.radius = radius;
    joint.heading = direction(segment.frame);
    joint.length = segment.length;
    joint.colour = segment.colour;
    joint.sides = sides_of(segment);
    if (joints_.size() > 1) {
        const Joint& before = joints_[joints_.size() - 2];
        joint.rings = rings_of_bend(before.heading, joint.heading);
        rings_final_ = rings_final_ && is_ring_thick_enough(radius, before, joint.length) &&
                       before.radius >= kThinnest * radius;
    }
}

/// Adds the last joint of a run. Returns false if the run has no edge that is long and thick enough
/// to be drawn.
bool AxisReader::add_end(const glm::vec3& centre, float radius) {
    while (joints_.size() > 1 && coincide(joints_.back().centre, centre, joints_.back().radius)) {
        joints_.pop_back();
        stale_ = true;
        rings_final_ = false;
    }
    Joint& before = joints_.back();
    if (coincide(before.centre, centre, std::max(before.radius, radius)) ||
        (joints_.size() == 1 && before.radius == 0.0F && radius == 0.0F)) {
        return false;
    }
    if (stale_) {
        aim(before, centre);
    }
    Joint end = before;
    end.centre = centre;
    end.radius = radius;
    end.length = 0.0F;
    end.rings = 1;
    rings_final_ = rings_final_ && (radius == 0.0F || is_ring_thick_enough(radius, before, 0.0F)) &&
                   before.radius >= kThinnest * std::max(radius, before.length);
    joints_.push_back(end);
    if (joints_.front().radius == 0.0F) { // a pointed end has the sides of the ring beside it
        joints_.front().sides = joints_[1].sides;
    }
    return true;
}

/// Fits the base of a run into the tube from which the axis branches; returns false if the base
/// lies outside of this tube.
bool AxisReader::fit_into_parent(const Run& run, std::optional<CurveStart>& start) {
    const Segment& child = skeleton_.segments[run.first_segment];
    if (child.parent >= run.first_segment) {
        return false;
    }
    const Segment& parent = skeleton_.segments[child.parent];
    if (!joins(parent, child)) {
        return false;
    }
    const std::uint32_t after = axes_.next[child.parent];
    float radius = widening_[parent.sides] *
                   (after < kForked ? skeleton_.segments[after].base_radius : parent.tip_radius);
    std::uint32_t sides = sides_of(parent);
    if (counts_) {
        sides = counts_->at(radius, max_sides_[sides_of(parent)]);
        radius *= counts_->widening(sides_of(parent), sides);
    }
    const float hidden = kHidden * inner_radius(sides) * radius;
    Joint& base = joints_.front();
    if (!(parent.length > 0.0F) || base.radius > kThickestBranch * radius ||
        drawn_radius(hidden, base.centre, base.sides) == 0.0F) {
        return false;
    }
    const float own = base.radius;
    const glm::vec3 tangent = tip_tangent(parent, after);
    const bool leaves_along = options_.smooth_joints && can_leave_along(tangent, base.heading);
    const bool has_wide_collar = set_wide_collar(child, radius);
    float reach = 0.0F;
    if (has_wide_collar) {
        // widen_base() adds the collar.
    } else if (leaves_along) {
        reach = collar_length(parent, radius);
        if (options_.level == 0 && reach < kMaxCollar * base.length && own > 0.0F) {
            joints_.front().radius += kCollarSlope * reach;
        }
    } else if (options_.level == 0) {
        add_collar(parent, radius);
    }
    joints_.front().radius = std::min(joints_.front().radius, hidden);
    if (leaves_along) {
        const float flare = has_wide_collar ? 0.0F : joints_.front().radius - own;
        start = CurveStart{tangent, flare, reach};
    }
    max_base_radius_ = hidden;
    flare_[0] = std::min(flare_[0], hidden);
    return true;
}

/// The tangent at the tip of `segment` of a smooth curve through this tip. `next`: the segment that
/// continues `segment`; at least kForked: none.
glm::vec3 AxisReader::tip_tangent(const Segment& segment, std::uint32_t next) const {
    const glm::vec3 own = direction(segment.frame);
    if (next >= kForked || !(skeleton_.segments[next].length > 0.0F)) {
        return own;
    }
    return joint_tangent(own, direction(skeleton_.segments[next].frame)).value_or(own);
}

/// Length of the collar of the run along its first edge.
float AxisReader::collar_length(const Segment& parent, float parent_radius) const {
    const Joint& base = joints_[0];
    const float cosine = glm::dot(heading(parent.frame), base.heading);
    const float sine = std::sqrt(std::max(1.0F - cosine * cosine, kMinSine * kMinSine));
    return parent_radius / sine + 1.5F * base.radius;
}

/// Adds the collar: a cone, with a ring of its own, by which a branch widens towards its parent.
void AxisReader::add_collar(const Segment& parent, float parent_radius) {
    Joint& base = joints_[0];
    const float reach = collar_length(parent, parent_radius);
    if (!(reach < kMaxCollar * base.length) || base.radius == 0.0F ||
        coincide(base.centre, base.centre + reach * base.heading, base.radius)) {
        return;
    }
    if (counts_ && !(options_.bark_noise > 0.0F)) {
        // The longest possible collar decides the sides, so that they stay the same when the plant
        // bends.
        const float longest = parent_radius / kMinSine + 1.5F * base.radius;
        const float widest = std::max(joints_[1].radius - base.radius, 0.0F);
        flare_ = {base.radius + kCollarSlope * longest,
                  base.radius + widest * std::min(longest / base.length, 1.0F)};
    }
    Joint collar = base;
    collar.centre = base.centre + reach * base.heading;
    collar.radius += (joints_[1].radius - base.radius) * (reach / base.length);
    collar.length = base.length - reach;
    base.length = reach;
    base.radius += kCollarSlope * reach;
    joints_.insert(joints_.begin() + 1, collar);
}

/// Whether a segment is thick and the level fine enough for a collar or a shaped tip.
bool AxisReader::is_shaped(const Segment& segment) const {
    return options_.level <= kMaxShapedLevel &&
           usable_sides(options_.sides != 0 ? options_.sides : segment.sides) >= kMinShapedSides;
}

/// Sets the widening of a branch by `#set collar`; returns false if the branch has none. The length
/// of the widening does not depend on the angle of the branch, so that the number of joints stays
/// the same when the plant bends.
bool AxisReader::set_wide_collar(const Segment& child, float parent_radius) {
    const float own = joints_.front().radius;
    const float extra = std::min(skeleton_.tube_shape.collar * own, parent_radius) - own;
    const float end = (1.0F + kCollarReach) * parent_radius;
    if (!(extra > 0.0F && own > 0.0F) || !is_shaped(child)) {
        return false;
    }
    float length = 0.0F;
    for (std::size_t i = 0; i < joints_.size() && length < end; ++i) {
        length += joints_[i].length;
    }
    if (!(length >= end)) {
        return false;
    }
    base_widening_ = {
        .begin = parent_radius, .end = end, .factor = 0.0F, .radius = extra, .parts = kCollarParts};
    return true;
}

/// Applies base_widening_: adds joints within its length and widens all joints within its length.
/// `open`: the run begins inside of its parent.
void AxisReader::widen_base(bool open) {
    const BaseWidening& wide = base_widening_;
    const float step = (wide.end - wide.begin) / static_cast<float>(wide.parts);
    std::uint32_t part = wide.begin > 0.0F ? 0 : 1;
    float arc = 0.0F;
    spare_.clear();
    for (std::size_t i = 0; i + 1 < joints_.size(); ++i) {
        const Joint from = joints_[i];
        const Joint& to = joints_[i + 1];
        const auto put = [&](const Joint& joint, float at) {
            spare_.push_back(joint);
            float& radius = spare_.back().radius;
            radius = std::min(radius > 0.0F ? wide.widened(radius, at) : 0.0F, kMaxRadius);
        };
        put(from, arc);
        float begin = 0.0F; // begin of the last piece, as distance from the begin of the edge
        for (; part <= wide.parts; ++part) {
            const float along = wide.begin + static_cast<float>(part) * step - arc;
            if (!(along < from.length)) {
                break;
            }
            const float share = along / from.length;
            Joint joint = from;
            joint.centre = from.centre + share * (to.centre - from.centre);
            joint.radius = from.radius + share * (to.radius - from.radius);
            joint.length = from.length - along;
            joint.rings = 1;
            if (along > begin && !coincide(spare_.back().centre, joint.centre, joint.radius) &&
                !coincide(joint.centre, to.centre, joint.radius) &&
                drawn_radius(joint.radius, joint.centre, joint.sides) > 0.0F) {
                spare_.back().length = along - begin;
                put(joint, arc + along);
                begin = along;
            }
        }
        arc += from.length;
    }
    spare_.push_back(joints_.back());
    Joint& last = spare_.back();
    last.radius = std::min(last.radius > 0.0F ? wide.widened(last.radius, arc) : 0.0F, kMaxRadius);
    joints_.swap(spare_);
    if (open) {
        joints_.front().radius = std::min(joints_.front().radius, max_base_radius_);
    }
    rings_final_ = false;
}

/// Gives the rings with buttress roots enough sides to show these.
void AxisReader::add_root_sides() {
    const Flare& flare = skeleton_.tube_shape.flare;
    const std::uint32_t wanted = std::min(kSidesPerRoot[options_.level] * flare.roots, kMaxSides);
    float arc = 0.0F;
    for (Joint& joint : joints_) {
        if (!(arc < flare.height)) {
            break;
        }
        joint.sides = static_cast<std::uint8_t>(std::max<std::uint32_t>(joint.sides, wanted));
        arc += joint.length;
    }
}

/// Cuts edges into pieces about as long as the tube is thick, to get rings that noise can move.
void AxisReader::subdivide() {
    spare_.clear();
    for (std::size_t i = 0; i + 1 < joints_.size(); ++i) {
        const Joint& from = joints_[i];
        const Joint& to = joints_[i + 1];
        const float thickness = std::max(from.radius, to.radius) *
                                static_cast<float>(1U << std::min(options_.level, kMaxLevels));
        const float parts =
            std::clamp(std::ceil(from.length / (2.0F * thickness)), 1.0F, kMaxParts);
        const float piece = from.length / parts;
        for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(parts); ++k) {
            Joint joint = from;
            const float share = static_cast<float>(k) / parts;
            joint.centre = from.centre + share * (to.centre - from.centre);
            joint.radius = from.radius + share * (to.radius - from.radius);
            joint.length = piece;
            if (k > 0 && (coincide(spare_.back().centre, joint.centre, joint.radius) ||
                          coincide(joint.centre, to.centre, joint.radius) ||
                          drawn_radius(joint.radius, joint.centre, joint.sides) == 0.0F)) {
                spare_.back().length += piece;
                continue;
            }
            spare_.push_back(joint);
        }
    }
    spare_.push_back(joints_.back());
    joints_.swap(spare_);
}

/// Reduces the sides of each joint to the number that MeshOptions::deviation needs at its radius.
void AxisReader::fit_sides() {
    radii_.clear();
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        Joint& joint = joints_[i];
        radii_.push_back(joint.radius);
        const bool flares = i < flare_.size() && flare_[i] > 0.0F;
        const std::uint32_t sides =
            counts_->at(flares ? flare_[i] : joint.radius, max_sides_[joint.sides]);
        joint.radius = std::min(joint.radius * counts_->widening(joint.sides, sides), kMaxRadius);
        joint.sides = static_cast<std::uint8_t>(sides);
    }
    // A pointed end has the sides of the ring beside it.
    if (joints_.front().radius == 0.0F) {
        joints_.front().sides = joints_[1].sides;
    }
    if (joints_.back().radius == 0.0F) {
        joints_.back().sides = joints_[joints_.size() - 2].sides;
    }
}

/// Sets the number of rings of each joint by its bend, and widens joints that are too thin for the
/// joints beside them.
void AxisReader::set_rings() {
    const std::size_t last = joints_.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
        Joint& joint = joints_[i];
        const Joint& before = joints_[i == 0 ? 0 : i - 1];
        const Joint& after = joints_[i == last ? i : i + 1];
        joint.rings =
            i == 0 || i == last ? std::uint8_t{1} : rings_of_bend(before.heading, joint.heading);
        if (joint.radius > 0.0F) {
            const float around = std::max(std::max(before.length, joint.length),
                                          std::max(before.radius, after.radius));
            joint.radius = std::max(joint.radius, std::min(kThinnest * around, kMaxRadius));
        }
    }
}

} // namespace lsys
