// SPDX-License-Identifier: MIT
#include "grammar/dialects/houdini/settings.h"

#include "grammar/dialects/houdini/session.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

using enum HoudiniSettingKind;

constexpr std::array kRows{
    HoudiniSettingRow{"generations", Generations, "n"},
    HoudiniSettingRow{"iterations", Generations, "n"},
    HoudiniSettingRow{"step", Number, "step"},
    HoudiniSettingRow{"stepsize", Number, "step"},
    HoudiniSettingRow{"stepscale", Number, "step_scale"},
    HoudiniSettingRow{"stepsizescale", Number, "step_scale"},
    HoudiniSettingRow{"angle", Number, "angle"},
    HoudiniSettingRow{"anglescale", Number, "angle_scale"},
    HoudiniSettingRow{"thickness", Number, "width"},
    HoudiniSettingRow{"thicknessscale", Number, "width_scale"},
    HoudiniSettingRow{"columns", Number, "sides"},
    HoudiniSettingRow{"b", Value, "b"},
    HoudiniSettingRow{"c", Value, "c"},
    HoudiniSettingRow{"d", Value, "d"},
    HoudiniSettingRow{"variableb", Value, "b"},
    HoudiniSettingRow{"variablec", Value, "c"},
    HoudiniSettingRow{"variabled", Value, "d"},
    HoudiniSettingRow{"valueb", Value, "b"},
    HoudiniSettingRow{"valuec", Value, "c"},
    HoudiniSettingRow{"valued", Value, "d"},
    HoudiniSettingRow{"gravity", Gravity, "gravity"},
    HoudiniSettingRow{"randomseed", Seed, "seed"},
    HoudiniSettingRow{"contextignore", Ignore, "ignore"},
    HoudiniSettingRow{"randomscale", Scale, "random_scale"},
    HoudiniSettingRow{"randscale", Scale, "random_scale"},
    HoudiniSettingRow{"continuousangles", Switch, "continuous_angles"},
    HoudiniSettingRow{"continuouslength", Switch, "continuous_length"},
    HoudiniSettingRow{"continuouswidth", Switch, "continuous_width"},
    // The other parameters of the node.
    HoudiniSettingRow{"type", Unused, "type"},
    HoudiniSettingRow{"startposition", Unused, "start position"},
    HoudiniSettingRow{"applycolor", Unused, "apply color"},
    HoudiniSettingRow{"imagefile", Unused, "image file"},
    HoudiniSettingRow{"uvincrement", Unused, "uv increment"},
    HoudiniSettingRow{"pointattributes", Unused, "point attributes"},
    HoudiniSettingRow{"rows", Unused, "rows"},
    HoudiniSettingRow{"tension", Unused, "tension"},
    HoudiniSettingRow{"branchblend", Unused, "branch blend"},
    HoudiniSettingRow{"applytubetexturecoordinates", Unused, "tube texture"},
    HoudiniSettingRow{"verticalincrement", Unused, "vertical increment"},
    HoudiniSettingRow{"picimagefile", Unused, "pic image file"},
    HoudiniSettingRow{"groupprefix", Unused, "group prefix"},
    HoudiniSettingRow{"leafparama", Unused, "leaf param a"},
    HoudiniSettingRow{"leafparamb", Unused, "leaf param b"},
    HoudiniSettingRow{"leafparamc", Unused, "leaf param c"},
    HoudiniSettingRow{"rulefile", Unused, "rule file"},
};

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
