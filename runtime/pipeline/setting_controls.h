// SPDX-License-Identifier: MIT
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
    std::string_view key; // key in `#set`
    SettingKind kind = SettingKind::Number;
    std::array<float, 4> numbers{};      // the value; kinds other than Vector use only the first
    std::string_view accepts;            // "an angle in degrees"; empty for Word
    std::string_view word;               // the value of Word
    std::vector<std::string_view> words; // all values of Word
    float lowest = 0.0F;                 // min valid value of Number, Count and Vector
    float highest = 0.0F;                // max valid value of Number, Count and Vector
    /// Range of a slider: usual values, possibly narrower than the valid range. No range if `max`
    /// is not above `min`.
    float min = 0.0F;
    float max = 0.0F;
};

/// The settings of a grammar that --set may replace, except `seed`. For a .lsb file: settings that
/// are not is_compiled_in(). For a grammar in another dialect: all except `names`.
[[nodiscard]] std::vector<SettingControl> setting_controls(const Grammar& grammar);

/// Numbers as text for a `#set`: `0.5 -1 0 0.2`. Parsing the text gives the same numbers.
[[nodiscard]] std::string setting_text(std::span<const float> numbers);
/// The numbers in `values`; nothing if the text is not exactly `count` numbers, for example because
/// it has the name of a constant.
[[nodiscard]] std::optional<std::array<float, 4>> numbers_of(std::string_view values,
                                                             std::size_t count);

} // namespace lsys
