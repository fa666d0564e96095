// SPDX-License-Identifier: MIT
// Motion: positions and velocities of the bodies of a plant, and the forces on them in a step.
#pragma once

#include "runtime/base/workers.h"
#include "runtime/physics/impl/bodies.h"
#include "runtime/physics/impl/schedule.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace lsys {

/// Duration of a time step, and the values from which the forces in this step are computed.
struct Forces {
    double step = 0.0;       // s, length of the step
    glm::dvec3 gravity{0.0}; // m/s^2
    double damping = 0.0;    // N m s/rad
    glm::dvec3 wind{0.0};    // m/s
    double drag = 0.0;       // kg/m^3, half the density of air times the drag coefficient
    bool windy = false;      // whether drag and wind are both above 0
    bool ground = false;     // whether the ground supports tips
    double friction = 0.0;   // coefficient of friction of the ground
    bool own_load = false;   // a joint bears only its own body, not the descendants
    /// Selects the second derivatives of weight, wind, springs and ground. 0: upper bounds, the
    /// greatest value of all directions; 1: true values, which are negative in some directions;
    /// between 0 and 1: interpolated values.
    double exactness = 0.0;
};

/// Rotation of a body since rest and displacement of its base, in the axes of the world.
struct BodyPose {
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 shift{0.0}; // m
};

/// Motion of a body, in the axes of the world.
struct BodyMotion {
    glm::dvec3 bend{0.0};        // rotation vector of the joint since rest, relative to the parent
    glm::dvec3 spin{0.0};        // rad/s
    glm::dvec3 velocity{0.0};    // of the base, m/s
    glm::dvec3 centripetal{0.0}; // centripetal acceleration of the base, m/s^2
};

/// The solution for the spin of a body at the end of the step: spin = offset + from_parent * (spin
/// of the parent) - from_velocity * (velocity of the base).
struct JointSolution {
    glm::dvec3 offset{0.0};
    Rows from_parent;
    Rows from_velocity;
    glm::dvec3 spin{0.0}; // rad/s
};

/// The effect of a body and its descendants on the parent: a quadratic and a linear form in the
/// spin of the parent and the velocity of the base of the body.
struct Reduced {
    // Coefficients of the quadratic form, named by the two factors of their terms.
    Symmetric spin_spin;
    Rows spin_velocity;
    Symmetric velocity_velocity;
    // Coefficients of the linear form.
    glm::dvec3 spin{0.0};
    glm::dvec3 velocity{0.0};
    glm::dvec3 push{0.0}; // N, force of wind and ground on the body and its descendants
};

struct PlantBodies {
    Bodies rest;
    Schedule schedule;
    // By body:
    std::vector<BodyPose> poses;
    std::vector<BodyPose> next_poses; // poses after the step that is tried
    std::vector<BodyMotion> motion;
    std::vector<JointSolution> solution;
    std::vector<Reduced> reduced; // ring buffer: body b is at index b & reduced_mask
    std::uint32_t reduced_mask = 0;
};

/// Drag coefficient in N s/m of a body whose centre moves at `velocity`: its drag divided by its
/// speed relative to the wind.
[[nodiscard]] double wind_drag(const Body& body,
                               const glm::dquat& turn,
                               const glm::dvec3& velocity,
                               const Forces& forces);

/// Depth in m of the tip below its lowest allowed position; negative if it is above this position.
[[nodiscard]] inline double ground_depth(const Contact& contact, const BodyPose& pose) {
    return -(contact.clearance + pose.shift.y + (pose.turn * contact.tip - contact.tip).y);
}

/// Computes JointSolution::spin of all bodies: the angular velocities at the end of an implicit
/// step, with the shape of the plant kept constant. Overwrites BodyMotion::velocity.
void solve_spins(PlantBodies& plant, const Forces& forces, Workers& workers);

/// Energies and work in J after a step, and the largest rotation in the step.
struct Energies {
    double kinetic = 0.0;
    double potential = 0.0;           // springs, weight and ground; 0 at rest
    double potential_magnitude = 0.0; // sum of the magnitudes of the terms of `potential`
    double work = 0.0;                // work of the wind
    double slide = 0.0;               // sum over tips: force of the ground times distance slid
    double turn = 0.0;                // rad, max rotation of a body
};
/// Turns each body by its solved spin times `duration` seconds, writes the poses to next_poses, and
/// computes BodyMotion for these poses and for the spins multiplied by `speed`.
[[nodiscard]] Energies move_bodies(
    PlantBodies& plant, const Forces& forces, double duration, double speed, Workers& workers);
/// Multiplies all velocities by `factor`.
void scale_velocities(PlantBodies& plant, double factor, Workers& workers);

/// Factor of centrifugal accelerations; it decreases towards 0 as the rotation in a step becomes
/// large.
[[nodiscard]] inline double centrifugal_factor(const glm::dvec3& spin, double step) {
    return 1.0 / (1.0 + step * step * glm::dot(spin, spin));
}

} // namespace lsys
