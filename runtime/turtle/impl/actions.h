// SPDX-License-Identifier: MIT
// Actions of the turtle: the operation of each code of a word, with all constants computed once.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/turtle/turtle.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace lsys {

/// Max arguments of a module that the turtle reads.
inline constexpr std::uint32_t kTurtleArguments = 4;

/// Action::texture of an object that is drawn with the current texture of the turtle.
inline constexpr std::uint32_t kTurtleTexture = 0xFFFFFFFFu;

/// Cosine and sine of half an angle, for rotations by quaternions.
struct HalfAngle {
    double cosine = 1.0;
    double sine = 0.0;
};
/// Cosine and sine of half of `degrees`; exact for multiples of 180 degrees.
[[nodiscard]] HalfAngle half_angle(double degrees);

/// The command of the turtle for one module code.
struct Action {
    QuickAction quick = QuickAction::None;
    TurtleOperation operation = TurtleOperation::Nothing;
    std::uint8_t argument_count = 0; // at most kTurtleArguments
    bool advances = false;           // an object that moves the turtle by its length
    std::uint32_t stored = 0;        // number of parameters in the word
    std::array<float, kTurtleArguments> arguments{}; // constants, if the word stores none
    HalfAngle turn;                                  // half of a constant angle; signed
    float unit_length = 1.0F;                        // length of an object of size 1
    float default_size = 1.0F;                       // size of an object without a parameter
    std::uint32_t mesh_file = 0;                     // index in Skeleton::mesh_files
    std::uint32_t picture = kNoPicture;              // of a polygon: index in Skeleton::mesh_files
    std::uint32_t contour = kNoContour;              // of SetContour: index in Bytecode::contours
    std::uint32_t texture = kTurtleTexture;          // of a surface file
    char character = '\0';                           // the name, if it is one character
};

/// The commands of all module codes, and the tables to which they refer.
struct ActionTable {
    std::vector<Action> by_code;
    std::vector<std::string> mesh_files;                          // Skeleton::mesh_files
    std::shared_ptr<const std::vector<BytecodeContour>> contours; // null: none
    bool reads_text = false;   // parentheses may hold a parameter as text
    bool draws_organs = false; // some code begins an organ
    std::map<std::uint32_t, std::uint32_t> numbered_contours; // contours named `contour1` ...

    /// The contour that a module with a number sets; kNoContour, a circle, for an unknown number.
    [[nodiscard]] std::uint32_t numbered_contour(float number) const;
};

/// Whether any module of the bytecode has the trait.
[[nodiscard]] bool any_has(const Bytecode& bytecode, TurtleInfo::Trait trait);

/// Precondition: verified bytecode.
[[nodiscard]] ActionTable make_actions(const Bytecode& bytecode, const TurtleOptions& options);

} // namespace lsys
