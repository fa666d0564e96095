// SPDX-License-Identifier: MIT
// Operations that only the turtles of Fractint and Houdini have.
#include "runtime/turtle/impl/state.h"

namespace lsys {

/// Forward with the parameters of Houdini: length, width, sections (ignored), sides.
bool Turtle::State::forward_with_width(const Action& action, const float* arguments, float part) {
    constexpr std::uint8_t kSides = 3; // index of the argument
    const float length = (action.argument_count > 0 ? arguments[0] : now.step) * part;
    const float width = action.argument_count > 1 ? arguments[1] : now.width;
    const std::uint8_t sides = now.sides;
    if (width < 0.0F) {
        note(TurtleFaultKind::NegativeWidth);
    }
    if (action.argument_count > kSides) {
        set_sides(arguments[kSides]);
    }
    const float drawn_width = std::max(width, 0.0F);
    polygons.begin_step(now.pose);
    const bool fine = draw(static_cast<double>(length), drawn_width, drawn_width, nullptr, nullptr);
    polygons.end_step(now.pose);
    now.sides = sides;
    return fine;
}

/// Pitches, rolls and yaws by the arguments, in degrees; missing arguments are 0.
void Turtle::State::turn_by(const Action& action, const float* arguments) {
    const auto angle = [&](std::uint8_t index) {
        return half_angle(action.argument_count > index ? static_cast<double>(arguments[index])
                                                        : 0.0);
    };
    pitch(now.pose, angle(0));
    roll(now.pose, angle(1));
    yaw(now.pose, angle(2));
}

/// Turns the first heading left; the second heading keeps its direction.
void Turtle::State::turn_left(double degrees) {
    yaw(now.pose, half_angle(degrees));
    now.second_heading = std::remainder(now.second_heading - degrees, kFullTurn);
}

/// With n the number of angles in a full turn: turns clockwise in the plane by floor(n / 2) of
/// these angles, whether or not the pose is mirrored.
void Turtle::State::half_turn_snapped() {
    const double parts = std::round(kFullTurn / static_cast<double>(now.angle));
    const double degrees = std::floor(parts / 2.0) * kFullTurn / parts;
    const Pose& p = now.pose;
    const bool is_mirrored = 1.0 - 2.0 * (p.qx * p.qx + p.qy * p.qy) < 0.0; // up has Z < 0
    turn_left(is_mirrored ? degrees : -degrees);
}

/// Exchanges left and right by a roll of 180 degrees, also for the second heading.
void Turtle::State::mirror() {
    roll(now.pose, {0.0, 1.0});
    now.second_heading = -now.second_heading;
}

bool Turtle::State::secondary_forward(const Action& action, const float* arguments) {
    const Pose pose = now.pose;
    yaw(now.pose, half_angle(now.second_heading));
    bool is_finite = true;
    if (action.operation == TurtleOperation::SecondaryForward) {
        is_finite = forward(action, arguments, 1.0F);
    } else {
        polygons.begin_step(now.pose);
        advance(now.pose, static_cast<double>(now.step));
        polygons.end_step(now.pose);
        now.moved = true;
        is_finite = check_finite_pose();
    }
    now.pose.qw = pose.qw;
    now.pose.qx = pose.qx;
    now.pose.qy = pose.qy;
    now.pose.qz = pose.qz;
    return is_finite;
}

/// Adds to the index of the colour, modulo kColours; skips 0, the background.
void Turtle::State::add_colour(float number, double sign) {
    double colour = std::fmod(static_cast<double>(now.colour_index) +
                                  sign * std::trunc(static_cast<double>(number)),
                              kColours);
    colour += colour < 0.0 ? kColours : 0.0;
    if (colour == 0.0) {
        colour = sign > 0.0 ? 1.0 : kColours - 1.0;
    }
    set_colour(colour);
}

} // namespace lsys
