// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/joint_curves.h"

#include "runtime/meshing/impl/axis_levels.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace lsys {

namespace {

// Wanted turn from one part to the next: length of the difference of their unit headings.
constexpr double kTurnOfPart = 0.2;
// An axis turns back where the square of the sum of the two unit headings is at most this.
constexpr float kTurnsBack = 1e-4F;
constexpr std::size_t kSamples = 32; // samples of an edge, to find where it turns

/// A cubic from 0 to 1 with given ends and derivatives there.
struct Cubic {
    glm::dvec3 begin{};
    glm::dvec3 end{};
    glm::dvec3 leaving{};  // derivative at 0
    glm::dvec3 arriving{}; // derivative at 1

    [[nodiscard]] glm::dvec3 at(double t) const {
        const double rest = 1.0 - t;
        return begin + (t * t * (3.0 - 2.0 * t)) * (end - begin) + (t * rest * rest) * leaving -
               (t * t * rest) * arriving;
    }
};

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : v;
}

/// Derivative at the joint between two edges, for the curve of that edge which has length `own` and
/// heading `heading`.
glm::dvec3 derivative(
    const glm::vec3& in, const glm::vec3& out, const glm::vec3& heading, float own, float other) {
    if (!joint_tangent(in, out)) {
        return static_cast<double>(own) * glm::dvec3(heading);
    }
    const double root = std::sqrt(static_cast<double>(own));
    const double other_root = std::sqrt(static_cast<double>(other));
    return (static_cast<double>(own) * other_root / (root + other_root)) *
           (glm::dvec3(in) + glm::dvec3(out));
}

/// The curve of the edge from joint `i` to the next one.
Cubic curve_of(const LargeVector<Joint>& joints,
               std::size_t i,
               const std::optional<CurveStart>& start) {
    const Joint& from = joints[i];
    const Joint& to = joints[i + 1];
    Cubic curve{.begin = glm::dvec3(from.centre), .end = glm::dvec3(to.centre)};
    const glm::dvec3 straight = static_cast<double>(from.length) * glm::dvec3(from.heading);
    if (i > 0) {
        const Joint& before = joints[i - 1];
        curve.leaving =
            derivative(before.heading, from.heading, from.heading, from.length, before.length);
    } else if (start) {
        // The derivative that the curve would have if an edge of equal length along `tangent` came
        // before.
        const glm::dvec3 tangent(start->tangent);
        curve.leaving = glm::dot(straight, tangent) * tangent;
    } else {
        curve.leaving = straight;
    }
    curve.arriving = i + 2 < joints.size() ? derivative(from.heading, to.heading, from.heading,
                                                        from.length, to.length)
                                           : straight;
    return curve;
}

/// Parameters at which a curve is cut into parts that turn by equal angles; both ends included.
struct Places {
    std::array<double, kMaxCurveParts + 1> at{};
    std::size_t parts = 1;
};

Places find_places(const Cubic& curve) {
    // Turn of the curve from its begin to the middle of each of kSamples equal ranges of its
    // parameter.
    std::array<double, kSamples + 2> parameters{};
    std::array<double, kSamples + 2> turns{};
    glm::dvec3 heading = unit(curve.leaving);
    glm::dvec3 place = curve.begin;
    double turned = 0.0;
    for (std::size_t k = 0; k < kSamples; ++k) {
        const double t = static_cast<double>(k + 1) / static_cast<double>(kSamples);
        const glm::dvec3 next = k + 1 == kSamples ? curve.end : curve.at(t);
        const glm::dvec3 along = unit(next - place);
        turned += glm::length(along - heading);
        heading = along;
        place = next;
        parameters[k + 1] = t - 0.5 / static_cast<double>(kSamples);
        turns[k + 1] = turned;
    }
    parameters[kSamples + 1] = 1.0;
    turns[kSamples + 1] = turned + glm::length(unit(curve.arriving) - heading);

    const double total = turns.back();
    Places places;
    places.parts = static_cast<std::size_t>(
        std::clamp(std::ceil(total / kTurnOfPart), 1.0, static_cast<double>(kMaxCurveParts)));
    std::size_t sample = 0;
    for (std::size_t k = 1; k < places.parts; ++k) {
        const double wanted = total * static_cast<double>(k) / static_cast<double>(places.parts);
        while (turns[sample + 1] < wanted) {
            ++sample;
        }
        const double share = (wanted - turns[sample]) / (turns[sample + 1] - turns[sample]);
        places.at[k] = parameters[sample] + share * (parameters[sample + 1] - parameters[sample]);
    }
    places.at[places.parts] = 1.0;
    return places;
}

/// An edge cut into parts; joints[count] is the joint at its end.
struct Parts {
    std::array<Joint, kMaxCurveParts + 1> joints;
    std::size_t count = 1;
};

/// Headings of the edges before and after an edge, unless the run ends there.
struct Neighbours {
    std::optional<glm::vec3> before;
    std::optional<glm::vec3> after;
};

