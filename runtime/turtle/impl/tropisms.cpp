// SPDX-License-Identifier: MIT
// The formulas of cpfg (Mech, Prusinkiewicz and Hanan: "Extensions to the graphical interpretation
// of L-systems based on turtle geometry", 1997; cpfg user's manual, section on tropisms). The up
// axis of cpfg points the other way, which changes no formula but the direction of a twist.
#include "runtime/turtle/impl/tropisms.h"

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_geometric.hpp>

#include <algorithm>
#include <cmath>

namespace lsys {

namespace {

// Lengths below which two directions count as parallel, as in cpfg.
constexpr double kParallel = 1e-6;
constexpr double kParallelTwist = 1e-7;
constexpr double kAlignedSquare = 1e-8;

void add(SensingVector& sum, const SensingVector& a, double factor) {
    for (std::size_t i = 0; i < 3; ++i) {
        sum[i] += factor * a[i];
    }
}

SensingVector direction_of(const StepTropism& tropism) {
    return {static_cast<double>(tropism.direction[0]), static_cast<double>(tropism.direction[1]),
            static_cast<double>(tropism.direction[2])};
}

/// Rotates `v` about the unit vector `axis` (formula of Rodrigues).
void rotate(SensingVector& v, const SensingVector& axis, const ExactSineCosine& turn) {
    const SensingVector across = cross(axis, v);
    const double along = dot(axis, v) * (1.0 - turn.cosine);
    for (std::size_t i = 0; i < 3; ++i) {
        v[i] = (v[i] * turn.cosine + across[i] * turn.sine) + axis[i] * along;
    }
}

SensingPose sensing_pose_of(const Pose& pose) {
    const glm::dquat frame = glm::normalize(glm::dquat(pose.qw, pose.qx, pose.qy, pose.qz));
    const auto axis = [&](const glm::dvec3& unit) {
        const glm::dvec3 turned = frame * unit;
        return SensingVector{turned.x, turned.y, turned.z};
    };
    SensingPose result;
    result.heading = axis({0.0, 1.0, 0.0});
    result.right = axis({1.0, 0.0, 0.0});
    result.up = axis({0.0, 0.0, 1.0});
    return result;
}

void set_axes(Pose& pose, const SensingPose& axes) {
    const auto column = [](const SensingVector& a) { return glm::dvec3(a[0], a[1], a[2]); };
    const glm::dquat frame =
        glm::quat_cast(glm::dmat3(column(axes.right), column(axes.heading), column(axes.up)));
    pose.qw = frame.w;
    pose.qx = frame.x;
    pose.qy = frame.y;
    pose.qz = frame.z;
}

/// The turn by the angle whose sine is `sine`, limited to -1 to 1.
ExactSineCosine turn_of_sine(double sine) {
    const double limited = std::clamp(sine, -1.0, 1.0);
    return {limited, std::sqrt(1.0 - limited * limited)};
}

} // namespace

Tropisms::Tropisms(const StepTropisms& settings) : rows_(settings), any_(has_tropisms(settings)) {
    begin();
}

void Tropisms::begin() {
    now_ = {};
    stack_.clear();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        now_.strengths[i] = static_cast<double>(rows_[i].strength);
    }
}

void Tropisms::restore() {
    if (!stack_.empty()) {
        now_ = stack_.back();
        stack_.pop_back();
    }
}

void Tropisms::before_step(SensingPose& pose) {
    turn_heading(pose);
    twist(pose);
}

/// Turns the heading by |H x V| radians, at most 1, towards V. V is the sum over the tropisms of
/// the kind Before: e T for an angle a of 0, else e (cos(a) T + sin(a) T x (H x T) / |H x T|).
/// untwist() sets the other axes.
void Tropisms::turn_heading(SensingPose& pose) {
    SensingVector wanted{};
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        if (rows_[i].kind != TropismKind::Before) {
            continue;
        }
        const SensingVector towards = direction_of(rows_[i]);
        const ExactSineCosine angle =
            exact_sine_cosine_of_degrees(static_cast<double>(rows_[i].angle));
        add(wanted, towards, angle.cosine * now_.strengths[i]);
        if (angle.sine == 0.0) {
            continue;
        }
        SensingVector across = cross(pose.heading, towards);
        double length = length_of(across);
        if (length < kParallelTwist) { // any plane will do; cpfg takes that of the left axis
            across = {-pose.right[0], -pose.right[1], -pose.right[2]};
            length = 1.0;
        }
        add(wanted, cross(towards, across), angle.sine * now_.strengths[i] / length);
    }
    SensingVector axis = cross(pose.heading, wanted);
    const double length = length_of(axis);
    if (length < kParallel) {
        return;
    }
    for (double& part : axis) {
        part /= length;
    }
    rotate(pose.heading, axis, exact_sine_cosine(std::min(length, 1.0)));
    untwist(pose);
}

