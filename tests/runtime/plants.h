// SPDX-License-Identifier: MIT
// Skeletons for tests of physics and export.
#pragma once

#include "runtime/turtle/skeleton.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace lsys::test {

/// Adds a copy of `like` with the frame `frame`, at the tip of `parent`; without a parent at the
/// origin. Returns its index.
inline std::uint32_t
add_segment(Skeleton& plant, std::uint32_t parent, const glm::quat& frame, const Segment& like) {
    Segment segment = like;
    segment.parent = parent;
    segment.frame = frame;
    segment.linked = parent != kNoSegment;
    segment.base = segment.linked ? tip(plant.segments[parent]) : glm::vec3(0.0F);
    plant.segments.push_back(segment);
    return static_cast<std::uint32_t>(plant.segments.size() - 1);
}

inline Segment rod(float length, float radius, float spring, float mass) {
    Segment segment;
    segment.length = length;
    segment.base_radius = radius;
    segment.tip_radius = radius;
    segment.spring = spring;
    segment.mass = mass;
    segment.sides = 8;
    return segment;
}

/// The frame whose heading is turned from +Y towards +X by `angle` (radians).
inline glm::quat leaning(float angle) {
    return glm::angleAxis(-angle, glm::vec3(0.0F, 0.0F, 1.0F));
}

inline double uniform(std::mt19937& numbers, double low, double high) {
    return low + (high - low) * (static_cast<double>(numbers()) / 4294967296.0);
}
inline std::uint32_t below(std::mt19937& numbers, std::uint32_t end) {
    return static_cast<std::uint32_t>(numbers() % end);
}
/// A random power of ten from 10^low to 10^high.
inline float power(std::mt19937& numbers, double low, double high) {
    return static_cast<float>(std::pow(10.0, uniform(numbers, low, high)));
}
inline glm::quat any_frame(std::mt19937& numbers) {
    return glm::normalize(glm::quat(static_cast<float>(uniform(numbers, -1.0, 1.0)),
                                    static_cast<float>(uniform(numbers, -1.0, 1.0)),
                                    static_cast<float>(uniform(numbers, -1.0, 1.0)),
                                    static_cast<float>(uniform(numbers, 0.01, 1.0))));
}

/// A branched plant of `count` segments. Lengths, radii, masses and springs are from 10^-range to
/// 10^range. Some segments do not begin at the tip of their parent.
inline Skeleton random_plant(std::mt19937& numbers, std::uint32_t count, double range) {
    Skeleton plant;
    for (std::uint32_t i = 0; i < count; ++i) {
        Segment like = rod(power(numbers, -range, range), power(numbers, -range, range),
                           power(numbers, -range, range), power(numbers, -range, range));
        like.tip_radius *= static_cast<float>(uniform(numbers, 0.0, 1.0));
        const bool grounded = i == 0 || below(numbers, 16) == 0;
        const std::uint32_t parent =
            grounded ? kNoSegment : i - 1 - below(numbers, std::min(i, 3U));
        add_segment(plant, parent, any_frame(numbers), like);
        if (below(numbers, 8) == 0) {
            plant.segments.back().base += glm::vec3(like.length, 0.0F, -like.length);
            plant.segments.back().linked = false;
        }
    }
    for (std::uint32_t i = 0; i < count; i += 5) {
        PlacedObject leaf;
        leaf.kind = TurtleOperation::Leaf;
        leaf.position = tip(plant.segments[i]);
        leaf.frame = any_frame(numbers);
        leaf.size = power(numbers, -range / 2.0, range / 2.0);
        leaf.parent = i;
        plant.objects.push_back(leaf);
    }
    return plant;
}

