// Actions of the turtle: what each code of a word does, with all constants worked out once.
#pragma once

#include "compiler/bytecode/bytecode.h"
#include "runtime/turtle/turtle.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace lsys {

/// Arguments of a module that the turtle reads.
inline constexpr std::uint32_t kTurtleArguments = 4;

/// Cosine and sine of half an angle, for rotations by quaternions.
struct HalfAngle {
    double cosine = 1.0;
    double sine = 0.0;
};
[[nodiscard]] HalfAngle half_angle(double degrees);

struct Action {
    QuickAction quick = QuickAction::None;
    TurtleOperation operation = TurtleOperation::Nothing;
    std::uint8_t given = 0;                          // arguments, kTurtleArguments at most
    bool advances = false;                           // objects: by their length
    std::uint32_t stored = 0;                        // parameters in the word, all of them
    std::array<float, kTurtleArguments> arguments{}; // if none is stored
    HalfAngle turn;                                  // rotations by a constant angle, signed
    float unit_length = 1.0F;                        // objects
    float default_size = 1.0F;                       // objects without a parameter
    std::uint32_t mesh_file = 0;                     // in Skeleton::mesh_files
    std::uint32_t picture = kNoPicture;              // of polygons, in Skeleton::mesh_files
    char character = '\0';                           // the name, where it is one character
};

struct ActionTable {
    std::vector<Action> by_code;
    std::vector<std::string> mesh_files;
    bool reads_text = false; // parentheses may hold a parameter as text
};

/// Whether any module of the bytecode has the trait.
[[nodiscard]] bool any_has(const Bytecode& bytecode, TurtleInfo::Trait trait);

/// Precondition: verified bytecode.
[[nodiscard]] ActionTable make_actions(const Bytecode& bytecode, const TurtleOptions& options);

} // namespace lsys
