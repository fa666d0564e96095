// Bodies: the rigid bodies of a plant at rest, one for each segment, which carries its objects and
// polygons. Made once by PlantPhysics.
#pragma once

#include "runtime/physics/impl/symmetric.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace lsys {

/// Clearance of a body that the ground does not hold.
inline constexpr double kNoGround = std::numeric_limits<double>::infinity();

/// A rigid body. Vectors are from its base at rest, in the axes of the world.
struct Body {
    std::uint32_t parent = kNoSegment; // a body, before this one
    std::uint32_t first_child = 0;     // bodies, behind this one
    std::uint32_t child_count = 0;
    glm::dvec3 offset{0.0}; // of the base, from the parent's base
    glm::dvec3 centre{0.0}; // of mass
    Symmetric inertia;      // about the base
    double mass = 0.0;
    double spring = 0.0;
    /// Sum of mass times place over the body and its children, with the whole load of a child at
    /// the child's base: kg m.
    glm::dvec3 moment{0.0};
    // Area across the wind: side * sin + end * cos + sail of the angle between wind and heading.
    glm::vec3 heading{0.0F, 1.0F, 0.0F};
    float side = 0.0F; // m^2
    float end = 0.0F;
    float sail = 0.0F;
    // The ground: its contact is at the tip.
    glm::dvec3 tip{0.0};
    double clearance = kNoGround; // m, of the tip above the lowest place that it may take
    double ground_spring = 0.0;   // N/m
};

/// Bodies by depth, and within a depth by their parents, so that siblings are neighbours.
struct Bodies {
    std::vector<Body> bodies;
    std::vector<std::uint32_t> segments;   // of each body
    std::vector<std::uint32_t> places;     // the body of each segment
    std::vector<std::uint32_t> level_ends; // for each depth, the end of its bodies
};

/// `surface_mass`: kg per square metre of objects and polygons.
[[nodiscard]] Bodies make_bodies(const Skeleton& rest, double surface_mass);

/// A solid of uniform density about the middle of its base, for a mass of 1.
struct UnitCone {
    double centre = 0.0; // height of the centre of mass
    double across = 0.0; // inertia about an axis in the base
    double along = 0.0;  // about the axis from base to tip
};
/// The truncated cone of these radii: a cylinder where they are equal, a thin rod where both are 0.
[[nodiscard]] UnitCone unit_cone(double length, double base_radius, double tip_radius);

} // namespace lsys
