// SPDX-License-Identifier: MIT
// The environments that `#sense` declares and modules `?NAME` ask (docs/language.md section 13).
// All lengths are in metres, in the plant's own axes, +Y up. A place is the position of the turtle
// at a module that asks.
#pragma once

#include "grammar/base/counted_enum.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

/// The kind of an environment; its comment describes the answer. (x, y, z) is a unit vector, or
/// 0 0 0 for a direction that does not exist.
LSYS_COUNTED_ENUM(EnvironmentKind,
                  Shadow, // (q, x, y, z): exposure and the direction of more light (Palubicki 2009)
                  Sky,    // (q): part of the sky's light that arrives, 0 to 1
                  Space,  // (n, x, y, z): markers of a bud and their mean direction (Runions 2007)
                  Crowd,  // (n, x, y, z): other places within a radius, direction away from them
                  Solid,  // (d, x, y, z): signed distance to a surface and the direction to it
                  Map,    // (v): value of a picture
                  Program // the answer of an external program (Mech & Prusinkiewicz 1996)
);
/// The word of a kind in `#sense`.
[[nodiscard]] constexpr std::string_view name_of(EnvironmentKind kind) {
    constexpr std::array<std::string_view, kCountOf<EnvironmentKind>> kNames{
        "shadow", "sky", "space", "crowd", "solid", "map", "program"};
    return kNames[static_cast<std::size_t>(kind)];
}
/// The shape that holds the markers of an environment of kind Space.
LSYS_COUNTED_ENUM(SpaceShape, Box, Ball, Dome, Cone, Mesh);

/// Result of answer_size() for Program: the external program decides how many numbers it answers.
inline constexpr std::uint32_t kUnknownAnswerSize = 0xFFFFFFFFu;
/// How many numbers an answer of this kind has.
[[nodiscard]] constexpr std::uint32_t answer_size(EnvironmentKind kind) {
    switch (kind) {
    case EnvironmentKind::Sky:
    case EnvironmentKind::Map:
        return 1;
    case EnvironmentKind::Program:
        return kUnknownAnswerSize;
    default:
        return 4;
    }
}

/// A surface of an environment of kind Solid, the mesh that bounds an environment of kind Space, or
/// the picture of one of kind Map.
struct EnvironmentSurface {
    std::string path; // relative to the root file; empty for a plane
    /// Plane: a x + b y + c z + d = 0, solid where the left side is negative.
    std::array<float, 4> plane{};
    /// Index in Bytecode::sites: the name of the file, or the plane.
    std::uint32_t site = 0xFFFFFFFFu;
};

/// An environment with all keys of its statement. Keys that the kind does not have keep their
/// initial values.
struct BytecodeEnvironment {
    std::string name; // name without the `?`
    EnvironmentKind kind = EnvironmentKind::Shadow;
    std::uint32_t site = 0xFFFFFFFFu; // index in Bytecode::sites: the name in the statement
    float cell = 0.5F;                // edge of a voxel; > 0
    std::uint32_t levels = 8;         // layers of voxels that a place shades below its own; to 255
    float strength = 0.2F;            // shadow that a place adds to its own voxel; >= 0
    float ratio = 2.0F;               // shadow of a layer / shadow of the layer below it; > 0
    float extinction = 0.5F;          // extinction coefficient of light per leaf area index; >= 0
    std::uint32_t directions = 46;    // number of directions of the sky; 1 to 4,096
    SpaceShape shape = SpaceShape::Box;
    std::array<float, 3> size{}; // Space: x y z, > 0; Map: x z 0, > 0; unused by SpaceShape::Mesh
    std::array<float, 3> at{};   // Space: middle of the base, x y z; Map: middle, x z 0
    std::uint32_t count = 1;     // number of markers; 1 to 2^26
    float radius = 1.0F;         // max distance at which a place sees markers or places; > 0
    float angle = 90.0F;         // full opening of the cone of view, degrees; above 0, up to 360
    float kill = 0.0F;           // markers nearer than this to a place vanish; >= 0
    float low = 0.0F;            // Map: value of black
    float high = 1.0F;           // Map: value of white
    std::vector<EnvironmentSurface> surfaces; // planes before files; each kind in text order
};

inline constexpr std::uint32_t kMaxEnvironments = 255;
inline constexpr std::uint32_t kMaxShadowLevels = 255;
inline constexpr std::uint32_t kMaxSkyDirections = 4096;
inline constexpr std::uint32_t kMaxMarkers = 1U << 26;

/// The quantity that a sense module reads. Values below kMaxEnvironments are indexes in
/// Bytecode::environments.
enum class Sense : std::uint32_t {
    Position = 256,       // `?P`: place of the turtle
    Heading,              // `?H`
    Up,                   // `?U`
    Right,                // `?R`
    Left,                 // `?L`: minus the right
    Nothing = 0xFFFFFFFFu // not a sense module
};
/// Whether `sense` asks an environment.
[[nodiscard]] constexpr bool asks_environment(Sense sense) {
    return static_cast<std::uint32_t>(sense) < kMaxEnvironments;
}

} // namespace lsys
