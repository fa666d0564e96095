// SPDX-License-Identifier: MIT
// Computes the velocities at the end of a step by elimination from the tips to the root and back
// substitution: the articulated-body algorithm (Featherstone 2008, chapter 7) with ball joints, in
// absolute angular velocities. Time is linear in the number of bodies; no recursion.
//
// The unknowns are the spins w of the bodies; the base of a body moves with its parent, u = u_p +
// w_p x r. Implicit Euler, with the shape kept during the step, is the minimum over w of
//   sum of 1/2 (w, u) M (w, u) - (w, u) . (momentum + h force)         bodies
//        + 1/2 (h c + h^2 k) |w - w_p|^2 + h k d . (w - w_p)           joints: damper, spring
//        + 1/2 h^2 G |w|^2                                             weight and wind
// where h is the time step, M the mass matrix of a body, r the arm from the base of the parent to
// the base of the body, c the damping, k the spring constant and d the rotation vector of the joint.
// G is |g| |Body::moment|, plus |arm| |force| of the wind on the body and on each child with its
// descendants: the second derivative of the energy of the weight in absolute rotations has no
// coupling between bodies and is nowhere greater than G. The second derivative of the energy of a
// spring along a rotation is nowhere greater than k. So the energy at the minimum is lower than at
// the start of the step, however long the step is. Forces::exactness replaces these bounds by
// the true second derivatives. In directions with a negative true derivative, as for a branch that
// could fall to either side, the absolute value is used, so that all other directions keep the
// convergence of Newton's method.
//
// The ground is a spring 1/2 K depth^2 at each tip below it, whose force acts on all ancestors of
// the tip; its second derivatives are bounded and made exact in the same way. Friction acts against
// the motion along the ground, with the force of this spring times Forces::friction; a step treats
// friction as a damper. With Forces::own_load bases stand still and children are left out, so each
// joint is solved separately.
#include "grammar/base/trigonometry.h"
#include "runtime/physics/impl/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr double kMinInertia = 1e-13;         // relative to the trace: a bound of rounding errors
constexpr double kMaxTurn = std::numbers::pi; // rad per step; vectors of larger turns are ambiguous
constexpr double kStickingSpeed = 0.01; // m/s; at lower speeds friction is proportional to speed

/// Quadratic and linear form of a body in its spin and the velocity of its base. `push`: as
/// Reduced::push.
struct BodyForms {
    Symmetric spin_spin;
    Rows spin_velocity;
    Symmetric velocity_velocity;
    glm::dvec3 spin{0.0};
    glm::dvec3 velocity{0.0};
    glm::dvec3 push{0.0};
};

/// Adds `factor` times a second derivative to `sum`: of the energy -arm . force of a force at the
/// end of `arm`, with respect to rotations of `arm`. `exactness`: as Forces::exactness.
void add_stiffness(const glm::dvec3& arm,
                   const glm::dvec3& force,
                   double factor,
                   double exactness,
                   Symmetric& sum) {
    sum.add_diagonal(factor * (1.0 - exactness) * glm::length(arm) * glm::length(force));
    if (exactness == 0.0) {
        return;
    }
    // The true second derivative is arm . force - (arm force^T + force arm^T) / 2.
    const double f = factor * exactness;
    sum.add_diagonal(f * glm::dot(arm, force));
    sum += {-f * arm.x * force.x,
            -f * arm.y * force.y,
            -f * arm.z * force.z,
            -0.5 * f * (arm.x * force.y + arm.y * force.x),
            -0.5 * f * (arm.x * force.z + arm.z * force.x),
            -0.5 * f * (arm.y * force.z + arm.z * force.y)};
}

