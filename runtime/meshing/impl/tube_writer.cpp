// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/tube_writer.h"

#include "runtime/base/random.h"
#include "runtime/meshing/impl/bark_noise.h"
#include "runtime/meshing/impl/grooves.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace lsys {

namespace {

constexpr float kMaxSlope = 8.0F; // max result of slope_of()
constexpr std::uint32_t kEdgesPerOrthogonalization =
    16;                               // edges after which the frame is made orthogonal again
constexpr float kSpread = 0.2F;       // distance of the rings of a bend from its joint, in radii
constexpr float kBluntHeight = 0.35F; // height of the cone that closes a blunt end, in radii
// Ring between the end of a tube and the top of its half ball, in radii of the tube:
constexpr float kBallRing = 0.75F;   // radius of the ring
constexpr float kBallHeight = 0.62F; // height of the ring above the end
constexpr float kHalfRoot3 = 0.8660254F;
// Min and max height of the corners of a break, in radii of the tube.
constexpr float kMinSplinter = 0.15F;
constexpr float kMaxSplinter = 1.1F;
constexpr std::uint32_t kBreakGeneration = 0xFFFFFFFCu; // docs/language.md section 6.5
// Weight of the bisector in the first of the three tangents of a bend: tan(30 degrees). Exact for a
// reversal, whose bisector is at 90 degrees to the edge.
constexpr float kOuterBisectorWeight = 0.57735F;
constexpr float kTurnsBack = -0.9F; // max cosine of a bend that counts as a reversal
// Number of grooves of a tube: the number of sides of its rings at level 0 / kSidesOfGroove, at
// least kMinGrooves and at most kMaxGrooves.
constexpr std::uint32_t kSidesOfGroove = 4;
constexpr std::uint32_t kMinGrooves = 3;
constexpr std::uint32_t kMaxGrooves = 16;

glm::vec3 any_perpendicular(const glm::vec3& unit) {
    const glm::vec3 other =
        std::abs(unit.y) < 0.9F ? glm::vec3(0.0F, 1.0F, 0.0F) : glm::vec3(1.0F, 0.0F, 0.0F);
    return glm::normalize(glm::cross(unit, other));
}

/// The part of `v` perpendicular to `unit`, as a unit vector.
glm::vec3 across(const glm::vec3& v, const glm::vec3& unit) {
    const glm::vec3 part = v - unit * glm::dot(v, unit);
    const float square = glm::dot(part, part);
    return square > 1e-6F ? part / std::sqrt(square) : any_perpendicular(unit);
}

/// The circumference of a run at its mean radius.
double mean_circumference(const Run& run) {
    double area = 0.0;
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < run.joints.size(); ++i) {
        const Joint& joint = run.joints[i];
        const double both =
            static_cast<double>(joint.radius) + static_cast<double>(run.joints[i + 1].radius);
        area += both * 0.5 * static_cast<double>(joint.length);
        length += static_cast<double>(joint.length);
    }
    return 2.0 * std::numbers::pi * area / length;
}

/// The unit axis of the bend from one edge to the next; for a reversal, the axis perpendicular to
/// edge and normal.
glm::vec3 bend_axis(const glm::vec3& in, const glm::vec3& out, const glm::vec3& normal) {
    const glm::vec3 turn = glm::cross(in, out);
    const float sine = std::sqrt(glm::dot(turn, turn));
    return sine > 1e-3F ? turn * (1.0F / sine) : across(glm::cross(in, normal), in);
}

/// Change of the radius per length at joint `i`.
float slope_of(const Run& run, std::size_t i) {
    const std::size_t low = i == 0 ? 0 : i - 1;
    const std::size_t high = std::min(i + 1, run.joints.size() - 1);
    const float rise = run.radii.empty() ? run.joints[high].radius - run.joints[low].radius
                                         : run.radii[high] - run.radii[low];
    if (rise == 0.0F) {
        return 0.0F;
    }
    const float length = (i == 0 ? 0.0F : run.joints[low].length) + run.joints[i].length;
    const float slope = rise / length;
    return std::min(std::max(slope, -kMaxSlope), kMaxSlope); // clamps without branches
}

} // namespace

