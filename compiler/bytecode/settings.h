// SPDX-License-Identifier: MIT
// Attributes of a whole system, set by `#set`: the table settings.def as a struct. Shared by
// Program and Bytecode. Stages after the resolver read these fields, not the text of `#set`.
#pragma once

#include "grammar/base/counted_enum.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

namespace lsys {

/// Rewriting mode of a generation (docs/language.md section 5).
LSYS_COUNTED_ENUM(RewritingMode, Parallel, Sequential, Cyclic, Leftmost);
/// Whether each module draws its production, or all modules of a rule share one draw per
/// generation.
LSYS_COUNTED_ENUM(ChoiceScope, Module, Generation);
/// Source of the draws of `choice generation`: docs/language.md section 6, or rand() of glibc.
LSYS_COUNTED_ENUM(RandomSource, Philox, Glibc);
/// Whether the probabilities of a group without conditions must sum to 1, or are weights with any
/// sum.
LSYS_COUNTED_ENUM(WeightRule, One, Any);
/// Treatment of a module that `#decompose` or `#interpret` still matches at the max depth: the run
/// ends with an error, or the module stays unchanged.
LSYS_COUNTED_ENUM(AtDepth, Error, Stop);
/// Weight that bends a joint: of everything beyond the joint, or only of its own segment.
LSYS_COUNTED_ENUM(LoadRule, Carried, Own);
/// Ends of tubes: a low cone, a half ball, or a jagged break.
LSYS_COUNTED_ENUM(TipShape, Flat, Round, Broken);
/// Unit of the widths of branches: metres, or pixels of a picture of the plant, which
/// runtime/turtle/plant_size.h converts.
LSYS_COUNTED_ENUM(WidthUnit, Metres, Pixels);

/// Shape of the word for contexts. Ring: the last module is the left neighbour of the first one.
LSYS_COUNTED_ENUM(WordShape, Line, Ring);
/// The set of turtle commands by module name (docs/language.md section 7). The resolver reads the
/// profile; later stages may only print its name.
enum class TurtleProfile : std::uint8_t {
#define LSYS_TURTLE_PROFILE(identifier, ...) identifier,
#include "compiler/bytecode/turtle_profiles.def"
};
template <>
struct EnumCount<TurtleProfile> {
    enum Enumerator : std::size_t {
#define LSYS_TURTLE_PROFILE(identifier, ...) identifier,
#include "compiler/bytecode/turtle_profiles.def"
        kCount
    };
};

/// Properties of a profile's turtle other than its commands. The resolver copies them from the row
/// of the profile in turtle_profiles.def.
struct TurtleTraits {
    bool leaf_moves = true;              // a leaf moves the turtle by its length
    bool object_moves = true;            // other objects move the turtle by their length
    bool object_has_step_scale = false;  // an object without a parameter has size step_scale, not 1
    bool forward_has_width = false;      // F(length, width, sections, sides), not spring and mass
    bool width_is_relative = false;      // the width is radius / length of a segment
    bool l3d_compatible_surface = false; // sides, defaults and surfaces of the program L3D
    bool box_segments = false;           // segments are rectangular boxes as wide as their width
    bool corners_are_ends = false;       // corners of polygons: each `.` and the end of each step
    bool organs_branch = false;          // `[` continues an organ; F, ], end of word add no point
    bool colours_wrap = false;           // the colour after 255 is 0
    float taper = 1.0F;                  // initial tip radius / base radius
    float first_turn = 0.0F;             // initial heading, in degrees to the left of +Y
    std::uint16_t first_colour = 0;      // initial colour, an index of the palette
    float leaf_droop = 0.0F;             // default bending of leaves by gravity, 0 to 1
    float organ_tangent = 1.0F;          // initial tangents of organs, relative to the chord

    friend bool operator==(const TurtleTraits&, const TurtleTraits&) = default;
};
[[nodiscard]] const TurtleTraits& traits_of(TurtleProfile profile);

/// Tropism: a direction x, y, z and the susceptibility e (docs/language.md section 7).
using Tropism = std::array<float, 4>;

/// Kinds of tropism in the setting `tropisms`. `After` turns the heading after a step, `Before`
/// turns the heading before a step, `Twist` turns the up axis before a step. `None`: an unused row.
LSYS_COUNTED_ENUM(TropismKind, None, After, Before, Twist);
/// A tropism whose strength the word changes (docs/language.md section 7.9).
struct StepTropism {
    TropismKind kind = TropismKind::None;
    std::array<float, 3> direction{}; // its length is a factor of the strength
    float strength = 0.0F;            // at the start of the word
    float increment = 0.0F;           // change of the strength by commands without a parameter
    float angle = 0.0F;               // Before: degrees from the direction to the wanted heading