/// Adds the contact of a tip that is in the ground, or reaches it within the step: a spring along Y
/// with the force that it has at the end of the step, and friction along the ground. `own`: the
/// forms of the body.
void add_contact(const Contact& contact,
                 const BodyMotion& motion,
                 const BodyPose& pose,
                 const glm::dmat3& axes,
                 const Forces& forces,
                 BodyForms& own) {
    const double h = forces.step;
    const glm::dvec3 arm = axes * contact.tip;
    const double depth = ground_depth(contact, pose);
    const glm::dvec3 velocity = motion.velocity + glm::cross(motion.spin, arm);
    if (!(depth - h * std::min(velocity.y, 0.0) > 0.0)) {
        return;
    }
    const glm::dvec3 push(0.0, contact.spring * depth, 0.0);
    const double stiffness = h * h * contact.spring;
    const double speed = std::max(glm::length(glm::dvec2(velocity.x, velocity.z)), kStickingSpeed);
    const double braking = h * forces.friction * std::max(push.y, 0.0) / speed;
    own.spin += h * glm::cross(arm, push);
    // (w x arm).y = w . (-arm.z, 0, arm.x)
    const double difference = stiffness - braking;
    own.spin_spin += point_inertia(braking, arm);
    own.spin_spin += {difference * arm.z * arm.z,  0.0, difference * arm.x * arm.x, 0.0,
                      -difference * arm.x * arm.z, 0.0};
    if (depth > 0.0) {
        add_stiffness(arm, push, h * h, forces.exactness, own.spin_spin);
        own.push += push;
    }
    if (!forces.own_load) {
        own.velocity += h * push;
        const Rows across = cross_rows(braking * arm);
        for (std::size_t i = 0; i < 3; ++i) {
            own.spin_velocity.row[i] += across.row[i];
        }
        own.spin_velocity.row[0].y -= difference * arm.z;
        own.spin_velocity.row[2].y += difference * arm.x;
        own.velocity_velocity += {braking, stiffness, braking, 0.0, 0.0, 0.0};
    }
}

/// The quadratic and linear forms of a body for Forces::own_load, where the joint carries no
/// descendants and the base of the body stands still.
BodyForms own_load_forms(const Body& body,
                         const BodyMotion& motion,
                         const glm::dquat& turn,
                         const glm::dmat3& axes,
                         const Forces& forces) {
    const double h = forces.step;
    const glm::dvec3 centre = axes * body.centre;
    const glm::dvec3& w = motion.spin;
    BodyForms own;
    own.spin_spin = rotated(body.inertia, axes);
    const glm::dvec3 angular = own.spin_spin * w;
    glm::dvec3 force = body.mass * forces.gravity;
    if (forces.drag > 0.0) {
        const double drag = wind_drag(body, turn, glm::cross(w, centre), forces);
        force += drag * forces.wind;
        own.spin_spin += point_inertia(h * drag, centre);
    }
    own.spin = angular +
               h * (glm::cross(centre, force) - centrifugal_factor(w, h) * glm::cross(w, angular));
    add_stiffness(centre, force, h * h, forces.exactness, own.spin_spin);
    return own;
}

/// The quadratic and linear forms of a body alone, without its children.
BodyForms own_forms(const Body& body,
                    const BodyMotion& motion,
                    const glm::dquat& turn,
                    const glm::dmat3& axes,
                    const Forces& forces) {
    const double h = forces.step;
    const glm::dvec3 centre = axes * body.centre;
    const Symmetric inertia = rotated(body.inertia, axes);
    const glm::dvec3& w = motion.spin;
    const glm::dvec3 arm_velocity = glm::cross(w, centre);
    const glm::dvec3 angular = inertia * w;
    const double share = centrifugal_factor(w, h);

    glm::dvec3 force = body.mass * forces.gravity;
    double drag = 0.0;
    BodyForms own;
    if (forces.drag > 0.0) {
        drag = wind_drag(body, turn, motion.velocity + arm_velocity, forces);
        own.push = drag * forces.wind;
        force += own.push;
    }
    own.spin = angular + body.mass * glm::cross(centre, motion.velocity) +
               h * (glm::cross(centre, force - body.mass * motion.centripetal) -
                    share * glm::cross(w, angular));
    own.velocity =
        body.mass * (motion.velocity + arm_velocity) +
        h * (force - body.mass * (motion.centripetal + share * glm::cross(w, arm_velocity)));
    const double mass_with_drag = body.mass + h * drag;
    own.spin_spin = inertia;
    own.spin_spin += point_inertia(h * drag, centre);
    add_stiffness(axes * body.moment, forces.gravity, h * h, forces.exactness, own.spin_spin);
    if (forces.windy) {
        add_stiffness(centre, own.push, h * h, forces.exactness, own.spin_spin);
    }
    own.spin_velocity = cross_rows(mass_with_drag * centre);
    own.velocity_velocity.add_diagonal(mass_with_drag);
    return own;
}

