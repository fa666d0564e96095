// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/box_joints.h"

#include "runtime/meshing/impl/box_writer.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace lsys {

namespace {

// Min ratio of the smaller to the larger radius of a segment.
constexpr float kMinTaper = 0.05F;
// A single child continues its parent if it bends by less than 60 degrees, which has this cosine.
constexpr float kStraight = 0.5F;
// A side whose normal has a smaller cosine with the heading of a child does not face the child.
constexpr float kFacing = 0.35F;
// Min length of a child, relative to the length of its part within the joint.
constexpr float kOutside = 1.25F;
// Min size of the opening of a child, relative to the cross-section of the child. A branch may be
// narrower in its opening if the mesh is smoothed, which hides this; unsmoothed boxes must not be
// narrower there.
constexpr float kSmoothedOpening = 0.4F; // if the mesh is smoothed
constexpr float kExactOpening = 0.98F;   // if it is not
// Rim that keeps the flat ends of smoothed meshes flat, in half sides of the end:
constexpr float kRim = 0.72F;   // half side of the inner square of the end face
constexpr float kBevel = 0.28F; // distance of the last ring from the end face
// Min half side of an end with a rim, relative to its distance from the origin.
constexpr float kMinRim = 2e-4F;
// Overlaps, in half sides, at the tip of a parent whose branches have separate surfaces. That of
// the branches is smaller, so that no thick branch shows on the far side of the parent.
constexpr float kParentOverlap = 0.6F; // of the parent, beyond its tip
constexpr float kBranchOverlap = 0.1F; // of the branches, before this tip
// Min relative difference of widths at which an unsmoothed box has a step.
constexpr float kStep = 0.01F;
// Min step that floats can represent, relative to the distance from the origin.
constexpr float kMinStep = 4e-6F;
// Limits within which a child at the top of a joint continues its parent:
constexpr float kContinues = 0.97F; // min cosine of the bend
constexpr float kSameWidth = 0.15F; // max relative difference of widths
constexpr std::size_t kSides = 5;   // sides of a joint: four around it and the top
constexpr std::size_t kTop = 4;

/// Whether the segment is larger than the resolution of floats at its place.
bool is_drawn(const Segment& segment) {
    const glm::vec3 end = tip(segment);
    const float far =
        std::max({std::abs(segment.base.x), std::abs(segment.base.y), std::abs(segment.base.z),
                  std::abs(end.x), std::abs(end.y), std::abs(end.z)});
    const float radius = std::max(segment.base_radius, segment.tip_radius);
    return radius > 4e-5F * far && segment.length > 4e-6F * far && segment.length > 1e-12F &&
           radius > 1e-12F && radius < 1e12F && far < 1e12F;
}

/// Makes the boxes of all segments, parents first.
class BoxMesher {
public:
    BoxMesher(const Skeleton& skeleton, const BoxShape& shape)
        : skeleton_(skeleton), shape_(shape) {}

    PolygonMesh make() {
        find_children();
        const auto count = static_cast<std::uint32_t>(skeleton_.segments.size());
        socket_of_.assign(count, kNoSegment);
        closed_.assign(count, false);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (drawn_[i]) {
                draw(i);
            }
        }
        return writer_.take();
    }

private:
    [[nodiscard]] std::span<const std::uint32_t> children(std::uint32_t segment) const {
        return std::span(children_).subspan(first_child_[segment],
                                            first_child_[segment + 1] - first_child_[segment]);
    }
    /// Finds the children of each drawn segment; segments without length are replaced by their
    /// children.
    void find_children() {
        const std::size_t count = skeleton_.segments.size();
        drawn_.resize(count);
        std::vector<std::uint32_t> parent(count, kNoSegment);
        first_child_.assign(count + 1, 0);
        for (std::size_t i = 0; i < count; ++i) {
            const Segment& own = skeleton_.segments[i];
            drawn_[i] = is_drawn(own);
            if (own.linked && own.parent != kNoSegment) {
                const Segment& before = skeleton_.segments[own.parent];
                parent[i] = drawn_[own.parent]      ? own.parent
                            : before.length == 0.0F ? parent[own.parent]
                                                    : kNoSegment;
            }
            if (drawn_[i] && parent[i] != kNoSegment) {
                ++first_child_[parent[i] + 1];
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            first_child_[i + 1] += first_child_[i];
        }
        children_.resize(first_child_[count]);
        std::vector<std::uint32_t> next(first_child_.begin(), first_child_.end() - 1);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (drawn_[i] && parent[i] != kNoSegment) {
                children_[next[parent[i]]++] = i;
            }
        }
    }

