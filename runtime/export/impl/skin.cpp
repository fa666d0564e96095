// SPDX-License-Identifier: MIT
#include "runtime/export/impl/skin.h"

#include "grammar/base/contract.h"
#include "runtime/export/export.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

constexpr double kPlaceTolerance = 1e-5; // fraction of the size of the plant
constexpr double kAngleTolerance = 1e-4; // rad

struct Place {
    glm::dvec3 base;
    glm::dquat frame;
};

Place place_of(const SegmentPlace& place) {
    return {glm::dvec3(place.base), glm::normalize(glm::dquat(place.frame))};
}

bool are_near(const Place& a, const Place& b, double distance) {
    const glm::dvec3 off = a.base - b.base;
    const glm::dquat turn = glm::conjugate(a.frame) * b.frame;
    const double half_sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
    return glm::dot(off, off) <= distance * distance && half_sine <= 0.5 * kAngleTolerance;
}

/// Whether `segment` moves rigidly with the joint of the segment `leader`; if `leader` is
/// kNoSegment, whether `segment` stands still.
bool goes_with(const PlantAnimation& animation,
               std::uint32_t leader,
               std::uint32_t segment,
               double distance) {
    const Place start = place_of(animation.frame(0)[segment]);
    Place relative = start;
    if (leader != kNoSegment) {
        const Place joint = place_of(animation.frame(0)[leader]);
        const glm::dquat back = glm::conjugate(joint.frame);
        relative = {back * (start.base - joint.base), back * start.frame};
    }
    for (std::uint32_t i = 1; i < animation.frame_count; ++i) {
        Place taken = relative;
        if (leader != kNoSegment) {
            const Place joint = place_of(animation.frame(i)[leader]);
            taken = {joint.base + joint.frame * relative.base, joint.frame * relative.frame};
        }
        if (!are_near(taken, place_of(animation.frame(i)[segment]), distance)) {
            return false;
        }
    }
    return true;
}

double size_of(const Mesh& mesh) {
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) {
        bounds.add(position);
    }
    const glm::dvec3 size = glm::dvec3(bounds.high) - glm::dvec3(bounds.low);
    return std::max({size.x, size.y, size.z});
}

} // namespace

std::optional<Skin>
make_skin(const Mesh& mesh, const Skeleton& skeleton, const PlantAnimation& animation) {
    const std::uint32_t count = animation.segment_count;
    LSYS_CHECK(count == skeleton.segments.size() && animation.frame_count > 0, count,
               skeleton.segments.size(), animation.frame_count);
    LSYS_CHECK(mesh.segments.size() == mesh.positions.size(), mesh.segments.size(),
               mesh.positions.size());
    const double distance = kPlaceTolerance * size_of(mesh);
    LargeVector<std::uint32_t> leaders; // segment whose joint a segment shares; kNoSegment: joint 0
    leaders.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t parent = skeleton.segments[i].parent;
        const std::uint32_t leader = parent < i ? leaders[parent] : kNoSegment;
        leaders[i] = goes_with(animation, leader, i, distance) ? leader : i;
    }
    std::vector<bool> used(count, false);
    for (const VertexSegments& segments : mesh.segments) {
        for (const std::uint32_t segment : segments) {
            if (segment < count && leaders[segment] != kNoSegment) {
                used[leaders[segment]] = true;
            }
        }
    }
    if (std::count(used.begin(), used.end(), true) > std::ptrdiff_t{kMaxJoints}) {
        return std::nullopt;
    }
    Skin skin;
    skin.joints.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        skin.joints[i] = 0;
        if (used[i]) {
            skin.segments.push_back(i);
            skin.joints[i] = static_cast<std::uint16_t>(skin.segments.size());
        } else if (leaders[i] != kNoSegment && leaders[i] != i) {
            skin.joints[i] = skin.joints[leaders[i]];
        }
    }
    return skin;
}

void joint_rotations(const PlantAnimation& animation,
                     std::uint32_t segment,
                     std::vector<glm::quat>& rotations) {
    rotations.clear();
    for (std::uint32_t i = 0; i < animation.frame_count; ++i) {
        const glm::quat frame(place_of(animation.frame(i)[segment]).frame);
        const bool other_side = i > 0 && glm::dot(rotations.back(), frame) < 0.0F;
        rotations.push_back(other_side ? -frame : frame);
    }
}

} // namespace lsys
