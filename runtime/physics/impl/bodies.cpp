// SPDX-License-Identifier: MIT
// Mass properties after Crankshaw 2019, section 6.2. In Crankshaw's thesis a segment is a cylinder
// that turns about its end; here a segment is the truncated cone that is drawn, which is a cylinder
// if both radii are equal. The mass is Segment::mass, which the author states or which is the
// volume of the cone times the density.
//
// Objects and polygons have no mass in the grammar, but a crown without the mass of its leaves
// bends too little. So they count as thin sheets of `surface_mass`: an object of size s has s^2
// square metres, at half its length; a polygon has its area, at the mean of its corners. Half of
// the area of a sheet faces the wind, which is the mean over all directions.
#include "runtime/physics/impl/bodies.h"

#include "runtime/turtle/organs.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lsys {

namespace {

constexpr double kExposedShare = 0.5; // fraction of a sheet's area that faces the wind
// m/s^2: the spring of the ground under a tip is kGroundSpring * near load (defined below) / height
// of the plant. Under this load a tip sinks by 9.81 / kGroundSpring = 0.005 of this height; pose()
// raises such tips out of the ground.
constexpr double kGroundSpring = 2e3;
// The near load of a tip is kNearFactor times a sum over the masses of the descendants, in which
// each further body along a branch counts less by the factor kNearShare; it is at most the whole
// mass of the descendants. The bodies of a chain of 25 count in full, a long chain counts as 50
// bodies.
constexpr double kNearShare = 0.97;
constexpr double kNearFactor = 1.5;
constexpr double kRounding = 1e-6; // rounding error of positions, relative to the plant's height

double magnitude(float value) {
    const auto max_float = static_cast<double>(std::numeric_limits<float>::max());
    const auto given = static_cast<double>(value);
    return given > 0.0 ? std::min(given, max_float) : 0.0;
}

double finite_or_0(double value) {
    return std::isfinite(value) ? value : 0.0;
}

glm::dvec3 place_of(const glm::vec3& v) {
    return {finite_or_0(static_cast<double>(v.x)), finite_or_0(static_cast<double>(v.y)),
            finite_or_0(static_cast<double>(v.z))};
}

glm::dvec3 heading_of(const glm::quat& frame) {
    const glm::dquat q(frame);
    const double norm = glm::dot(q, q);
    if (!(norm > 0.0) || !std::isfinite(norm)) {
        return {0.0, 1.0, 0.0};
    }
    return glm::normalize(q * (1.0 / std::sqrt(norm))) * glm::dvec3(0.0, 1.0, 0.0);
}

/// Sums over the segment, the objects and the polygons of a body: mass times position, and area of
/// sheets.
struct BodySums {
    glm::dvec3 first_moment{0.0}; // kg m
    double sail = 0.0;            // m^2, Body::sail
};

void order_by_depth(const Skeleton& rest, Bodies& out) {
    const auto count = static_cast<std::uint32_t>(rest.segments.size());
    const auto parent_of = [&](std::uint32_t segment) {
        const std::uint32_t parent = rest.segments[segment].parent;
        return parent < segment ? parent : kNoSegment;
    };
    // Children of all segments, parent by parent: the children of segment s end at index ends[s] of
    // `children`.
    std::vector<std::uint32_t> ends(std::size_t{count} + 1, 0);
    for (std::uint32_t s = 0; s < count; ++s) {
        const std::uint32_t parent = parent_of(s);
        ++ends[parent == kNoSegment ? count : parent];
    }
    const std::uint32_t root_count = ends[count];
    std::vector<std::uint32_t> child_counts(ends.begin(), ends.end() - 1);
    std::uint32_t before = 0;
    for (std::uint32_t s = 0; s < count; ++s) {
        const std::uint32_t own = ends[s];
        ends[s] = before;
        before += own;
    }
    std::vector<std::uint32_t> children(count - root_count);
    out.bodies.resize(count);
    out.segments.clear();
    out.segments.reserve(count);
    out.body_of_segment.resize(count);
    for (std::uint32_t s = 0; s < count; ++s) {
        const std::uint32_t parent = parent_of(s);
        if (parent == kNoSegment) {
            out.segments.push_back(s);
        } else {
            children[ends[parent]++] = s;
        }
    }
    std::uint32_t begin = 0;
    while (begin < out.segments.size()) {
        const auto end = static_cast<std::uint32_t>(out.segments.size());
        out.level_ends.push_back(end);
        for (std::uint32_t b = begin; b < end; ++b) {
            const std::uint32_t s = out.segments[b];
            out.body_of_segment[s] = b;
            Body& body = out.bodies[b];
            body.parent =
                parent_of(s) == kNoSegment ? kNoSegment : out.body_of_segment[parent_of(s)];
            body.first_child = static_cast<std::uint32_t>(out.segments.size());
            body.child_count = child_counts[s];
            const auto first = children.begin() + (ends[s] - child_counts[s]);
            out.segments.insert(out.segments.end(), first, first + child_counts[s]);
        }
        begin = end;
    }
}

void add_segment(const Segment& segment, Body& body, BodySums& load) {
    const double length = magnitude(segment.length);
    const double base_radius = magnitude(segment.base_radius);
    const double tip_radius = magnitude(segment.tip_radius);
    const UnitCone cone = unit_cone(length, base_radius, tip_radius);
    const glm::dvec3 axis = heading_of(segment.frame);
    body.heading = glm::vec3(axis);
    body.mass = magnitude(segment.mass);
    body.spring = magnitude(segment.spring);
    // The inertia matrix is transverse (1 - a a^T) + axial a a^T, with the unit vector a = axis.
    body.inertia = point_inertia(body.mass * (cone.transverse - cone.axial), axis);
    body.inertia.add_diagonal(body.mass * cone.axial);
    load.first_moment = body.mass * cone.centre * axis;
    body.centre = cone.centre * axis;
    body.contact.tip = length * axis;
    const auto area = [](double value) {
        return static_cast<float>(
            std::min(value, static_cast<double>(std::numeric_limits<float>::max())));
    };
    body.side = area((base_radius + tip_radius) * length);
    body.end = area(std::numbers::pi * std::max(base_radius, tip_radius) *
                    std::max(base_radius, tip_radius));
}

void add_sheet(
    double area, double surface_mass, const glm::dvec3& place, Body& body, BodySums& load) {
    if (!std::isfinite(area)) {
        return;
    }
    const double mass = surface_mass * area;
    body.mass += mass;
    load.first_moment += mass * place;
    body.inertia += point_inertia(mass, place);
    load.sail += kExposedShare * area;
}

/// The part of the mass `carried` that presses the tip of each body onto the ground. `carried`:
/// mass of each body and its descendants, in kg.
std::vector<double> near_loads(const std::vector<Body>& bodies, std::vector<double> carried) {
    std::vector<double> sums(bodies.size(), 0.0);
    for (std::size_t b = bodies.size(); b-- > 0;) {
        sums[b] += bodies[b].mass;
        if (bodies[b].parent != kNoSegment) {
            sums[bodies[b].parent] += kNearShare * sums[b];
        }
        carried[b] = std::min(carried[b], kNearFactor * sums[b]);
    }
    return carried;
}

/// Sets the contact of each body with the ground. A tip that is above the ground at rest may sink
/// until its radius touches the ground; a tip that is below the ground at rest, with a descendant
/// above the ground, may not sink; all other tips are free. `carried`: mass of each body and its
/// descendants, in kg.
void add_ground(const Skeleton& rest, const std::vector<double>& carried, Bodies& out) {
    const std::size_t count = out.bodies.size();
    const std::vector<double> near_load = near_loads(out.bodies, carried);
    const auto tip_height = [&](std::size_t b) {
        return place_of(rest.segments[out.segments[b]].base).y + out.bodies[b].contact.tip.y;
    };
    double height = 0.0;
    for (std::size_t b = 0; b < count; ++b) {
        height = std::max(height, tip_height(b));
    }
    if (!(height > 0.0)) {
        return;
    }
    std::vector<char> holds(count, 0);
    for (std::size_t b = count; b-- > 0;) {
        Body& body = out.bodies[b];
        const double tip = tip_height(b);
        holds[b] = static_cast<char>(holds[b] != 0 || tip >= -kRounding * height);
        if (holds[b] == 0) {
            continue;
        }
        const double radius = magnitude(rest.segments[out.segments[b]].tip_radius);
        body.contact.clearance = std::max(tip - radius, 0.0);
        body.contact.spring = std::min(near_load[b] * kGroundSpring / height, 1e30);
        if (body.parent != kNoSegment) {
            holds[body.parent] = 1;
        }
    }
}

} // namespace

