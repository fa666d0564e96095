// Motion: places and velocities of the bodies of a plant, and the forces on them in a step.
#pragma once

#include "runtime/base/workers.h"
#include "runtime/physics/impl/bodies.h"
#include "runtime/physics/impl/schedule.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace lsys {

/// Forces of one step.
struct Forces {
    double step = 0.0;       // s
    glm::dvec3 gravity{0.0}; // m/s^2
    double damping = 0.0;    // N m s/rad
    glm::dvec3 wind{0.0};    // m/s
    double drag = 0.0;       // half the air's density times the drag coefficient
    bool windy = false;
    bool ground = false;
    bool own_load = false; // bodies do not feel what they carry
    /// Stiffness of weight, wind and springs: 0: the greatest of all directions; 1: the true one,
    /// negative in some directions; between: interpolated.
    double exactness = 0.0;
};

/// Rotation of a body since rest and displacement of its base, in the axes of the world.
struct BodyPose {
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 shift{0.0};
};

/// Motion of a body, in the axes of the world.
struct BodyMotion {
    glm::dvec3 bend{0.0};     // of its joint: rotation vector from rest, relative to the parent
    glm::dvec3 spin{0.0};     // rad/s
    glm::dvec3 velocity{0.0}; // of the base, m/s
    glm::dvec3 pull{0.0};     // acceleration of the base if no spin changes, m/s^2
};

/// Angular velocities at the end of the step are offset + from_parent * (the parent's) -
/// from_velocity * (velocity of the base).
struct JointSolution {
    glm::dvec3 offset{0.0};
    Rows from_parent;
    Rows from_velocity;
    glm::dvec3 spin{0.0}; // the result
};

/// A body and all beyond it, as felt by its parent: a quadratic form of the parent's
/// spin and of the velocity of the body's base, and a linear form.
struct Reduced {
    Symmetric spin_spin;
    Rows spin_velocity;
    Symmetric velocity_velocity;
    glm::dvec3 spin{0.0};
    glm::dvec3 velocity{0.0};
    glm::dvec3 push{0.0}; // N, of wind and ground, on the body and all beyond it
};

struct PlantBodies {
    Bodies rest;
    Schedule schedule;
    std::vector<BodyPose> poses;
    std::vector<BodyPose> next_poses;
    std::vector<BodyMotion> motion;
    std::vector<JointSolution> solution;
    std::vector<Reduced> reduced; // a ring: body b is at b & reduced_mask
    std::uint32_t reduced_mask = 0;
};

/// Drag coefficient of a body whose centre moves at `velocity`: N s/m.
[[nodiscard]] double wind_drag(const Body& body,
                               const glm::dquat& turn,
                               const glm::dvec3& velocity,
                               const Forces& forces);

/// Depth of the tip of a body below the lowest place that it may take, negative above it.
[[nodiscard]] inline double ground_depth(const Body& body, const BodyPose& pose) {
    return -(body.clearance + pose.shift.y + (pose.turn * body.tip - body.tip).y);
}

/// Solution::spin of all bodies: the velocities at the end of an implicit step, if the plant kept
/// its shape. Spoils Motion's velocity.
void solve_spins(PlantBodies& plant, const Forces& forces, Workers& workers);

struct Energies {
    double motion = 0.0;
    double position = 0.0; // springs, weight and ground; 0 at rest
    double terms = 0.0;    // sum of the magnitudes of the terms of `position`
    double work = 0.0;     // by the wind
    double turn = 0.0;     // rad, max
};
/// Turns each body by `duration` seconds of the solved spins, into next_poses, and fills Motion for
/// that place and `speed` times these spins.
[[nodiscard]] Energies move_bodies(
    PlantBodies& plant, const Forces& forces, double duration, double speed, Workers& workers);
/// Multiplies all velocities by `factor`.
void scale_velocities(PlantBodies& plant, double factor, Workers& workers);

/// Factor of accelerations v^2 / r, which falls to 0 where a body turns too far in a step for them.
[[nodiscard]] inline double centrifugal_factor(const glm::dvec3& spin, double step) {
    return 1.0 / (1.0 + step * step * glm::dot(spin, spin));
}

} // namespace lsys
