// SPDX-License-Identifier: MIT
// The operations of a SensingTurtle that move or turn the turtle, or place organs. Their effects
// equal those of the operations in commands.cpp and dialects.cpp.
#include "grammar/base/contract.h"
#include "runtime/base/out_of_memory.h"
#include "runtime/derive/brackets.h"
#include "runtime/turtle/impl/sensing_state.h"

#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr ExactSineCosine kHalfTurn{0.0, -1.0};
constexpr double kFullTurn = 360.0;
constexpr double kPercent = 0.01;

ExactSineCosine turn_of(double degrees) {
    return exact_sine_cosine_of_degrees(degrees);
}

SensingVector at_distance(const SensingPose& pose, double length) {
    SensingPose ahead = pose;
    advance(ahead, length);
    return ahead.position;
}

} // namespace

void SensingTurtle::State::move(double length, bool adds_corners) {
    if (adds_corners) {
        polygons.begin_step(now.pose.position);
    }
    if (tropisms.any()) {
        tropisms.before_step(now.pose);
    }
    advance(now.pose, length);
    if (tropisms.any()) {
        tropisms.after_step(now.pose, false);
    }
    if (adds_corners) {
        polygons.end_step(now.pose.position);
    }
}

/// Moves along a segment, which first bends by tropism.
void SensingTurtle::State::forward(double length, bool adds_corners) {
    if (adds_corners) {
        polygons.begin_step(now.pose.position);
    }
    if (bytecode.settings.has_tropism) {
        const Tropism& tropism = bytecode.settings.tropism;
        const auto wide = [&](std::size_t i) { return static_cast<double>(tropism[i]); };
        bend(now.pose, {wide(0), wide(1), wide(2)}, wide(3));
    }
    if (tropisms.any()) {
        tropisms.before_step(now.pose);
    }
    advance(now.pose, length);
    if (tropisms.any()) {
        tropisms.after_step(now.pose, true);
    }
    if (adds_corners) {
        polygons.end_step(now.pose.position);
    }
}

/// Moves along the second heading; the frame stays unchanged.
void SensingTurtle::State::move_secondary(const Action& action,
                                          std::uint8_t argument_count,
                                          const float* arguments) {
    const SensingPose before = now.pose;
    yaw_right(now.pose, inverse(turn_of(now.second_heading)));
    if (action.operation == TurtleOperation::SecondaryForward) {
        forward(argument_count > 0 ? static_cast<double>(arguments[0]) : now.step, true);
    } else {
        move(now.step, true);
    }
    const SensingVector place = now.pose.position;
    now.pose = before;
    now.pose.position = place;
}

/// Pitches, rolls and yaws by the arguments, in degrees; missing arguments are 0.
void SensingTurtle::State::turn_by(std::uint8_t argument_count, const float* arguments) {
    const auto angle = [&](std::uint8_t index) {
        return turn_of(argument_count > index ? static_cast<double>(arguments[index]) : 0.0);
    };
    pitch_up(now.pose, angle(0));
    roll_left(now.pose, inverse(angle(1)));
    yaw_right(now.pose, inverse(angle(2)));
}

void SensingTurtle::State::turn_left(double degrees) {
    yaw_right(now.pose, inverse(turn_of(degrees)));
    now.second_heading = std::remainder(now.second_heading - degrees, kFullTurn);
}

void SensingTurtle::State::half_turn_snapped() {
    const double parts = std::round(kFullTurn / now.angle);
    const double degrees = std::floor(parts / 2.0) * kFullTurn / parts;
    turn_left(now.pose.up[2] < 0.0 ? degrees : -degrees); // mirrored if up has Z < 0
}

void SensingTurtle::State::set_angle(double angle) {
    now.angle = angle;
    now.turn = turn_of(angle);
}

void SensingTurtle::State::place(const Action& action,
                                 std::uint8_t argument_count,
                                 const float* arguments) {
    const float size = argument_count > 0 ? arguments[0] : action.default_size;
    const double wide = static_cast<double>(size);
    const double length = wide * static_cast<double>(action.unit_length);
    if (options.organs) {
        sink->organ(at_distance(now.pose, length / 2.0), areas[code] * (wide * wide));
    }
    if (action.advances) {
        advance(now.pose, length);
    }
}