    struct Widths {
        float base;
        float tip;
    };
    /// Half sides of the box of a segment.
    [[nodiscard]] Widths widths(const Segment& segment) const {
        const float min_radius = kMinTaper * std::max(segment.base_radius, segment.tip_radius);
        return {shape_.width * std::max(segment.base_radius, min_radius),
                shape_.width * std::max(segment.tip_radius, min_radius)};
    }

    void assign_socket(std::uint32_t segment, const BoxSocket& socket) {
        socket_of_[segment] = static_cast<std::uint32_t>(sockets_.size());
        sockets_.push_back(socket);
    }

    void draw(std::uint32_t segment) {
        const Segment& own = skeleton_.segments[segment];
        const Widths w = widths(own);
        const glm::vec3 along = heading(own.frame);
        const float length = own.length;
        writer_.begin_segment(own, segment, w.base);
        // Length of the segment, from its base, that already has a surface.
        float reach = 0.0F;
        if (socket_of_[segment] == kNoSegment) {
            const bool is_cut = own.cut || closed_[segment];
            const bool rimmed = has_rim(w.base, own);
            writer_.begin_root(is_cut ? -kBranchOverlap * w.base : 0.0F, w.base,
                               rimmed ? kRim : 1.0F);
            if (rimmed) {
                reach = std::min(kBevel * w.base, 0.25F * length);
                writer_.add_ring(reach, along, w.base);
            } else if (is_cut) {
                writer_.add_ring(0.0F, along, w.base);
            }
        } else {
            const BoxSocket& socket = sockets_[socket_of_[segment]];
            writer_.begin_at(socket);
            reach = socket.reach;
            if (reach > 0.0F && !socket.continues) {
                const BoxOpening opening = writer_.add_opening(along, w.base);
                reach = std::min(opening.reach, 0.8F * length);
                if (opening.size < kExactOpening || opening.moved) {
                    reach += std::min(0.8F * w.base, 0.4F * (length - reach));
                    writer_.add_ring(reach, along, w.base);
                }
            }
        }
        finish(segment, w.tip, reach);
    }

    /// Whether an end with this half side has a rim: if the mesh is smoothed and floats can
    /// represent the rim.
    [[nodiscard]] bool has_rim(float half, const Segment& segment) const {
        const glm::vec3 end = tip(segment);
        return shape_.smoothed &&
               half > kMinRim * std::max({std::abs(end.x), std::abs(end.y), std::abs(end.z)});
    }

    /// Makes the rest of a segment. `half`: half side of its box at the tip; `reach`: length from
    /// its base that already has a surface.
    void finish(std::uint32_t segment, float half, float reach) {
        const Segment& own = skeleton_.segments[segment];
        const glm::vec3 along = heading(own.frame);
        const std::span<const std::uint32_t> all = children(segment);
        if (all.empty()) {
            const float end = own.length + (own.forked ? kParentOverlap * half : 0.0F);
            const float bevel = std::min(kBevel * half, 0.25F * (own.length - reach));
            const bool rimmed = has_rim(half, own);
            if (own.forked) {
                writer_.add_ring(own.length, along, half);
            } else if (rimmed) {
                writer_.add_ring(end - bevel, along, half);
            }
            writer_.add_ring(end, along, half);
            writer_.close(rimmed ? kRim : 1.0F);
            return;
        }
        if (all.size() == 1) {
            const Segment& child = skeleton_.segments[all[0]];
            const glm::vec3 ahead = heading(child.frame);
            if (glm::dot(along, ahead) > kStraight) {
                const float next = widths(child).base;
                const glm::vec3 end = tip(own);
                const float far = std::max({std::abs(end.x), std::abs(end.y), std::abs(end.z)});
                const bool has_step =
                    !shape_.smoothed &&
                    std::abs(half - next) > std::max(kStep * std::max(half, next), kMinStep * far);
                writer_.add_ring(own.length, along + ahead, has_step ? half : 0.5F * (half + next));
                if (has_step) {
                    writer_.add_ring(own.length, along + ahead, next);
                }
                assign_socket(all[0], writer_.end_socket());
                return;
            }
        }
        branch(segment, half, reach);
    }