UnitCone unit_cone(double length, double base_radius, double tip_radius) {
    const double a = base_radius;
    const double b = tip_radius;
    const double squares = a * a + a * b + b * b;
    if (squares <= 0.0) {
        return {.centre = length / 2.0, .transverse = length * length / 3.0, .axial = 0.0};
    }
    // Integrals over the height of the cone of radius^2 times 1, height, height^2 and radius^2.
    const double centre = length * (a * a + 2.0 * a * b + 3.0 * b * b) / (4.0 * squares);
    const double height_squared =
        length * length * (a * a + 3.0 * a * b + 6.0 * b * b) / (10.0 * squares);
    const double radius_squared =
        0.6 * (a * a * (a * a + a * b + b * b) + b * b * b * (a + b)) / squares;
    return {.centre = centre,
            .transverse = height_squared + 0.25 * radius_squared,
            .axial = 0.5 * radius_squared};
}

Bodies make_bodies(const Skeleton& rest, double surface_mass) {
    Bodies out;
    order_by_depth(rest, out);
    std::vector<BodySums> loads(out.bodies.size());
    for (std::size_t b = 0; b < out.bodies.size(); ++b) {
        Body& body = out.bodies[b];
        const Segment& segment = rest.segments[out.segments[b]];
        add_segment(segment, body, loads[b]);
        if (body.parent != kNoSegment) {
            const Segment& parent = rest.segments[out.segments[body.parent]];
            body.offset = place_of(segment.base) - place_of(parent.base);
        }
    }
    for (const PlacedObject& object : rest.objects) {
        if (object.parent < out.body_of_segment.size()) {
            const double size = magnitude(std::abs(object.size));
            const bool organ = is_organ(object);
            const double area = organ ? organ_area(rest, object) : size * size;
            const glm::dvec3 middle =
                organ ? place_of(organ_middle(rest, object))
                      : place_of(object.position) + 0.5 * size * heading_of(object.frame);
            const glm::dvec3 place = middle - place_of(rest.segments[object.parent].base);
            const std::uint32_t b = out.body_of_segment[object.parent];
            add_sheet(area, surface_mass, place, out.bodies[b], loads[b]);
        }
    }
    for (const Polygon& polygon : rest.polygons) {
        if (polygon.parent < out.body_of_segment.size() && polygon.corner_count > 0) {
            const glm::dvec3 base = place_of(rest.segments[polygon.parent].base);
            const auto corner = [&](std::uint32_t c) {
                return place_of(rest.corners[polygon.first_corner + c % polygon.corner_count]) -
                       base;
            };
            glm::dvec3 sum(0.0);
            glm::dvec3 normal(0.0); // by Newell's method; its length is twice the area
            for (std::uint32_t c = 0; c < polygon.corner_count; ++c) {
                sum += corner(c);
                normal += glm::cross(corner(c), corner(c + 1));
            }
            const std::uint32_t b = out.body_of_segment[polygon.parent];
            add_sheet(0.5 * glm::length(normal), surface_mass,
                      sum / static_cast<double>(polygon.corner_count), out.bodies[b], loads[b]);
        }
    }
    std::vector<double> carried(out.bodies.size(), 0.0); // kg, mass of a body and its descendants
    for (std::size_t b = out.bodies.size(); b-- > 0;) {
        Body& body = out.bodies[b];
        glm::dvec3 moment = loads[b].first_moment;
        if (body.mass > 0.0) {
            body.centre = moment / body.mass;
        }
        body.sail = static_cast<float>(std::min(loads[b].sail, 1e30));
        carried[b] = body.mass;
        for (std::uint32_t c = body.first_child; c < body.first_child + body.child_count; ++c) {
            carried[b] += carried[c];
            moment += carried[c] * out.bodies[c].offset;
        }
        body.moment = moment;
    }
    add_ground(rest, carried, out);
    return out;
}

} // namespace lsys