/// Adds the forms of a child to the forms of its parent. `offset`: from the base of the parent to
/// the base of the child, in m. `own`: the forms of the parent.
void add_child(const Reduced& child,
               const glm::dvec3& offset,
               const Forces& forces,
               BodyForms& own) {
    // Substitutes u = u_p + w_p x r (see the top of this file). m is spin_velocity + [r]
    // velocity_velocity by rows, where [r] v = r x v.
    const Rows n = rows_of(child.velocity_velocity);
    const std::array<glm::dvec3, 3>& b = child.spin_velocity.row;
    const std::array<glm::dvec3, 3> m = {b[0] - offset.z * n.row[1] + offset.y * n.row[2],
                                         b[1] + offset.z * n.row[0] - offset.x * n.row[2],
                                         b[2] - offset.y * n.row[0] + offset.x * n.row[1]};
    const std::array<glm::dvec3, 3> left = {glm::cross(m[0], offset), glm::cross(m[1], offset),
                                            glm::cross(m[2], offset)}; // rows of m [r]
    const std::array<glm::dvec3, 3> right = {glm::cross(offset, b[0]), glm::cross(offset, b[1]),
                                             glm::cross(offset, b[2])}; // columns of [r] b^T
    own.spin_spin += child.spin_spin;
    own.spin_spin += {right[0].x - left[0].x,
                      right[1].y - left[1].y,
                      right[2].z - left[2].z,
                      0.5 * (right[1].x - left[0].y + right[0].y - left[1].x),
                      0.5 * (right[2].x - left[0].z + right[0].z - left[2].x),
                      0.5 * (right[2].y - left[1].z + right[1].z - left[2].y)};
    for (std::size_t i = 0; i < 3; ++i) {
        own.spin_velocity.row[i] += m[i];
    }
    own.velocity_velocity += child.velocity_velocity;
    own.spin += child.spin + glm::cross(offset, child.velocity);
    own.velocity += child.velocity;
    if (child.push != glm::dvec3(0.0)) {
        own.push += child.push;
        add_stiffness(offset, child.push, forces.step * forces.step, forces.exactness,
                      own.spin_spin);
    }
}

/// Eliminates the spin of a body from its forms `own`, which include its descendants.
void eliminate_spin(const BodyForms& own,
                    const Body& body,
                    const BodyMotion& motion,
                    const Forces& forces,
                    JointSolution& solution,
                    Reduced& reduced) {
    const double h = forces.step;
    const double hooke = h * h * body.spring;
    const glm::dvec3& bend = motion.bend;
    Symmetric inertia = own.spin_spin;
    inertia.add_diagonal(kMinInertia * std::max(inertia.trace(), 0.0));
    Symmetric joint_matrix; // damping and stiffness of the joint
    joint_matrix.add_diagonal(h * forces.damping + hooke);
    Rows twist; // joint_matrix + twist couples the spins of parent and body
    if (forces.exactness > 0.0) {
        // Half the squared angle of exp(v) exp(bend) has the second derivative x cot x in
        // directions normal to the bend, with x = |bend| / 2. The twist comes from
        // exp(-w_p) exp(w) = exp(w - w_p - w_p x w / 2 ...).
        const double half = 0.5 * glm::length(bend);
        const SineCosine turn = sine_cosine(half);
        const double normal_stiffness =
            half > 1e-3 ? half * turn.cosine / turn.sine : 1.0 - half * half / 3.0;
        const double normal_stiffness_loss =
            half > 1e-3 ? (1.0 - normal_stiffness) / (4.0 * half * half) : 1.0 / 12.0;
        joint_matrix +=
            scaled(point_inertia(-normal_stiffness_loss, bend), forces.exactness * hooke);
        twist = cross_rows(0.5 * forces.exactness * hooke * bend);
    }
    Symmetric sum = inertia;
    sum += joint_matrix;
    if (forces.exactness > 0.0 && !is_positive(sum)) {
        const Symmetric lift = lift_to_positive(sum);
        inertia += lift;
        sum += lift;
    }
    if (!(sum.trace() > 0.0)) { // no inertia, spring or force: moves with the parent
        joint_matrix.add_diagonal(1.0);
        sum.add_diagonal(1.0);
    }
    const Symmetric inverse_sum = inverse(sum);
    const glm::dvec3 torque = h * body.spring * bend;
    const glm::dvec3 known = own.spin - torque;
    const Rows from_velocity = product(inverse_sum, own.spin_velocity);
    Rows from_parent = product(inverse_sum, rows_of(joint_matrix));

    // With J = joint_matrix and I = inertia: J - J (I + J)^-1 J = J (I + J)^-1 I, and the right side
    // has no cancellation.
    reduced.spin_spin = symmetric_product(from_parent, rows_of(inertia));
    const glm::dvec3 spring_spin = inverse_sum * torque;
    reduced.spin = inertia * spring_spin;
    if (forces.exactness > 0.0) {
        const Rows twisted = product(inverse_sum, twist);
        reduced.spin_spin += scaled(symmetric_product(from_parent, twist), -2.0);
        reduced.spin_spin += scaled(symmetric_product(twisted, twist), -1.0);
        reduced.spin += twist * spring_spin;
        for (std::size_t i = 0; i < 3; ++i) {
            from_parent.row[i] += twisted.row[i];
        }
    }
    reduced.spin += from_parent.transposed_times(own.spin);
    reduced.spin_velocity = transposed_product(from_parent, own.spin_velocity);
    reduced.velocity_velocity = own.velocity_velocity;
    reduced.velocity_velocity += scaled(symmetric_product(own.spin_velocity, from_velocity), -1.0);
    reduced.velocity = own.velocity - from_velocity.transposed_times(known);
    reduced.push = own.push;

    solution.offset = inverse_sum * known;
    solution.from_parent = from_parent;
    solution.from_velocity = from_velocity;
}

} // namespace