/// Sets up and right to those of the last segment, turned by the shortest rotation from its heading
/// to the current heading.
void Tropisms::untwist(SensingPose& pose) const {
    SensingVector axis = cross(now_.heading, pose.heading);
    const double sine = length_of(axis);
    if (sine > kParallel) {
        for (double& part : axis) {
            part /= sine;
        }
        pose.up = now_.up;
        rotate(pose.up, axis, {std::min(sine, 1.0), dot(now_.heading, pose.heading)});
    }
    pose.right = cross(pose.heading, pose.up);
}

/// Turns the up axis about the heading by |U x P| radians, at most 1, towards P: the sum of e T
/// over the tropisms of the kind Twist, projected to the plane of up and right.
void Tropisms::twist(SensingPose& pose) {
    SensingVector wanted{};
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        if (rows_[i].kind == TropismKind::Twist) {
            add(wanted, direction_of(rows_[i]), now_.strengths[i]);
        }
    }
    const double strength = length_of(wanted);
    if (strength == 0.0) {
        return;
    }
    const double along = dot(wanted, pose.heading);
    const SensingVector side = cross(pose.heading, wanted);
    if (dot(side, side) <= kAlignedSquare * strength * strength) {
        return;
    }
    add(wanted, pose.heading, -along);
    SensingVector axis = cross(pose.up, wanted);
    const double length = length_of(axis);
    if (length >= kParallelTwist) {
        for (double& part : axis) {
            part /= length;
        }
        rotate(pose.up, axis, exact_sine_cosine(std::min(length, 1.0)));
        pose.right = cross(pose.heading, pose.up);
    }
    keep(pose);
}

/// Pitches up by the angle with the sine e T.U, then yaws right by that with the sine e T.R.
void Tropisms::after_step(SensingPose& pose, bool draws) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        if (rows_[i].kind == TropismKind::After && now_.strengths[i] != 0.0) {
            const SensingVector towards = direction_of(rows_[i]);
            pitch_up(pose, turn_of_sine(now_.strengths[i] * dot(towards, pose.up)));
            yaw_right(pose, turn_of_sine(now_.strengths[i] * dot(towards, pose.right)));
        }
    }
    if (draws) {
        keep(pose);
    }
}

void Tropisms::keep(const SensingPose& pose) {
    now_.heading = pose.heading;
    now_.up = pose.up;
}

std::size_t Tropisms::row_of(float number) const {
    float left = std::trunc(number);
    for (std::size_t i = 0; i < rows_.size() && left >= 1.0F; ++i) {
        const TropismKind kind = rows_[i].kind;
        if ((kind == TropismKind::Before || kind == TropismKind::Twist) && --left < 1.0F) {
            return i;
        }
    }
    return rows_.size();
}

void Tropisms::execute(TurtleOperation operation,
                       std::uint32_t argument_count,
                       const float* arguments,
                       SensingPose& pose) {
    const auto number = [&](std::uint32_t index, double otherwise) {
        return argument_count > index ? static_cast<double>(arguments[index]) : otherwise;
    };
    if (operation == TurtleOperation::Untwist) {
        untwist(pose);
        return;
    }
    if (operation == TurtleOperation::KeepTwist) {
        keep(pose);
        return;
    }
    if (operation == TurtleOperation::SetSusceptibility) {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            if (rows_[i].kind == TropismKind::After) {
                const auto increment = static_cast<double>(rows_[i].increment);
                now_.strengths[i] = number(0, now_.strengths[i] + increment);
            }
        }
        return;
    }
    const std::size_t row = argument_count > 0 ? row_of(arguments[0]) : rows_.size();
    if (row == rows_.size()) {
        return;
    }
    double& strength = now_.strengths[row];
    const double increment = number(1, static_cast<double>(rows_[row].increment));
    if (operation == TurtleOperation::SetTropism) {
        strength = number(1, 0.0);
    } else {
        strength += operation == TurtleOperation::AddTropism ? increment : -increment;
    }
}

void Tropisms::before_step(Pose& pose) {
    SensingPose axes = sensing_pose_of(pose);
    before_step(axes);
    set_axes(pose, axes);
}

void Tropisms::after_step(Pose& pose, bool draws) {
    SensingPose axes = sensing_pose_of(pose);
    after_step(axes, draws);
    set_axes(pose, axes);
}

void Tropisms::execute(TurtleOperation operation,
                       std::uint32_t argument_count,
                       const float* arguments,
                       Pose& pose) {
    SensingPose axes = sensing_pose_of(pose);
    execute(operation, argument_count, arguments, axes);
    if (operation == TurtleOperation::Untwist) {
        set_axes(pose, axes);
    }
}

} // namespace lsys