    /// Makes the rest of a segment, as finish(), with a joint. Children that fit grow from the
    /// sides of the joint.
    void branch(std::uint32_t segment, float half, float reach) {
        const Segment& own = skeleton_.segments[segment];
        const glm::vec3 along = heading(own.frame);
        const float height = std::min(half, 0.5F * (own.length - reach));
        writer_.add_ring(own.length - height, along, half);
        const BoxJoint joint = writer_.add_joint(own.length + height, along, half);
        // Children in the order of their angle to the parent, so that a child that continues the
        // parent gets the top side.
        const std::span<const std::uint32_t> all = children(segment);
        std::vector<std::uint32_t> order(all.begin(), all.end());
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return glm::dot(along, heading(skeleton_.segments[a].frame)) >
                   glm::dot(along, heading(skeleton_.segments[b].frame));
        });
        std::array<std::vector<std::uint32_t>, kSides> taken;
        for (const std::uint32_t child : order) {
            if (!choose_side(joint, {half, height}, child, taken)) {
                closed_[child] = true;
            }
        }
        for (std::size_t side = 0; side < kSides; ++side) {
            const std::vector<std::uint32_t>& here = taken[side];
            std::vector<glm::vec2> places;
            for (const std::uint32_t child : here) {
                const glm::vec3 ahead = heading(skeleton_.segments[child].frame);
                places.emplace_back(glm::dot(ahead, joint.sides[side].right),
                                    glm::dot(ahead, joint.sides[side].up));
            }
            const std::span<const BoxSocket> sockets = writer_.divide(joint.sides[side], places);
            for (std::size_t i = 0; i < here.size(); ++i) {
                BoxSocket socket = sockets[i];
                const glm::vec3 ahead = heading(skeleton_.segments[here[i]].frame);
                socket.reach = distance_to_side(joint.sides[side], side, {half, height}, ahead);
                socket.continues =
                    here.size() == 1 && continues(joint.sides[side], side, half, here[i]);
                assign_socket(here[i], socket);
            }
        }
    }

    /// Half sides of the joint at the tip of a segment: across the segment, and along it.
    struct JointSize {
        float half;
        float height;
    };

    /// Distance from the middle of a joint to the plane of a side, measured along `direction`.
    static float distance_to_side(const BoxSocket& side,
                                  std::size_t number,
                                  const JointSize& size,
                                  const glm::vec3& direction) {
        return (number == kTop ? size.height : size.half) / glm::dot(direction, side.normal);
    }

    /// Whether a child continues its parent from the top of a joint, about as straight and as wide.
    [[nodiscard]] bool
    continues(const BoxSocket& side, std::size_t number, float half, std::uint32_t child) const {
        const Segment& grown = skeleton_.segments[child];
        const float difference = std::abs(widths(grown).base - half);
        return number == kTop && glm::dot(heading(grown.frame), side.normal) > kContinues &&
               difference < (shape_.smoothed ? kSameWidth : kStep) * half &&
               grown.length > 2.0F * half;
    }

    /// Whether a side has room for the openings of the children `here`, each in its own tile, and
    /// no child ends within its opening.
    [[nodiscard]] bool has_room(const BoxSocket& side,
                                std::size_t number,
                                const JointSize& size,
                                std::span<const std::uint32_t> here) const {
        if (here.size() == 1 && continues(side, number, size.half, here[0])) {
            return true;
        }
        const glm::vec2 halves(size.half, number == kTop ? size.half : size.height);
        for (const std::uint32_t child : here) {
            const Segment& grown = skeleton_.segments[child];
            const glm::vec3 on = heading(grown.frame);
            const float half = widths(grown).base;
            const float facing = glm::dot(on, side.normal);
            const BoxSocket axes = axes_across(side, on);
            glm::vec2 extent(0.0F);
            float rise = 0.0F;
            for (const glm::vec3& axis : {axes.right, axes.up}) {
                const float part = glm::dot(axis, side.normal);
                const glm::vec3 cut = axis - on * (part / facing);
                extent.x += half * std::abs(glm::dot(cut, side.right));
                extent.y += half * std::abs(glm::dot(cut, side.up));
                rise += half * std::abs(part);
            }
            glm::vec2 room = kMaxOpening * halves;
            if (here.size() > 2) { // each opening has a quarter of the side
                room *= 0.5F * kInnerPart;
            } else if (here.size() == 2) { // each opening has a half; divide() splits the side
                const glm::vec3 apart = heading(skeleton_.segments[here[0]].frame) -
                                        heading(skeleton_.segments[here[1]].frame);
                const bool beside =
                    std::abs(glm::dot(apart, side.right)) >= std::abs(glm::dot(apart, side.up));
                room *= kInnerPart;
                (beside ? room.x : room.y) *= 0.5F;
            }
            const float fits = std::min({room.x / extent.x, room.y / extent.y, 1.0F});
            const float out = distance_to_side(side, number, size, on);
            // The opening of an unsmoothed box is centred on the axis of its segment.
            const glm::vec2 centre(out * std::abs(glm::dot(on, side.right)),
                                   out * std::abs(glm::dot(on, side.up)));
            if (!shape_.smoothed &&
                (here.size() > 1 || centre.x + extent.x > room.x || centre.y + extent.y > room.y)) {
                return false;
            }
            if (fits < (shape_.smoothed ? kSmoothedOpening : kExactOpening) ||
                grown.length < kOutside * (out + fits * rise / facing)) {
                return false;
            }
        }
        return true;
    }

    /// Assigns to a child that side, among the sides with room, whose normal is nearest to its
    /// heading; returns false if no side has room.
    bool choose_side(const BoxJoint& joint,
                     const JointSize& size,
                     std::uint32_t child,
                     std::array<std::vector<std::uint32_t>, kSides>& taken) const {
        const glm::vec3 on = heading(skeleton_.segments[child].frame);
        std::array<bool, kSides> tried{};
        while (true) {
            float best = kFacing;
            std::size_t side = kSides;
            for (std::size_t i = 0; i < kSides; ++i) {
                const float facing = glm::dot(on, joint.sides[i].normal);
                if (!tried[i] && facing > best && taken[i].size() < kMaxOnSide) {
                    best = facing;
                    side = i;
                }
            }
            if (side == kSides) {
                return false;
            }
            taken[side].push_back(child);
            if (has_room(joint.sides[side], side, size, taken[side])) {
                return true;
            }
            taken[side].pop_back();
            tried[side] = true;
        }
    }

    const Skeleton& skeleton_;
    const BoxShape& shape_;
    std::vector<bool> drawn_;  // by segment
    std::vector<bool> closed_; // children for which no side of the parent's joint has room
    std::vector<std::uint32_t> first_child_; // by segment: index in children_; last: its size
    std::vector<std::uint32_t> children_;    // segments
    std::vector<std::uint32_t> socket_of_;   // by segment: index in sockets_
    std::vector<BoxSocket> sockets_;
    BoxWriter writer_;
};

} // namespace

PolygonMesh make_boxes(const Skeleton& skeleton, const BoxShape& shape) {
    return BoxMesher(skeleton, shape).make();
}

} // namespace lsys
