// SPDX-License-Identifier: MIT
// Bodies: the rigid bodies of a plant at rest, one for each segment with its objects and polygons.
// Made once by PlantPhysics.
#pragma once

#include "runtime/physics/impl/symmetric.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace lsys {

/// Clearance of a body that never touches the ground.
inline constexpr double kNoGround = std::numeric_limits<double>::infinity();

/// The tip of a body, as a point that the ground supports. Coordinates are relative to the base at
/// rest.
struct Contact {
    glm::dvec3 tip{0.0};
    double clearance = kNoGround; // m, distance by which the tip may sink
    double spring = 0.0;          // N/m
};

/// A rigid body. Vectors are relative to the base of the body at rest, in the axes of the world.
struct Body {
    std::uint32_t parent = kNoSegment; // index of an earlier body
    std::uint32_t first_child = 0;     // index of a later body
    std::uint32_t child_count = 0;
    glm::dvec3 offset{0.0}; // m, from the parent's base to the base of the body
    glm::dvec3 centre{0.0}; // m, centre of mass
    Symmetric inertia;      // kg m^2, about the base
    double mass = 0.0;      // kg
    double spring = 0.0;    // N m/rad
    /// Sum of mass times position over the body and its children, in kg m; each child counts at its
    /// base, with the mass of all its descendants.
    glm::dvec3 moment{0.0};
    // The area that faces the wind, in m^2, is side * sin(a) + end * cos(a) + sail, where a is the
    // angle between wind and heading.
    glm::vec3 heading{0.0F, 1.0F, 0.0F};
    float side = 0.0F;
    float end = 0.0F;
    float sail = 0.0F;
    Contact contact;
    // Range in Bodies::contacts: the contacts of a run of several bodies, in coarse plants.
    std::uint32_t first_contact = 0;
    std::uint32_t contact_count = 0;
};

/// Bodies sorted by depth, and within a depth by their parents, so that siblings are neighbours.
struct Bodies {
    std::vector<Body> bodies;
    std::vector<std::uint32_t> segments;        // index of the segment of each body
    std::vector<std::uint32_t> body_of_segment; // index of the body of each segment
    std::vector<std::uint32_t> level_ends;      // for each depth, the index after its last body
    std::vector<Contact> contacts;              // see Body::first_contact
};

/// Calls `use` for each contact of a body with the ground.
template <typename Use>
void for_each_contact(const Bodies& plant, const Body& body, const Use& use) {
    if (body.contact.spring > 0.0) {
        use(body.contact);
    }
    for (std::uint32_t c = 0; c < body.contact_count; ++c) {
        use(plant.contacts[body.first_contact + c]);
    }
}

/// `surface_mass`: kg per square metre of objects and polygons.
[[nodiscard]] Bodies make_bodies(const Skeleton& rest, double surface_mass);

/// Mass properties of a solid of uniform density and mass 1, relative to the middle of its base.
struct UnitCone {
    double centre = 0.0;     // m, height of the centre of mass
    double transverse = 0.0; // m^2, inertia about an axis in the base
    double axial = 0.0;      // m^2, inertia about the axis from base to tip
};
/// The truncated cone of these radii in m: a cylinder if they are equal, a thin rod if both are 0.
[[nodiscard]] UnitCone unit_cone(double length, double base_radius, double tip_radius);

} // namespace lsys
