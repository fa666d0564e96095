// SettingControl: a setting of a grammar with its value and its range, for widgets.
#pragma once

#include "runtime/pipeline/grammar.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class SettingKind : std::uint8_t {
    Number,
    Count,  // a whole number
    Vector, // tropism: four numbers: x, y, z, susceptibility
    Word,
};

struct SettingControl {
    std::string_view key; // of `#set`
    SettingKind kind = SettingKind::Number;
    std::array<float, 4> numbers{};      // the value; only the first, except for Vector
    std::string_view word;               // the value of Word
    std::vector<std::string_view> words; // all values of Word
    float lowest = 0.0F;                 // min value of Number and Count; less is an error
    float highest = 0.0F;                // max value of Number and Count; more is an error
    /// Range of a slider: usual values, may be narrower than the legal ones. None if `max` is not
    /// above `min`.
    float min = 0.0F;
    float max = 0.0F;
};

/// The settings of a grammar that options may replace, except `seed`. A .lsb file lacks the
/// settings that are compiled in (is_compiled_in()); other dialects lack `names`.
[[nodiscard]] std::vector<SettingControl> setting_controls(const Grammar& grammar);

/// Numbers as the values of a `#set`: `0.5 -1 0 0.2`. Reading the text gives the same numbers.
[[nodiscard]] std::string setting_text(std::span<const float> numbers);
/// The numbers of `values` if it is exactly `count` numbers; else none, as for names of constants.
[[nodiscard]] std::optional<std::array<float, 4>> numbers_of(std::string_view values,
                                                             std::size_t count);

} // namespace lsys