bool SensingTurtle::State::save() {
    if (stack.size() == stack.capacity() &&
        stack.size() * 2 * sizeof(SensingBrush) > options.max_bytes) {
        return stop(Stop::Limit);
    }
    return catch_out_of_memory(
        [&] {
            stack.push_back(now);
            if (tropisms.any()) {
                tropisms.save();
            }
            return true;
        },
        [&] { return stop(Stop::OutOfMemory); });
}

bool SensingTurtle::State::stop_unbalanced() {
    error = unmatched_bracket(bytecode, code, position, age);
    return stop(Stop::Diagnosed);
}

bool SensingTurtle::State::restore() {
    if (stack.empty()) {
        return stop_unbalanced();
    }
    now = stack.back();
    stack.pop_back();
    if (tropisms.any()) {
        tropisms.restore();
    }
    return true;
}

bool SensingTurtle::State::close_polygon() {
    if (!polygons.any()) {
        return stop_unbalanced();
    }
    const std::span<const SensingVector> corners = polygons.corners();
    if (options.organs && corners.size() >= 3) {
        sink->organ(mean_of(corners), area_of(corners));
    }
    polygons.close();
    return true;
}

bool SensingTurtle::State::execute(const Action& action,
                                   std::uint8_t argument_count,
                                   const float* arguments) {
    const Settings& settings = bytecode.settings;
    const auto turn = [&] {
        return argument_count == 0 ? now.turn : turn_of(static_cast<double>(arguments[0]));
    };
    const auto argument = [&](double otherwise) {
        return argument_count != 0 ? static_cast<double>(arguments[0]) : otherwise;
    };
    const auto set_width = [&](double width) { now.width = width < 0.0 ? 0.0 : width; };
    const auto width_scale = static_cast<double>(settings.width_scale);
    const auto step_scale = static_cast<double>(settings.step_scale);
    const auto angle_scale = static_cast<double>(settings.angle_scale);
    const auto usual_angle = static_cast<double>(settings.angle);
    switch (action.operation) {
    case TurtleOperation::Forward:
    case TurtleOperation::Branch:
    case TurtleOperation::TaperedForward:
        forward(argument(now.step), true);
        return true;
    case TurtleOperation::ForwardWithoutVertex:
        forward(argument(now.step), false);
        return true;
    case TurtleOperation::HalfForward:
        forward(argument(now.step) * 0.5, true);
        return true;
    case TurtleOperation::Move:
        move(argument(now.step), true);
        return true;
    case TurtleOperation::HalfMove:
        move(argument(now.step) * 0.5, true);
        return true;
    case TurtleOperation::MoveWithoutVertex:
        move(argument(now.step), false);
        return true;
    case TurtleOperation::Bend:
        bend(now.pose, {0.0, -1.0, 0.0}, argument(0.0));
        return true;
    case TurtleOperation::TurnBy:
        turn_by(argument_count, arguments);
        return true;
    case TurtleOperation::PointAt:
        if (argument_count == 3) {
            aim(now.pose, {static_cast<double>(arguments[0]), static_cast<double>(arguments[1]),
                           static_cast<double>(arguments[2])});
        }
        return true;
    case TurtleOperation::YawRight:
        yaw_right(now.pose, turn());
        now.second_heading += has_second_heading ? now.angle : 0.0;
        return true;
    case TurtleOperation::YawLeft:
        yaw_right(now.pose, inverse(turn()));
        now.second_heading -= has_second_heading ? now.angle : 0.0;
        return true;
    case TurtleOperation::PitchDown:
        pitch_up(now.pose, inverse(turn()));
        return true;
    case TurtleOperation::PitchUp:
        pitch_up(now.pose, turn());
        return true;
    case TurtleOperation::RollRight:
        roll_left(now.pose, inverse(turn()));
        return true;
    case TurtleOperation::RollLeft:
        roll_left(now.pose, turn());
        return true;
    case TurtleOperation::TurnAround:
        yaw_right(now.pose, kHalfTurn);
        return true;
    case TurtleOperation::TurnByPi:
        yaw_right(now.pose, turn_of(std::numbers::pi));
        return true;
    case TurtleOperation::RollAround:
        roll_left(now.pose, kHalfTurn);
        return true;
    case TurtleOperation::HalfTurnSnapped:
        half_turn_snapped();
        return true;
    case TurtleOperation::Mirror:
        roll_left(now.pose, kHalfTurn);
        now.second_heading = -now.second_heading;
        return true;
    case TurtleOperation::SecondaryForward:
    case TurtleOperation::SecondaryMove:
        move_secondary(action, argument_count, arguments);
        return true;
    case TurtleOperation::SecondaryLeft:
        now.second_heading += argument(0.0);
        return true;
    case TurtleOperation::SecondaryRight:
        now.second_heading -= argument(0.0);
        return true;
    case TurtleOperation::RollUpright:
        roll_upright(now.pose);
        return true;
    case TurtleOperation::SetWidth:
        set_width(argument(now.width * width_scale));
        return true;
    case TurtleOperation::NarrowWidth:
        set_width(argument(now.width - static_cast<double>(settings.width_increment)));
        return true;
    case TurtleOperation::WidenWidth:
        set_width(argument(now.width + static_cast<double>(settings.width_increment)));
        return true;
    case TurtleOperation::ScaleWidth:
        set_width(now.width * argument(width_scale));
        return true;
    case TurtleOperation::DivideWidth:
        set_width(now.width / argument(width_scale));
        return true;
    case TurtleOperation::ThickenWidth:
        set_width(now.width * (1.0 + argument(usual_angle) * kPercent));
        return true;
    case TurtleOperation::ThinWidth:
        set_width(now.width * (1.0 - argument(usual_angle) * kPercent));
        return true;
    case TurtleOperation::SetRelativeWidth:
        set_width(argument(1.0) * kPercent);
        return true;
    case TurtleOperation::ScaleStep:
        now.step *= argument(step_scale);
        return true;
    case TurtleOperation::DivideStep:
        now.step /= argument(step_scale);
        return true;
    case TurtleOperation::ScaleAngle:
        set_angle(now.angle * argument(angle_scale));
        return true;
    case TurtleOperation::DivideAngle:
        set_angle(now.angle * (1.0 / argument(angle_scale)));
        return true;
    case TurtleOperation::Save:
    case TurtleOperation::SaveBranch:
        return save();
    case TurtleOperation::Restore:
        return restore();
    case TurtleOperation::PolygonBegin:
        return catch_out_of_memory(
            [&] {
                polygons.open();
                return true;
            },
            [&] { return stop(Stop::OutOfMemory); });
    case TurtleOperation::PolygonVertex:
        polygons.vertex(now.pose.position);
        return true;
    case TurtleOperation::PolygonEnd:
        return close_polygon();
    case TurtleOperation::Leaf:
    case TurtleOperation::Sphere:
    case TurtleOperation::Heterocyst:
    case TurtleOperation::Flower:
    case TurtleOperation::Cylinder:
    case TurtleOperation::Cone:
    case TurtleOperation::Cube:
    case TurtleOperation::Disk:
    case TurtleOperation::MeshFile:
        place(action, argument_count, arguments);
        return true;
    case TurtleOperation::SetSusceptibility:
    case TurtleOperation::SetTropism:
    case TurtleOperation::AddTropism:
    case TurtleOperation::SubtractTropism:
    case TurtleOperation::Untwist:
    case TurtleOperation::KeepTwist:
        tropisms.execute(action.operation, argument_count, arguments, now.pose);
        return true;
    case TurtleOperation::CentredSphere:
    case TurtleOperation::LevelDisk:
        if (options.organs) {
            const double diameter = argument(now.width);
            sink->organ(now.pose.position, areas[code] * (diameter * diameter));
        }
        return true;
    case TurtleOperation::Nothing:
    case TurtleOperation::ParameterBegin:
    case TurtleOperation::ParameterEnd:
    case TurtleOperation::Text:
    case TurtleOperation::SetTaper:
    case TurtleOperation::SetColour:
    case TurtleOperation::AddColour:
    case TurtleOperation::SubtractColour:
    case TurtleOperation::PreviousColour:
    case TurtleOperation::SetRgb:
    case TurtleOperation::SetTexture:
    case TurtleOperation::SurfaceBegin: // organs have no area for environments
    case TurtleOperation::SurfacePoint:
    case TurtleOperation::SurfaceEnd:
    case TurtleOperation::SurfaceTangents:
    case TurtleOperation::SurfaceRadii:
    case TurtleOperation::SetContour:
    case TurtleOperation::Cut: // the modules that it will cut off are walked, too
        return true;
    }
    LSYS_CHECK(false, static_cast<int>(action.operation));
    return true;
}

} // namespace lsys
