#include "runtime/meshing/tube_writer.h"

#include "runtime/meshing/bark_noise.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace lsys {

namespace {

constexpr float kGreatestSlope = 8.0F;
constexpr std::uint32_t kStepsToDrift = 16; // of a frame, by some units in the last place
constexpr float kSpread = 0.2F;             // of the rings of one bend, in radii
constexpr float kBluntHeight = 0.35F;
// The ring between the end of a tube and the top of its half ball, in radii.
constexpr float kBallRing = 0.75F;
constexpr float kBallHeight = 0.62F;
// How much of the bisector the first of three tangents of a bend has: a third of 90 degrees.
constexpr float kThird = 0.57735F;

std::uint64_t cap_vertices(TubeEnd end, std::uint64_t columns) {
    switch (end) {
    case TubeEnd::Flat:
    case TubeEnd::Blunt:
        return 1;
    case TubeEnd::Ball:
        return columns + 1;
    case TubeEnd::Point:
    case TubeEnd::Open:
        break;
    }
    return 0;
}
std::uint64_t cap_triangles(TubeEnd end, std::uint64_t sides) {
    switch (end) {
    case TubeEnd::Flat:
    case TubeEnd::Blunt:
        return sides;
    case TubeEnd::Ball:
        return 3 * sides;
    case TubeEnd::Point:
    case TubeEnd::Open:
        break;
    }
    return 0;
}

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

/// The circumference at the mean radius.
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

float slope_of(const Run& run, std::size_t i) {
    const std::size_t low = i == 0 ? 0 : i - 1;
    const std::size_t high = std::min(i + 1, run.joints.size() - 1);
    const float length = (i == 0 ? 0.0F : run.joints[low].length) + run.joints[i].length;
    const float rise = run.radii.empty() ? run.joints[high].radius - run.joints[low].radius
                                         : run.radii[high] - run.radii[low];
    const float slope = rise / length;
    return std::min(std::max(slope, -kGreatestSlope), kGreatestSlope); // without branches
}

} // namespace

void count_tube(const Run& run,
                const MeshOptions& options,
                const ColourSlots& slots,
                std::uint64_t& vertices,
                std::vector<std::uint64_t>& indices) {
    const std::span<const Joint> joints = run.joints;
    const std::size_t last = joints.size() - 1;
    std::uint32_t slot = slots[joints[0].colour];
    std::uint64_t triangles = cap_triangles(run.begin, joints[0].sides);
    vertices += cap_vertices(run.begin, columns_of(joints[0].sides, options)) +
                columns_of(joints[0].sides, options);
    for (std::size_t i = 1; i <= last; ++i) {
        const Joint& joint = joints[i];
        const std::uint64_t sides = joint.sides;
        const std::uint64_t columns = columns_of(joint.sides, options);
        const bool pointed =
            (i == 1 && run.begin == TubeEnd::Point) || (i == last && run.end == TubeEnd::Point);
        triangles += pointed ? sides : joints[i - 1].sides + sides;
        triangles += (joint.rings - std::uint64_t{1}) * 2 * sides;
        vertices += joint.rings * columns;
        if (joint.colour != joints[i - 1].colour) {
            indices[slot] += 3 * triangles;
            triangles = 0;
            slot = slots[joint.colour];
            vertices += columns;
        }
    }
    triangles += cap_triangles(run.end, joints[last].sides);
    vertices += cap_vertices(run.end, columns_of(joints[last].sides, options));
    indices[slot] += 3 * triangles;
}

TubeWriter::TubeWriter(const MeshBlock& block,
                       const MeshOptions& options,
                       const ColourSlots& slots,
                       std::uint64_t vertex,
                       std::span<const std::uint64_t> index)
    : block_(block), options_(options), slots_(slots), seam_(columns_of(0, options) != 0),
      vertex_(vertex), index_(index.begin(), index.end()) {}

void TubeWriter::write(const Run& run) {
    const std::span<const Joint> joints = run.joints;
    const std::size_t last = joints.size() - 1;
    tangent_ = joints[0].heading;
    normal_ = across(run.side, tangent_);
    steps_ = 0;
    std::optional<BarkNoise> noise;
    if (seam_ || options_.bark_noise > 0.0F) {
        const double circumference = mean_circumference(run);
        v_scale_ = 1.0 / circumference;
        if (options_.bark_noise > 0.0F) {
            noise.emplace(static_cast<float>(circumference), run.first_segment);
        }
    }
    noise_ = noise ? &*noise : nullptr;
    Ring ring{.centre = joints[0].centre,
              .radius = joints[0].radius,
              .slope = slope_of(run, 0),
              .sides = joints[0].sides,
              .colour = joints[0].colour};
    begin(run, ring);
    for (std::size_t i = 1; i <= last; ++i) {
        const Joint& before = joints[i - 1];
        const Joint& joint = joints[i];
        ring.centre = joint.centre;
        ring.radius = joint.radius;
        ring.slope = slope_of(run, i);
        ring.arc += static_cast<double>(before.length);
        ring.sides = joint.sides;
        ring.colour = before.colour;
        const bool from_point = i == 1 && run.begin == TubeEnd::Point;
        if (joint.rings > 1) {
            bend(before, joint, ring, from_point);
        } else {
            // The ring lies in the plane that halves the bend, as an ellipse: both edges are as
            // thick as the radius says.
            const glm::vec3 sum = before.heading + joint.heading;
            const float twice = std::sqrt(glm::dot(sum, sum));
            const float half_cosine = 0.5F * twice;
            carry(before.heading, sum * (1.0F / twice));
            ring.mitre = joint.heading - before.heading;
            ring.stretch = 0.25F / (half_cosine * (1.0F + half_cosine));
            link_ring(ring, slots_[before.colour], from_point);
            change_colour(ring, joint.colour);
        }
    }
    ring.colour = joints[last].colour;
    end(run, ring);
}

