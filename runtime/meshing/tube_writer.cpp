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

TubeWriter::TubeWriter(const MeshBlock& block, const MeshOptions& options, std::uint64_t vertex)
    : block_(block), options_(options), seam_(columns_of(0, options) != 0) {
    at_.vertex = vertex;
}

void TubeWriter::write(const Run& run) {
    at_ = begin(run);
    go(run, run.joints.size());
}

TubeWriter::Place TubeWriter::begin(const Run& run) const {
    Place place;
    place.vertex = at_.vertex;
    place.tangent = run.joints[0].heading;
    place.normal = across(run.side, place.tangent);
    if (seam_ || options_.bark_noise > 0.0F) {
        place.circumference = mean_circumference(run);
    }
    return place;
}

void TubeWriter::write(const Run& run, Place& place, std::size_t end) {
    at_ = place;
    go(run, end);
    place = at_;
}

void TubeWriter::skip(const Run& run, Place& place, std::size_t end) {
    skips_ = true;
    write(run, place, end);
    skips_ = false;
}

void TubeWriter::go(const Run& run, std::size_t end) {
    const std::span<const Joint> joints = run.joints;
    const std::size_t last = joints.size() - 1;
    std::optional<BarkNoise> noise;
    if (seam_ || options_.bark_noise > 0.0F) {
        v_scale_ = 1.0 / at_.circumference;
        if (options_.bark_noise > 0.0F) {
            noise.emplace(static_cast<float>(at_.circumference), run.first_segment);
        }
    }
    noise_ = noise ? &*noise : nullptr;
    Ring ring;
    ring.arc = at_.arc;
    if (at_.joint == 0 && end > 0) {
        ring.centre = joints[0].centre;
        ring.radius = joints[0].radius;
        ring.slope = slope_of(run, 0);
        ring.sides = joints[0].sides;
        ring.colour = joints[0].colour;
        if (run.begin == TubeEnd::Flat) {
            put_tip(ring.centre, -at_.tangent, ring.arc, ring);
        }
        set_frame(ring);
        put_ring(ring);
        at_.joint = 1;
    }
    for (std::size_t i = at_.joint; i < end; ++i) {
        const Joint& before = joints[i - 1];
        const Joint& joint = joints[i];
        ring.centre = joint.centre;
        ring.radius = joint.radius;
        ring.slope = skips_ ? 0.0F : slope_of(run, i);
        ring.arc += static_cast<double>(before.length);
        ring.sides = joint.sides;
        ring.colour = before.colour;
        if (joint.rings > 1) {
            bend(before, joint, ring);
        } else {
            // The ring lies in the plane that halves the bend, as an ellipse: both edges are as
            // thick as the radius says.
            const glm::vec3 sum = before.heading + joint.heading;
            const float twice = std::sqrt(glm::dot(sum, sum));
            const float half_cosine = 0.5F * twice;
            carry(before.heading, sum * (1.0F / twice));
            ring.mitre = joint.heading - before.heading;
            ring.stretch = 0.25F / (half_cosine * (1.0F + half_cosine));
            set_frame(ring);
            put_ring(ring);
            change_colour(ring, joint.colour);
        }
    }
    at_.joint = end;
    at_.arc = ring.arc;
    if (end > last) {
        ring.colour = joints[last].colour;
        close(run, ring);
    }
}

/// Carries the frame along `edge` to where the axis goes along `tangent`, both unit.
void TubeWriter::carry(const glm::vec3& edge, const glm::vec3& tangent) {
    const glm::vec3 left = at_.normal - edge * (2.0F * glm::dot(edge, at_.normal));
    const glm::vec3 left_tangent = at_.tangent - edge * (2.0F * glm::dot(edge, at_.tangent));
    const glm::vec3 mirror = tangent - left_tangent;
    const float scale = 2.0F / glm::dot(mirror, mirror);
    at_.normal = left - mirror * (scale * glm::dot(mirror, left));
    at_.tangent = tangent;
    // A million steps leave it a unit vector across the tangent.
    if (++at_.steps % kStepsToDrift == 0) {
        at_.normal -= tangent * glm::dot(tangent, at_.normal);
        at_.normal *= 1.5F - 0.5F * glm::dot(at_.normal, at_.normal);
    }
}

void TubeWriter::set_frame(Ring& ring) const {
    ring.binormal = glm::cross(at_.tangent, at_.normal);
    ring.normal_part = glm::dot(at_.normal, ring.mitre);
    ring.binormal_part = glm::dot(ring.binormal, ring.mitre);
}