/// Whether `curve` can replace its edge: no ring crosses the next ring, both if the neighbouring
/// edges become curves and if they stay straight.
bool can_draw(const Parts& parts, const Cubic& curve, const Neighbours& beside) {
    // Normals of two possible planes of a ring: across the curve, and in the bisector of the
    // adjacent straight edges.
    struct Planes {
        glm::dvec3 curve{};
        glm::dvec3 halfway{};
    };
    const auto planes_of = [&](std::size_t k) {
        const glm::dvec3 in = k > 0           ? glm::dvec3(parts.joints[k - 1].heading)
                              : beside.before ? glm::dvec3(*beside.before)
                                              : glm::dvec3(parts.joints[0].heading);
        const glm::dvec3 out = k < parts.count ? glm::dvec3(parts.joints[k].heading)
                               : beside.after  ? glm::dvec3(*beside.after)
                                               : in;
        const glm::dvec3 halfway = unit(in + out);
        return Planes{k == 0             ? unit(curve.leaving)
                      : k == parts.count ? unit(curve.arriving)
                                         : halfway,
                      halfway};
    };
    Planes planes = planes_of(0);
    for (std::size_t k = 0; k < parts.count; ++k) {
        const Joint& from = parts.joints[k];
        const Joint& to = parts.joints[k + 1];
        const Planes next = planes_of(k + 1);
        const double turn = std::max(std::max(glm::length(next.curve - planes.curve),
                                              glm::length(next.curve - planes.halfway)),
                                     std::max(glm::length(next.halfway - planes.curve),
                                              glm::length(next.halfway - planes.halfway)));
        const float radius = std::max(from.radius, to.radius);
        if (coincide(from.centre, to.centre, radius) ||
            !(static_cast<double>(radius) * turn < static_cast<double>(from.length)) ||
            (k > 0 && drawn_radius(from.radius, from.centre, from.sides) == 0.0F)) {
            return false;
        }
        planes = next;
    }
    return true;
}

/// Cuts the edge between two joints into parts of its curve.
Parts cut(const Joint& from,
          const Joint& to,
          const Cubic& curve,
          const Places& places,
          const CurveStart* start) {
    Parts parts;
    parts.count = places.parts;
    double length = 0.0;
    for (std::size_t k = 0; k < parts.count; ++k) {
        Joint& joint = parts.joints[k] = from;
        joint.centre = k == 0 ? from.centre : glm::vec3(curve.at(places.at[k]));
        joint.rings = 1;
    }
    parts.joints[parts.count] = to;
    for (std::size_t k = 0; k < parts.count; ++k) {
        aim(parts.joints[k], parts.joints[k + 1].centre);
        length += static_cast<double>(parts.joints[k].length);
    }
    const float base = from.radius - (start != nullptr ? start->flare : 0.0F);
    double along = 0.0;
    for (std::size_t k = 1; k < parts.count; ++k) {
        along += static_cast<double>(parts.joints[k - 1].length);
        const auto share = static_cast<float>(along / length);
        float& radius = parts.joints[k].radius;
        radius = base + share * (to.radius - base);
        if (start != nullptr && along < static_cast<double>(start->reach)) {
            const float rest = 1.0F - static_cast<float>(along) / start->reach;
            radius += start->flare * rest * rest;
        }
    }
    return parts;
}

} // namespace

std::optional<glm::vec3> joint_tangent(const glm::vec3& in, const glm::vec3& out) {
    const glm::vec3 both = in + out;
    const float square = glm::dot(both, both);
    if (!(square > kTurnsBack)) {
        return std::nullopt;
    }
    return both / std::sqrt(square);
}

bool can_leave_along(const glm::vec3& tangent, const glm::vec3& heading) {
    const glm::vec3 turn = heading - tangent;
    return glm::dot(tangent, heading) > 0.0F &&
           glm::dot(turn, turn) > static_cast<float>(kTurnOfPart * kTurnOfPart);
}

bool bend_edges(LargeVector<Joint>& joints,
                LargeVector<Joint>& scratch,
                const std::optional<CurveStart>& start) {
    scratch.clear();
    bool any = false;
    const std::size_t last = joints.size() - 1;
    for (std::size_t i = 0; i < last; ++i) {
        const Joint& from = joints[i];
        const bool straight = (i == 0 ? !start : joints[i - 1].heading == from.heading) &&
                              joints[i + 1].heading == from.heading;
        if (!straight) {
            const Cubic curve = curve_of(joints, i, start);
            const Places places = find_places(curve);
            if (places.parts > 1) {
                const Parts parts =
                    cut(from, joints[i + 1], curve, places, i == 0 && start ? &*start : nullptr);
                Neighbours beside;
                if (i > 0) {
                    beside.before = joints[i - 1].heading;
                }
                if (i + 2 < joints.size()) {
                    beside.after = joints[i + 1].heading;
                }
                if (can_draw(parts, curve, beside)) {
                    scratch.insert(scratch.end(), parts.joints.begin(),
                                   parts.joints.begin() + static_cast<std::ptrdiff_t>(parts.count));
                    any = true;
                    continue;
                }
            }
        }
        scratch.push_back(from);
    }
    if (!any) {
        return false;
    }
    scratch.push_back(joints[last]);
    scratch.back().heading = scratch[scratch.size() - 2].heading;
    joints.swap(scratch);
    return true;
}

} // namespace lsys