/// Carries the frame along `edge` to where the axis goes along `tangent`, both unit.
void TubeWriter::carry(const glm::vec3& edge, const glm::vec3& tangent) {
    const glm::vec3 left = normal_ - edge * (2.0F * glm::dot(edge, normal_));
    const glm::vec3 left_tangent = tangent_ - edge * (2.0F * glm::dot(edge, tangent_));
    const glm::vec3 mirror = tangent - left_tangent;
    const float scale = 2.0F / glm::dot(mirror, mirror);
    normal_ = left - mirror * (scale * glm::dot(mirror, left));
    tangent_ = tangent;
    // A million steps leave it a unit vector across the tangent.
    if (++steps_ % kStepsToDrift == 0) {
        normal_ -= tangent * glm::dot(tangent, normal_);
        normal_ *= 1.5F - 0.5F * glm::dot(normal_, normal_);
    }
}

/// Two or three rings around a joint, each bending by at most 60 degrees. They lie a little apart,
/// so that no corners coincide where the axis of the bend meets them.
void TubeWriter::bend(const Joint& before, const Joint& joint, Ring ring, bool from_point) {
    const glm::vec3& in = before.heading;
    const float cosine = glm::dot(in, joint.heading);
    const glm::vec3 turn = glm::cross(in, joint.heading);
    const float sine = std::sqrt(glm::dot(turn, turn));
    const glm::vec3 axis = sine > 1e-3F
                               ? turn / sine
                               : across(glm::cross(in, normal_), in); // which way, if it turns back
    const glm::vec3 across_in = glm::cross(axis, in);
    const glm::vec3 middle = std::sqrt(std::max(0.5F + 0.5F * cosine, 0.0F)) * in +
                             std::sqrt(std::max(0.5F - 0.5F * cosine, 0.0F)) * across_in;
    const float share = joint.rings == 2 ? 1.0F : kThird;
    const glm::vec3 first = glm::normalize(in + share * middle);
    const glm::vec3 last = glm::normalize(joint.heading + share * middle);
    const float stretch = 1.0F / glm::dot(in, first) - 1.0F;
    const float back = std::min(kSpread * joint.radius, 0.25F * before.length);
    const float on = 0.75F * std::min(kSpread * joint.radius, 0.25F * joint.length);
    const glm::vec3 centre = ring.centre;
    const double arc = ring.arc;
    const std::uint32_t slot = slots_[before.colour];
    ring.stretch = stretch;

    carry(in, first);
    ring.centre = centre - back * in;
    ring.arc = arc - static_cast<double>(back);
    ring.mitre = glm::cross(axis, first);
    link_ring(ring, slot, from_point);
    if (joint.rings > 2) {
        carry(tangent_, middle);
        ring.centre = centre;
        ring.arc = arc;
        ring.mitre = glm::cross(axis, middle);
        link_ring(ring, slot, false);
    }
    carry(tangent_, last);
    ring.centre = centre + on * joint.heading;
    ring.arc = arc + static_cast<double>(on);
    ring.mitre = glm::cross(axis, last);
    link_ring(ring, slot, false);
    change_colour(ring, joint.colour);
}

/// Where the colour changes, the ring is there once for each.
void TubeWriter::change_colour(Ring& ring, std::uint16_t colour) {
    if (ring.colour != colour) {
        ring.colour = colour;
        ring_ = vertex_;
        put_ring(ring);
    }
}

void TubeWriter::begin(const Run& run, const Ring& ring) {
    const std::uint64_t centre = vertex_;
    if (run.begin == TubeEnd::Flat) {
        put_tip(ring.centre, -tangent_, ring.arc, ring);
    }
    ring_ = vertex_;
    ring_sides_ = ring.sides;
    put_ring(ring);
    if (run.begin == TubeEnd::Flat) {
        fan(ring_, ring.sides, centre, 0, false, slots_[ring.colour]);
    }
}

/// `ring` is the last one written.
void TubeWriter::end(const Run& run, Ring ring) {
    const std::uint32_t slot = slots_[ring.colour];
    if (run.end == TubeEnd::Point) {
        return;
    }
    const float radius = ring.radius;
    const glm::vec3 base = ring.centre;
    const double arc = ring.arc;
    float height = kBluntHeight;
    if (run.end == TubeEnd::Ball) {
        height = 1.0F;
        ring.centre = base + (kBallHeight * radius) * tangent_;
        ring.radius = kBallRing * radius;
        ring.slope = -1.0F;
        ring.arc = arc + static_cast<double>(kBallHeight * radius);
        link_ring(ring, slot, false);
    }
    const std::uint64_t top = vertex_;
    put_tip(base + (height * radius) * tangent_, tangent_,
            arc + static_cast<double>(height * radius), ring);
    fan(ring_, ring_sides_, top, 0, true, slot);
}

/// Writes a ring and the strip from the last one.
void TubeWriter::link_ring(const Ring& ring, std::uint32_t slot, bool from_point) {
    const std::uint64_t first = vertex_;
    put_ring(ring);
    if (ring.radius == 0.0F) {
        fan(ring_, ring_sides_, first, 1, true, slot);
    } else if (from_point) {
        fan(first, ring.sides, ring_, 1, false, slot);
    } else {
        strip(ring_, ring_sides_, first, ring.sides, slot);
    }
    ring_ = first;
    ring_sides_ = ring.sides;
}

} // namespace lsys