TubeWriter::TubeWriter(const MeshBlock& block,
                       const MeshOptions& options,
                       const Flare& flare,
                       const Looks* looks,
                       std::uint64_t vertex)
    : block_(block), options_(options), flare_(flare), looks_(looks),
      seam_(columns_of(0, options) != 0) {
    at_.vertex = vertex;
}

void TubeWriter::write(const Run& run) {
    at_ = begin(run);
    advance(run, run.joints.size());
}

TubeWriter::Place TubeWriter::begin(const Run& run) const {
    Place place;
    place.vertex = at_.vertex;
    place.normal = across(run.side, run.joints[0].heading);
    if (seam_ || options_.bark_noise > 0.0F || options_.grooves > 0.0F) {
        place.circumference = mean_circumference(run);
    }
    return place;
}

void TubeWriter::write(const Run& run, Place& place, std::size_t end) {
    at_ = place;
    advance(run, end);
    place = at_;
}

void TubeWriter::skip(const Run& run, Place& place, std::size_t end) const {
    if (place.joint == 0) {
        place.vertex +=
            (run.begin == TubeEnd::Flat ? 1U : 0U) + columns_of(run.joints[0].sides, options_);
        place.joint = 1;
    }
    for (std::size_t i = place.joint; i < end; ++i) {
        const Joint& before = run.joints[i - 1];
        const Joint& joint = run.joints[i];
        const std::uint32_t rings = joint.rings + (joint.colour != before.colour ? 1U : 0U);
        place.vertex += std::uint64_t{rings} * columns_of(joint.sides, options_);
        place.arc += static_cast<double>(before.length);
        transport_normal(before.heading, joint.heading, place);
    }
    place.joint = end;
}

void TubeWriter::advance(const Run& run, std::size_t end) {
    const std::span<const Joint> joints = run.joints;
    const std::size_t last = joints.size() - 1;
    std::optional<BarkNoise> noise;
    std::optional<Grooves> grooves;
    std::optional<Roots> roots;
    if (run.has_roots) {
        roots.emplace(flare_);
    }
    if (seam_ || options_.bark_noise > 0.0F || options_.grooves > 0.0F) {
        v_scale_ = 1.0 / at_.circumference;
        const auto circumference = static_cast<float>(at_.circumference);
        if (options_.bark_noise > 0.0F) {
            noise.emplace(circumference, run.first_segment);
        }
        if (options_.grooves > 0.0F) {
            const std::uint32_t sides = options_.sides == 0 ? kGrooveSides : options_.sides;
            grooves.emplace(std::clamp(sides / kSidesOfGroove, kMinGrooves, kMaxGrooves),
                            circumference, run.first_segment);
        }
    }
    noise_ = noise ? &*noise : nullptr;
    grooves_ = grooves ? &*grooves : nullptr;
    roots_ = roots ? &*roots : nullptr;
    Ring ring;
    double arc = at_.arc;
    ring.arc = arc;
    if (at_.joint == 0 && end > 0) {
        ring.centre = joints[0].centre;
        ring.radius = joints[0].radius;
        ring.slope = slope_of(run, 0);
        ring.sides = joints[0].sides;
        ring.colour = joints[0].colour;
        set_straight(joints[0].heading, ring);
        if (run.begin == TubeEnd::Flat) {
            put_tip(ring.centre, -ring.tangent, ring);
        }
        put_ring(ring);
        at_.joint = 1;
    }
    for (std::size_t i = at_.joint; i < end; ++i) {
        const Joint& before = joints[i - 1];
        const Joint& joint = joints[i];
        ring.centre = joint.centre;
        ring.radius = joint.radius;
        ring.slope = slope_of(run, i);
        arc += static_cast<double>(before.length);
        ring.arc = arc;
        ring.sides = joint.sides;
        ring.colour = before.colour;
        if (joint.rings > 1) {
            bend(before, joint, ring);
        } else {
            if (before.heading == joint.heading) {
                set_straight(joint.heading, ring);
            } else {
                set_mitred(before.heading, joint.heading, ring);
            }
            put_ring(ring);
        }
        if (ring.colour != joint.colour) { // each colour has its own ring
            ring.colour = joint.colour;
            put_ring(ring);
        }
        transport_normal(before.heading, joint.heading, at_);
    }
    at_.joint = end;
    at_.arc = arc;
    if (end > last) {
        close(run, ring);
    }
}

