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

// Min ratio of the smaller to the larger radius.
constexpr float kMinTaper = 0.05F;
// A single child continues its parent if it bends by less than 60 degrees.
constexpr float kStraight = 0.5F;
// Below this cosine, no side of a joint faces a child.
constexpr float kFacing = 0.35F;
// Min length of a child as a multiple of its way out of the joint.
constexpr float kOutside = 1.25F;
constexpr std::size_t kSides = 5; // of a joint: four and the top

/// Whether the segment is large enough for the resolution of floats at its place.
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
    BoxMesher(const Skeleton& skeleton, float width) : skeleton_(skeleton), width_(width) {}

    PolygonMesh make() {
        find_children();
        const auto count = static_cast<std::uint32_t>(skeleton_.segments.size());
        socket_of_.assign(count, kNoSegment);
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
    /// Drawn children of each drawn parent, skipping segments without length.
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
        return {width_ * std::max(segment.base_radius, min_radius),
                width_ * std::max(segment.tip_radius, min_radius)};
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
        // Length of the segment that is covered so far.
        float reach = 0.0F;
        if (socket_of_[segment] == kNoSegment) {
            writer_.begin_root(w.base);
            if (length > 3.0F * w.base) {
                writer_.add_ring(w.base, along, w.base); // keeps the end from shrinking
            }
        } else {
            const BoxSocket& socket = sockets_[socket_of_[segment]];
            writer_.begin_at(socket);
            reach = socket.reach;
            if (reach > 0.0F) {
                reach += std::min(0.8F * w.base, 0.4F * (length - reach));
                writer_.add_ring(reach, socket.normal + 2.0F * along, w.base);
            }
        }
        finish(segment, w.tip, reach);
    }

    void finish(std::uint32_t segment, float half, float reach) {
        const Segment& own = skeleton_.segments[segment];
        const glm::vec3 along = heading(own.frame);
        const std::span<const std::uint32_t> all = children(segment);
        if (all.empty()) {
            if (own.length - reach > 3.0F * half) {
                writer_.add_ring(own.length - half, along, half);
            }
            writer_.add_ring(own.length, along, half);
            writer_.close();
            return;
        }
        if (all.size() == 1) {
            const Segment& child = skeleton_.segments[all[0]];
            const glm::vec3 ahead = heading(child.frame);
            if (glm::dot(along, ahead) > kStraight) {
                writer_.add_ring(own.length, along + ahead, 0.5F * (half + widths(child).base));
                assign_socket(all[0], writer_.end_socket());
                return;
            }
        }
        branch(segment, half, reach);
    }

    /// Makes a joint whose sides carry the children that fit.
    void branch(std::uint32_t segment, float half, float reach) {
        const Segment& own = skeleton_.segments[segment];
        const glm::vec3 along = heading(own.frame);
        const float height = std::min(half, 0.5F * (own.length - reach));
        writer_.add_ring(own.length - height, along, half);
        const BoxJoint joint = writer_.add_joint(own.length + height, along, half);
        const glm::vec3 extent(half, half, height);
        std::array<std::vector<std::uint32_t>, kSides> wanted;
        for (const std::uint32_t child : children(segment)) {
            const Segment& grown = skeleton_.segments[child];
            const glm::vec3 ahead = heading(grown.frame);
            if (grown.length > kOutside * way_out(joint, extent, ahead)) {
                choose_side(joint, ahead, child, wanted);
            }
        }
        for (std::size_t side = 0; side < kSides; ++side) {
            const std::vector<std::uint32_t>& here = wanted[side];
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
                socket.reach = way_out(joint, extent, ahead);
                assign_socket(here[i], socket);
            }
        }
    }

    /// Length of a ray from the middle of a joint's box to its surface.
    static float
    way_out(const BoxJoint& joint, const glm::vec3& extent, const glm::vec3& direction) {
        const glm::vec3 local(glm::dot(direction, joint.sides[3].normal),
                              glm::dot(direction, joint.sides[0].normal),
                              glm::dot(direction, joint.sides[4].normal));
        float out = extent.x + extent.y + extent.z;
        for (int i = 0; i < 3; ++i) {
            const float part = std::abs(local[i]);
            out = part * out > extent[i] ? extent[i] / part : out;
        }
        return out;
    }

    static void choose_side(const BoxJoint& joint,
                            const glm::vec3& direction,
                            std::uint32_t child,
                            std::array<std::vector<std::uint32_t>, kSides>& wanted) {
        float best = kFacing;
        std::vector<std::uint32_t>* side = nullptr;
        for (std::size_t i = 0; i < kSides; ++i) {
            const float facing = glm::dot(direction, joint.sides[i].normal);
            if (facing > best && wanted[i].size() < kMaxOnSide) {
                best = facing;
                side = &wanted[i];
            }
        }
        if (side != nullptr) {
            side->push_back(child);
        }
    }

    const Skeleton& skeleton_;
    float width_;
    std::vector<bool> drawn_;
    std::vector<std::uint32_t> first_child_;
    std::vector<std::uint32_t> children_;
    std::vector<std::uint32_t> socket_of_; // in sockets_
    std::vector<BoxSocket> sockets_;
    BoxWriter writer_;
};

} // namespace

PolygonMesh make_boxes(const Skeleton& skeleton, float width) {
    return BoxMesher(skeleton, width).make();
}

} // namespace lsys
