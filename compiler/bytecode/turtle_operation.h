// SPDX-License-Identifier: MIT
// The operations of the turtle: turtle_operations.def as an enum and a table. The columns of the
// table are properties of an operation; its effect is a case in runtime/turtle/impl/commands.cpp.
#pragma once

#include "grammar/base/counted_enum.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace lsys {

enum class TurtleOperation : std::uint8_t {
#define LSYS_TURTLE(identifier, name, drawn, quick, traits, count, parameters) identifier,
#include "compiler/bytecode/turtle_operations.def"
};
template <>
struct EnumCount<TurtleOperation> {
    enum Enumerator : std::size_t {
#define LSYS_TURTLE(identifier, name, drawn, quick, traits, count, parameters) identifier,
#include "compiler/bytecode/turtle_operations.def"
        kCount
    };
};
inline constexpr std::uint32_t kTurtleOperationCount = kCountOf<TurtleOperation>;

/// Drawable element that a module with the operation adds to the skeleton.
enum class DrawnKind : std::uint8_t { Nothing, Segment, Object, Polygon };

/// Frequent actions that the turtle's loop over a word runs inline, without calling execute(). Yaw,
/// Pitch and Roll turn by an angle and are inline if the angle is constant. NoEffect: the module is
/// skipped. None: execute() is called.
enum class QuickAction : std::uint8_t { None, NoEffect, Yaw, Pitch, Roll, Forward, Save, Restore };

struct TurtleInfo {
    enum Trait : std::uint16_t {
        Inverse = 1,           // turns opposite to yaw(), pitch() and roll() of the turtle's pose.h
        ChangesAngle = 2,      // changes the angle that turns without a parameter have
        SecondHeading = 4,     // moves along Fractint's second heading, which has its own turns
        DependsOnVertical = 8, // draws differently when the branch is turned
        DependsOnPlace = 16,   // draws differently when the branch is moved
        AddsCorners = 32,      // a move whose ends are corners of a polygon without `.`
        PreparesDrawing = 64,  // has an effect only together with modules that draw
        OneIsDefault = 128,    // the program L3D treats a parameter of 1 as omitted
        HasNoLength = 256,     // an object that does not move the turtle
    };

    std::string_view name; // name in dumps
    DrawnKind drawn = DrawnKind::Nothing;
    QuickAction quick = QuickAction::None;
    std::uint16_t traits = 0;
    std::uint8_t parameter_count = 0; // max
    std::string_view parameters;      // meanings: "length, spring constant, mass"

    [[nodiscard]] constexpr bool has(Trait trait) const { return (traits & trait) != 0; }

    static const std::array<TurtleInfo, kTurtleOperationCount> kRows;
};

inline constexpr std::array<TurtleInfo, kTurtleOperationCount> TurtleInfo::kRows{{
#define LSYS_TURTLE(identifier, name, drawn, quick, traits, count, parameters)                     \
    {name, DrawnKind::drawn, QuickAction::quick, traits, count, parameters},
#include "compiler/bytecode/turtle_operations.def"
}};

/// Precondition: `operation` is an enumerator.
[[nodiscard]] constexpr const TurtleInfo& info(TurtleOperation operation) {
    return TurtleInfo::kRows[static_cast<std::size_t>(operation)];
}
[[nodiscard]] constexpr std::string_view name_of(TurtleOperation operation) {
    return info(operation).name;
}
/// Whether the operation adds an element to the skeleton.
[[nodiscard]] constexpr bool draws(TurtleOperation operation) {
    return info(operation).drawn != DrawnKind::Nothing;
}
/// Whether the operation turns the turtle by its parameter.
[[nodiscard]] constexpr bool turns(TurtleOperation operation) {
    const QuickAction quick = info(operation).quick;
    return quick == QuickAction::Yaw || quick == QuickAction::Pitch || quick == QuickAction::Roll;
}

} // namespace lsys