/// Rotates the normal of `place` by the shortest rotation from `in`, the direction of the edge
/// before a joint, to `out`, the direction of the edge after it. Both have unit length.
void TubeWriter::transport_normal(const glm::vec3& in, const glm::vec3& out, Place& place) {
    if (in == out) {
        return;
    }
    glm::vec3& normal = place.normal;
    const float cosine = glm::dot(in, out);
    if (cosine > kTurnsBack) {
        normal -= (glm::dot(normal, out) / (1.0F + cosine)) * (in + out);
    } else {
        const glm::vec3 axis = bend_axis(in, out, normal);
        normal = glm::dot(normal, axis) * axis +
                 glm::dot(normal, glm::cross(axis, in)) * glm::cross(axis, out);
    }
    // Corrects the normal at regular intervals, so that it is a unit vector across the edge even
    // after a million edges.
    if (++place.steps % kEdgesPerOrthogonalization == 0) {
        normal -= out * glm::dot(out, normal);
        normal *= 1.5F - 0.5F * glm::dot(normal, normal);
    }
}

/// Sets a ring perpendicular to an edge: a circle.
void TubeWriter::set_straight(const glm::vec3& edge, Ring& ring) const {
    ring.tangent = edge;
    ring.normal = at_.normal;
    ring.binormal = glm::cross(edge, at_.normal);
    ring.wide_normal = ring.normal;
    ring.wide_binormal = ring.binormal;
}

/// Sets a ring in the plane that halves the bend from one edge to the next: an ellipse, so that
/// both tubes keep their radius.
void TubeWriter::set_mitred(const glm::vec3& in, const glm::vec3& out, Ring& ring) const {
    const glm::vec3& normal = at_.normal;
    const glm::vec3 binormal = glm::cross(in, normal);
    const float normal_part = glm::dot(normal, out);
    const float binormal_part = glm::dot(binormal, out);
    const float sum = 1.0F + glm::dot(in, out);
    const float length = std::sqrt(2.0F * sum); // length of `in` + `out`
    ring.tangent = (in + out) * (1.0F / length);
    // Turns the normal and the binormal by half of the bend.
    const glm::vec3 turn = (in + ring.tangent) * (1.0F / (length + sum));
    ring.normal = normal - normal_part * turn;
    ring.binormal = binormal - binormal_part * turn;
    // Projects the normal and the binormal along the edge onto the plane of the ring.
    const glm::vec3 along = in * (1.0F / sum);
    ring.wide_normal = normal - normal_part * along;
    ring.wide_binormal = binormal - binormal_part * along;
}