/// Two or three rings around a joint, each bending by at most 60 degrees. They lie a little apart,
/// so that no corners coincide where the axis of the bend meets them.
void TubeWriter::bend(const Joint& before, const Joint& joint, Ring ring) {
    const glm::vec3& in = before.heading;
    const float cosine = glm::dot(in, joint.heading);
    const glm::vec3 turn = glm::cross(in, joint.heading);
    const float sine = std::sqrt(glm::dot(turn, turn));
    const glm::vec3 axis =
        sine > 1e-3F ? turn * (1.0F / sine)
                     : across(glm::cross(in, at_.normal), in); // which way, if it turns back
    const glm::vec3 across_in = glm::cross(axis, in);
    const float half_cosine = std::sqrt(std::max(0.5F + 0.5F * cosine, 0.0F));
    const float half_sine = std::sqrt(std::max(0.5F - 0.5F * cosine, 0.0F));
    // By how much the first tangent is turned from the edge before, and the last one from the edge
    // behind: a quarter of the bend, or with three rings about a sixth.
    const float share = joint.rings == 2 ? 1.0F : kThird;
    const float whole = 1.0F / std::sqrt(1.0F + share * (2.0F * half_cosine + share));
    const float part_cosine = (1.0F + share * half_cosine) * whole;
    const float part_sine = share * half_sine * whole;
    const float back = std::min(kSpread * joint.radius, 0.25F * before.length);
    const float on = 0.75F * std::min(kSpread * joint.radius, 0.25F * joint.length);
    const glm::vec3 centre = ring.centre;
    const double arc = ring.arc;
    ring.stretch = 1.0F / part_cosine - 1.0F;
    // All tangents lie in the plane of the bend, so what a frame has along the axis and across it
    // stays as it is. `mitre` is the axis times the tangent.
    carry(in, part_cosine * in + part_sine * across_in);
    ring.mitre = part_cosine * across_in - part_sine * in;
    const float along_axis = glm::dot(at_.normal, axis);
    const float along_mitre = glm::dot(at_.normal, ring.mitre);
    ring.normal_part = along_mitre;
    ring.binormal_part = -along_axis;
    ring.binormal = along_mitre * axis - along_axis * ring.mitre;
    ring.centre = centre - back * in;
    ring.arc = arc - static_cast<double>(back);
    put_ring(ring);
    const auto turn_to = [&](const glm::vec3& tangent, const glm::vec3& mitre) {
        at_.tangent = tangent;
        at_.normal = along_axis * axis + along_mitre * mitre;
        ring.mitre = mitre;
        ring.binormal = along_mitre * axis - along_axis * mitre;
    };
    const glm::vec3 middle = half_cosine * in + half_sine * across_in;
    const glm::vec3 middle_mitre = half_cosine * across_in - half_sine * in;
    if (joint.rings > 2) {
        turn_to(middle, middle_mitre);
        ring.centre = centre;
        ring.arc = arc;
        put_ring(ring);
    }
    const float rest_cosine = half_cosine * part_cosine + half_sine * part_sine;
    const float rest_sine = half_sine * part_cosine - half_cosine * part_sine;
    turn_to(rest_cosine * middle + rest_sine * middle_mitre,
            rest_cosine * middle_mitre - rest_sine * middle);
    ring.centre = centre + on * joint.heading;
    ring.arc = arc + static_cast<double>(on);
    put_ring(ring);
    change_colour(ring, joint.colour);
}

/// Where the colour changes, the ring is there once for each.
void TubeWriter::change_colour(Ring& ring, std::uint16_t colour) {
    if (ring.colour != colour) {
        ring.colour = colour;
        put_ring(ring);
    }
}

/// `ring` is the last one written.
void TubeWriter::close(const Run& run, Ring ring) {
    if (run.end == TubeEnd::Point) {
        return;
    }
    const float radius = ring.radius;
    const glm::vec3 base = ring.centre;
    const double arc = ring.arc;
    float height = kBluntHeight;
    if (run.end == TubeEnd::Ball) {
        height = 1.0F;
        ring.centre = base + (kBallHeight * radius) * at_.tangent;
        ring.radius = kBallRing * radius;
        ring.slope = -1.0F;
        ring.arc = arc + static_cast<double>(kBallHeight * radius);
        put_ring(ring);
    }
    put_tip(base + (height * radius) * at_.tangent, at_.tangent,
            arc + static_cast<double>(height * radius), ring);
}

} // namespace lsys
