// SPDX-License-Identifier: MIT
#include "runtime/physics/impl/motion.h"

#include "runtime/physics/impl/rotation.h"

#include <algorithm>
#include <cmath>

namespace lsys {

double wind_drag(const Body& body,
                 const glm::dquat& turn,
                 const glm::dvec3& velocity,
                 const Forces& forces) {
    const glm::dvec3 flow = forces.wind - velocity;
    const double speed = glm::length(flow);
    if (!(speed > 0.0)) {
        return 0.0;
    }
    const double cosine =
        std::min(std::abs(glm::dot(turn * glm::dvec3(body.heading), flow)) / speed, 1.0);
    const double area = static_cast<double>(body.side) * std::sqrt(1.0 - cosine * cosine) +
                        static_cast<double>(body.end) * cosine + static_cast<double>(body.sail);
    return forces.drag * area * speed;
}

namespace {

void move_body(PlantBodies& plant,
               const Forces& forces,
               double duration,
               double speed,
               std::uint32_t b,
               Energies& sum) {
    const Body& body = plant.rest.bodies[b];
    BodyMotion& motion = plant.motion[b];
    const glm::dvec3 rotation = duration * plant.solution[b].spin;
    const glm::dquat turn = glm::normalize(rotation_of(rotation) * plant.poses[b].turn);
    glm::dvec3 shift(0.0);
    const glm::dvec3 spin = speed * plant.solution[b].spin;
    motion.spin = spin;
    if (body.parent == kNoSegment) {
        motion.velocity = glm::dvec3(0.0);
        motion.centripetal = glm::dvec3(0.0);
        motion.bend = vector_of(turn);
    } else {
        const BodyMotion& parent = plant.motion[body.parent];
        const glm::dquat& parent_turn = plant.next_poses[body.parent].turn;
        const glm::dvec3 offset = parent_turn * body.offset;
        const glm::dvec3 around = glm::cross(parent.spin, offset);
        shift = plant.next_poses[body.parent].shift + (offset - body.offset);
        motion.velocity = parent.velocity + around;
        motion.centripetal = parent.centripetal + centrifugal_factor(parent.spin, forces.step) *
                                                      glm::cross(parent.spin, around);
        motion.bend = vector_of(turn * glm::conjugate(parent_turn));
    }
    plant.next_poses[b] = {turn, shift};
    const glm::dvec3 centre = turn * body.centre;
    const glm::dvec3 arm_velocity = glm::cross(spin, centre);
    const glm::dvec3 own_spin = glm::conjugate(turn) * spin;
    double kinetic_term = glm::dot(own_spin, body.inertia * own_spin);
    glm::dvec3 displacement = centre - body.centre;
    if (!forces.own_load) {
        kinetic_term += body.mass * glm::dot(motion.velocity, motion.velocity + 2.0 * arm_velocity);
        displacement += shift;
    }
    sum.kinetic += 0.5 * kinetic_term;
    double elastic_energy = 0.5 * body.spring * glm::dot(motion.bend, motion.bend);
    if (forces.ground) {
        for_each_contact(plant.rest, body, [&](const Contact& contact) {
            const double depth = ground_depth(contact, plant.next_poses[b]);
            if (depth > 0.0) {
                const BodyPose& before = plant.poses[b];
                const glm::dvec3 tip_shift =
                    shift - before.shift + turn * contact.tip - before.turn * contact.tip;
                elastic_energy += 0.5 * contact.spring * depth * depth;
                sum.slide +=
                    contact.spring * depth * glm::length(glm::dvec2(tip_shift.x, tip_shift.z));
            }
        });
    }
    const double gravitational_energy = -body.mass * glm::dot(forces.gravity, displacement);
    sum.potential += elastic_energy + gravitational_energy;
    sum.potential_magnitude += elastic_energy + std::abs(gravitational_energy);
    if (forces.windy) {
        const glm::dvec3 velocity = motion.velocity + arm_velocity;
        const BodyPose& before = plant.poses[b];
        const glm::dvec3 centre_shift = shift - before.shift + centre - before.turn * body.centre;
        sum.work += wind_drag(body, turn, velocity, forces) *
                    glm::dot(forces.wind - velocity, centre_shift);
    }
    sum.turn = std::max(sum.turn, glm::length(rotation));
}

} // namespace

Energies move_bodies(
    PlantBodies& plant, const Forces& forces, double duration, double speed, Workers& workers) {
    std::vector<Energies> sums(plant.schedule.piece_count());
    plant.schedule.outward(workers,
                           [&](std::uint32_t begin, std::uint32_t end, std::uint32_t piece) {
                               Energies sum;
                               for (std::uint32_t b = begin; b < end; ++b) {
                                   move_body(plant, forces, duration, speed, b, sum);
                               }
                               sums[piece] = sum;
                           });
    Energies total;
    for (const Energies& sum : sums) {
        total.kinetic += sum.kinetic;
        total.potential += sum.potential;
        total.potential_magnitude += sum.potential_magnitude;
        total.work += sum.work;
        total.slide += sum.slide;
        total.turn = std::max(total.turn, sum.turn);
    }
    return total;
}

void scale_velocities(PlantBodies& plant, double factor, Workers& workers) {
    plant.schedule.outward(workers, [&](std::uint32_t begin, std::uint32_t end, std::uint32_t) {
        for (std::uint32_t b = begin; b < end; ++b) {
            BodyMotion& motion = plant.motion[b];
            motion.spin *= factor;
            motion.velocity *= factor;
            motion.centripetal *= factor * factor;
        }
    });
}

} // namespace lsys
