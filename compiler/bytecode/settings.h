// What `#set` decides, resolved: the attributes of a whole system. Shared by Program and Bytecode;
// after the front end no character and no keyword carries a meaning of its own.
#pragma once

#include "grammar/base/counted_enum.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace lsys {

/// How a generation rewrites the word (docs/language.md section 5).
LSYS_COUNTED_ENUM(RewritingMode, Parallel, Sequential, Cyclic, Leftmost);
/// Whether each module draws its production, or all modules of a rule share one draw a generation.
LSYS_COUNTED_ENUM(ChoiceScope, Module, Generation);
/// Where the draws of `choice generation` come from: section 6, or the rand() of glibc.
LSYS_COUNTED_ENUM(RandomSource, Philox, Glibc);
/// Whether unconditional groups must sum to 1.
LSYS_COUNTED_ENUM(WeightRule, One, Any);
/// What becomes of a module that `#decompose` or `#interpret` still matches at the greatest depth:
/// it ends the run, or it stays what it is.
LSYS_COUNTED_ENUM(AtDepth, Error, Stop);
/// Which table of section 7 gives modules their meaning for the turtle.
/// L3dProgram and LplusProgram are L3d and Lplus as the program L3D has them.
LSYS_COUNTED_ENUM(TurtleProfile,
                  Lsys,
                  Thesis,
                  Abop,
                  Houdini,
                  L3d,
                  Lplus,
                  Sys,
                  Carey,
                  L3dProgram,
                  LplusProgram,
                  Fractint,
                  Sidefx);

[[nodiscard]] constexpr bool is_of_program(TurtleProfile profile) {
    return profile == TurtleProfile::L3dProgram || profile == TurtleProfile::LplusProgram;
}

struct Settings {
    TurtleProfile turtle = TurtleProfile::Lsys;
    RewritingMode rewriting = RewritingMode::Parallel;
    ChoiceScope choice = ChoiceScope::Module;
    WeightRule weights = WeightRule::One;
    RandomSource random = RandomSource::Philox;
    /// `names letters` or `names characters` in the root file: how a word is printed.
    bool print_letters = false;
    bool print_characters = false;
    float angle = 90.0F;      // degrees
    float step = 1.0F;        // metres
    float width = 0.1F;       // metres, diameter
    float angle_scale = 0.9F; // factors
    float step_scale = 0.9F;
    float width_scale = 0.7F;
    std::uint32_t sides = 8;
    bool has_tropism = false;
    std::array<float, 4> tropism{}; // x y z e
    bool has_seed = false;
    std::uint64_t seed = 0;
    AtDepth at_depth = AtDepth::Error;
    std::uint32_t decompose_depth = 100; // passes after a generation
    std::uint32_t interpret_depth = 100; // passes before a word is drawn
    float spring = 30.0F;                // N m / rad
    float density = 500.0F;              // kg / m^3
    float damping = 1.0F;                // N m s / rad
};

[[nodiscard]] std::string_view name_of(RewritingMode mode);
[[nodiscard]] std::string_view name_of(ChoiceScope scope);
[[nodiscard]] std::string_view name_of(RandomSource source);
/// The largest of both depths.
inline constexpr std::uint32_t kMaxDepth = 100'000;

[[nodiscard]] std::string_view name_of(WeightRule rule);
[[nodiscard]] std::string_view name_of(AtDepth at);
[[nodiscard]] std::string_view name_of(TurtleProfile profile);

} // namespace lsys