/// A tree of about 3^depth twigs, with the stiffness of wood and the size of a real tree.
inline Skeleton tree(std::uint32_t depth, std::uint32_t segments_per_axis) {
    Skeleton plant;
    struct Axis {
        std::uint32_t parent = kNoSegment;
        glm::quat frame{1.0F, 0.0F, 0.0F, 0.0F};
        float radius = 0.1F;
        float length = 0.2F;
        std::uint32_t depth = 0;
    };
    std::vector<Axis> axes(1);
    while (!axes.empty()) {
        const Axis axis = axes.back();
        axes.pop_back();
        std::uint32_t last = axis.parent;
        float radius = axis.radius;
        for (std::uint32_t i = 0; i < segments_per_axis; ++i) {
            Segment like = rod(axis.length, radius, 2e9F * radius * radius * radius * radius,
                               500.0F * 3.14F * radius * radius * axis.length);
            radius *= 0.95F;
            like.tip_radius = radius;
            last = add_segment(plant, last, axis.frame, like);
        }
        if (axis.depth == depth) {
            PlacedObject leaf;
            leaf.kind = TurtleOperation::Leaf;
            leaf.position = tip(plant.segments[last]);
            leaf.frame = axis.frame;
            leaf.size = 0.05F;
            leaf.parent = last;
            plant.objects.push_back(leaf);
            continue;
        }
        for (int side = 0; side < 3; ++side) {
            const glm::quat around =
                glm::angleAxis(2.2F * static_cast<float>(side), glm::vec3(0.0F, 1.0F, 0.0F));
            axes.push_back({last, glm::normalize(axis.frame * around * leaning(0.6F)),
                            radius * 0.6F, axis.length * 0.8F, axis.depth + 1});
        }
    }
    return plant;
}

/// The frame of a segment relative to the frame of its parent; without a parent, the frame itself.
inline glm::quat local_frame(const Skeleton& skeleton, std::uint32_t segment) {
    const Segment& child = skeleton.segments[segment];
    return child.parent == kNoSegment
               ? child.frame
               : glm::conjugate(skeleton.segments[child.parent].frame) * child.frame;
}

/// Energy in J of springs and weight, computed only from the pose at rest and a bent pose.
struct Potential {
    double energy = 0.0;
    double terms = 0.0; // sum of the magnitudes of all terms, to bound rounding errors
};
inline Potential potential(const Skeleton& rest, const Skeleton& bent, double gravity) {
    Potential sum;
    for (std::uint32_t i = 0; i < rest.segments.size(); ++i) {
        const Segment& a = rest.segments[i];
        const Segment& b = bent.segments[i];
        const glm::dquat turn =
            glm::dquat(local_frame(bent, i)) * glm::conjugate(glm::dquat(local_frame(rest, i)));
        const double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
        const double angle = 2.0 * std::atan2(sine, std::abs(turn.w));
        const double stretched = 0.5 * static_cast<double>(a.spring) * angle * angle;
        const auto r = static_cast<double>(a.base_radius);
        const auto s = static_cast<double>(a.tip_radius);
        const double squares = r * r + r * s + s * s;
        const double along =
            static_cast<double>(a.length) *
            (squares > 0.0 ? (r * r + 2.0 * r * s + 3.0 * s * s) / (4.0 * squares) : 0.5);
        const double rise = static_cast<double>(b.base.y) - static_cast<double>(a.base.y) +
                            along * (glm::dquat(b.frame) * glm::dvec3(0.0, 1.0, 0.0)).y -
                            along * (glm::dquat(a.frame) * glm::dvec3(0.0, 1.0, 0.0)).y;
        const double lifted = static_cast<double>(a.mass) * gravity * rise;
        sum.energy += stretched + lifted;
        sum.terms += stretched + std::abs(lifted) + static_cast<double>(a.spring) * 1e-9 +
                     static_cast<double>(a.mass) * gravity *
                         (std::abs(static_cast<double>(a.base.y)) + static_cast<double>(a.length));
    }
    return sum;
}

/// The bytes of all members that poses change.
inline std::string place_bytes(const Skeleton& plant) {
    std::string bytes;
    const auto add = [&](const auto& value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
    };
    for (const Segment& segment : plant.segments) {
        add(segment.base);
        add(segment.frame);
    }
    for (const PlacedObject& object : plant.objects) {
        add(object.position);
        add(object.frame);
    }
    for (const Polygon& polygon : plant.polygons) {
        add(polygon.frame);
    }
    for (const glm::vec3& corner : plant.corners) {
        add(corner);
    }
    return bytes;
}
inline bool same(const Skeleton& a, const Skeleton& b) {
    return place_bytes(a) == place_bytes(b);
}

} // namespace lsys::test