void solve_spins(PlantBodies& plant, const Forces& forces, Workers& workers) {
    const std::vector<Body>& bodies = plant.rest.bodies;
    plant.schedule.inward(workers, [&](std::uint32_t begin, std::uint32_t end, std::uint32_t) {
        for (std::uint32_t b = end; b-- > begin;) {
            const Body& body = bodies[b];
            const glm::dquat& turn = plant.poses[b].turn;
            const glm::dmat3 axes = glm::mat3_cast(turn);
            BodyForms own = forces.own_load
                                ? own_load_forms(body, plant.motion[b], turn, axes, forces)
                                : own_forms(body, plant.motion[b], turn, axes, forces);
            if (forces.ground) {
                for_each_contact(plant.rest, body, [&](const Contact& contact) {
                    add_contact(contact, plant.motion[b], plant.poses[b], axes, forces, own);
                });
            }
            const std::uint32_t felt = forces.own_load ? 0 : body.child_count;
            for (std::uint32_t c = body.first_child; c < body.first_child + felt; ++c) {
                add_child(plant.reduced[c & plant.reduced_mask], axes * bodies[c].offset, forces,
                          own);
            }
            eliminate_spin(own, body, plant.motion[b], forces, plant.solution[b],
                           plant.reduced[b & plant.reduced_mask]);
        }
    });
    plant.schedule.outward(workers, [&](std::uint32_t begin, std::uint32_t end, std::uint32_t) {
        for (std::uint32_t b = begin; b < end; ++b) {
            const Body& body = bodies[b];
            JointSolution& solution = plant.solution[b];
            glm::dvec3 parent_spin(0.0);
            glm::dvec3 velocity(0.0);
            if (body.parent != kNoSegment) {
                parent_spin = plant.solution[body.parent].spin;
                velocity = plant.motion[body.parent].velocity +
                           glm::cross(parent_spin, plant.poses[body.parent].turn * body.offset);
            }
            plant.motion[b].velocity = velocity;
            solution.spin = solution.offset + solution.from_parent * parent_spin -
                            solution.from_velocity * velocity;
            const double turn = forces.step * glm::length(solution.spin);
            if (!std::isfinite(turn)) {
                solution.spin = parent_spin;
            } else if (turn > kMaxTurn) {
                solution.spin *= kMaxTurn / turn;
            }
        }
    });
}

} // namespace lsys
