// SPDX-License-Identifier: MIT
#include "grammar/dialects/houdini/settings.h"

#include "grammar/dialects/houdini/session.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

using enum HoudiniSettingKind;

constexpr std::array<HoudiniSettingRow, 23> kRows{{
    {"generations", Generations, "n"},
    {"iterations", Generations, "n"},
    {"step", Number, "step"},
    {"stepsize", Number, "step"},
    {"stepscale", Number, "step_scale"},
    {"stepsizescale", Number, "step_scale"},
    {"angle", Number, "angle"},
    {"anglescale", Number, "angle_scale"},
    {"thickness", Number, "width"},
    {"thicknessscale", Number, "width_scale"},
    {"columns", Number, "sides"},
    {"b", Value, "b"},
    {"c", Value, "c"},
    {"d", Value, "d"},
    {"variableb", Value, "b"},
    {"variablec", Value, "c"},
    {"variabled", Value, "d"},
    {"valueb", Value, "b"},
    {"valuec", Value, "c"},
    {"valued", Value, "d"},
    {"gravity", Gravity, "gravity"},
    {"randomseed", Seed, "seed"},
    {"contextignore", Ignore, "ignore"},
}};

} // namespace

std::string houdini_key(std::string_view text) {
    std::string key;
    for (const char c : text) {
        if (c >= 'A' && c <= 'Z') {
            key += static_cast<char>(c - 'A' + 'a');
        } else if (c >= 'a' && c <= 'z') {
            key += c;
        }
    }
    return key;
}

const HoudiniSettingRow* find_houdini_setting(std::string_view key) {
    if (key == "seed") {
        key = "randomseed";
    }
    const auto* const found = std::find_if(
        kRows.begin(), kRows.end(), [&](const HoudiniSettingRow& row) { return row.key == key; });
    return found != kRows.end() ? found : nullptr;
}

} // namespace lsys