/// Writes two or three rings around a joint, so that the tube bends by at most 60 degrees at each
/// ring. The rings lie a little apart, so that no corners coincide on the axis of the bend.
void TubeWriter::bend(const Joint& before, const Joint& joint, Ring& ring) {
    const glm::vec3& in = before.heading;
    const float cosine = glm::dot(in, joint.heading);
    const glm::vec3 axis = bend_axis(in, joint.heading, at_.normal);
    const glm::vec3 across_in = glm::cross(axis, in);
    const float half_cosine = std::sqrt(std::max(0.5F + 0.5F * cosine, 0.0F));
    const float half_sine = std::sqrt(std::max(0.5F - 0.5F * cosine, 0.0F));
    // Angle between the first tangent and the edge before the joint, and between the last tangent
    // and the edge after it: a quarter of the bend, or with three rings about a sixth.
    const float share = joint.rings == 2 ? 1.0F : kOuterBisectorWeight;
    const float whole = 1.0F / std::sqrt(1.0F + share * (2.0F * half_cosine + share));
    const float part_cosine = (1.0F + share * half_cosine) * whole;
    const float part_sine = share * half_sine * whole;
    const float back = std::min(kSpread * joint.radius, 0.25F * before.length);
    const float on = 0.75F * std::min(kSpread * joint.radius, 0.25F * joint.length);
    const glm::vec3 centre = ring.centre;
    const double arc = ring.arc;
    // All tangents lie in the plane of the bend, so the parts of the frame along the axis and
    // across it do not change.
    const float along_axis = glm::dot(at_.normal, axis);
    const float across_axis = glm::dot(at_.normal, across_in);
    const glm::vec3 normal_along = along_axis * axis;
    const glm::vec3 binormal_along = across_axis * axis;
    const float wide = 1.0F / part_cosine;
    // Writes the ring whose tangent is `along` * in + `aside` * across_in.
    const auto put = [&](float along, float aside) {
        const glm::vec3 mitre = along * across_in - aside * in; // cross product of axis and tangent
        ring.tangent = along * in + aside * across_in;
        ring.normal = normal_along + across_axis * mitre;
        ring.binormal = binormal_along - along_axis * mitre;
        ring.wide_normal = normal_along + (wide * across_axis) * mitre;
        ring.wide_binormal = binormal_along - (wide * along_axis) * mitre;
        put_ring(ring);
    };
    ring.centre = centre - back * in;
    ring.arc = arc - static_cast<double>(back);
    put(part_cosine, part_sine);
    if (joint.rings > 2) {
        ring.centre = centre;
        ring.arc = arc;
        put(half_cosine, half_sine);
    }
    ring.centre = centre + on * joint.heading;
    ring.arc = arc + static_cast<double>(on);
    const float sine = 2.0F * half_sine * half_cosine;
    put(cosine * part_cosine + sine * part_sine, sine * part_cosine - cosine * part_sine);
}

/// Writes the two rings of a break: its corners, with normals of the tube and of the break.
void TubeWriter::put_break(const Run& run, Ring& ring) {
    const std::uint32_t columns = columns_of(ring.sides, options_);
    for (int i = 0; i < 2; ++i) {
        const std::uint64_t first = at_.vertex;
        put_ring(ring);
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t corner = column == ring.sides ? 0 : column; // the seam
            const PhiloxBlock words =
                draw_block(0, kBreakGeneration, run.first_segment, corner / 4);
            const float height =
                draw_in_range(kMinSplinter, kMaxSplinter, unit_interval(words[corner % 4]));
            block_.positions[first + column] += (height * ring.radius) * ring.tangent;
            if (i == 1) {
                block_.normals[first + column] = ring.tangent;
                if (options_.tangents) {
                    block_.tangents[first + column] = glm::vec4(ring.normal, 1.0F);
                }
            }
        }
    }
}

/// Closes the run; `ring` is the ring written last.
void TubeWriter::close(const Run& run, Ring& ring) {
    if (run.end == TubeEnd::Point) {
        return;
    }
    const float radius = ring.radius;
    const glm::vec3 base = ring.centre;
    const double arc = ring.arc;
    float height = kBluntHeight;
    const auto put_above = [&](float up, float wide, float slope) {
        height = 1.0F;
        ring.centre = base + (up * radius) * ring.tangent;
        ring.radius = wide * radius;
        ring.slope = slope;
        ring.arc = arc + static_cast<double>(up * radius);
        put_ring(ring);
    };
    if (run.end == TubeEnd::Ball) {
        put_above(kBallHeight, kBallRing, -1.0F);
    } else if (run.end == TubeEnd::Round) {
        put_above(0.5F, kHalfRoot3, -kHalfRoot3 / 1.5F); // 30 degrees above the end
        put_above(kHalfRoot3, 0.5F, -2.0F * kHalfRoot3); // 60 degrees
    } else if (run.end == TubeEnd::Broken) {
        put_break(run, ring);
    }
    ring.arc = arc + static_cast<double>(height * radius);
    put_tip(base + (height * radius) * ring.tangent, ring.tangent, ring);
}

} // namespace lsys