    friend bool operator==(const StepTropism&, const StepTropism&) = default;
};
/// The used rows come first.
using StepTropisms = std::array<StepTropism, 11>;
[[nodiscard]] inline bool has_tropisms(const StepTropisms& tropisms) {
    return tropisms.front().kind != TropismKind::None;
}

/// The pipe model: branch widths computed from the tips (docs/language.md section 7.5).
struct Pipe {
    float exponent = 0.0F;  // 1 to kMaxPipeExponent; 0: the turtle sets the widths
    float tip_width = 0.0F; // m, diameter
    float taper = 0.0F;     // 0: one width per segment; 1: the tip is as wide as the next segment

    [[nodiscard]] bool is_set() const { return exponent != 0.0F; }
    friend bool operator==(const Pipe&, const Pipe&) = default;
};
inline constexpr float kMinPipeExponent = 1.0F;
inline constexpr float kMaxPipeExponent = 4.0F;

/// The flare of a stem at the ground, and its buttress roots (docs/language.md section 7.8).
struct Flare {
    float factor = 1.0F;     // radius at the ground / radius without flare, 1 to kMaxFlare
    float height = 0.0F;     // m, above 0: height up to which the trunk flares
    std::uint32_t roots = 0; // kMinRoots to kMaxRoots; 0: none

    friend bool operator==(const Flare&, const Flare&) = default;
};
inline constexpr float kMaxFlare = 10.0F; // max of Flare::factor
inline constexpr std::uint32_t kMinRoots = 3;
inline constexpr std::uint32_t kMaxRoots = 9;

/// The range of `height`, in m.
inline constexpr float kMinHeight = 1e-6F;
inline constexpr float kMaxHeight = 1e6F;

/// Max of `decompose_depth` and `interpret_depth`.
inline constexpr std::uint32_t kMaxDepth = 100'000;
/// The min of LSYS_NUMBER settings that may be any finite number.
inline constexpr float kLowestNumber = std::numeric_limits<float>::lowest();

struct Settings {
#define LSYS_SETTING(type, field, initial, effect, group) type field = initial;
#include "compiler/bytecode/settings.def"
};

/// Whether the derived word depends on a setting.
enum class SettingEffect : std::uint8_t { AffectsWord, NoEffectOnWord };
/// Line of the program dump that shows a setting. None: no line made from settings.def shows it.
LSYS_COUNTED_ENUM(SettingGroup, None, Modes, Random, Drawing, Scales, Physics, Stages);

struct SettingRow {
    std::string_view name; // name of the field; also the key in `#set`, if it has one
    SettingEffect effect;
    SettingGroup group;
};

/// Calls function(row, field) for each field of `settings`, which may be const, in the order of
/// .lsb files.
template <typename Values, typename Function>
constexpr void for_each_setting(Values& settings, Function function) {
#define LSYS_SETTING(type, field, initial, effect, group)                                          \
    function(SettingRow{#field, SettingEffect::effect, SettingGroup::group}, settings.field);
#include "compiler/bytecode/settings.def"
}

[[nodiscard]] std::string_view name_of(RewritingMode mode);
[[nodiscard]] std::string_view name_of(ChoiceScope scope);
[[nodiscard]] std::string_view name_of(RandomSource source);
[[nodiscard]] std::string_view name_of(WeightRule rule);
[[nodiscard]] std::string_view name_of(AtDepth at);
[[nodiscard]] std::string_view name_of(LoadRule load);
[[nodiscard]] std::string_view name_of(TipShape tips);
[[nodiscard]] std::string_view name_of(WidthUnit unit);
[[nodiscard]] std::string_view name_of(WordShape shape);
/// The word for the kind in `#set tropisms`; empty for None.
[[nodiscard]] std::string_view name_of(TropismKind kind);
[[nodiscard]] std::string_view name_of(TurtleProfile profile);

} // namespace lsys
