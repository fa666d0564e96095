// SPDX-License-Identifier: MIT
// The parameters of Houdini's node that a rule text may give, a line `key: value` each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lsys {

enum class HoudiniSettingKind : std::uint8_t {
    Generations, // perhaps a fraction
    Number,      // a `#set`
    Value,       // b, c or d
    Gravity,     // the default parameter of the command T
    Seed,
    Ignore, // symbols that contexts skip
    Switch, // on, off, 1 or 0
    Scale,  // range of the random factor of lengths, angles and widths
    Unused, // has no effect here
};

struct HoudiniSettingRow {
    std::string_view key; // key as houdini_key() returns it
    HoudiniSettingKind kind{};
    std::string_view name; // name of the setting in .lsys
};

/// The row of a key; null if there is none. Several keys may name one setting.
[[nodiscard]] const HoudiniSettingRow* find_houdini_setting(std::string_view key);

} // namespace lsys
