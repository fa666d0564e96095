// SPDX-License-Identifier: MIT
#include "viewer/app/sense_widgets.h"

#include "viewer/app/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <imgui.h>

namespace lsys::view {

namespace {

void draw_toggle(const char* name, const char* text, const char* key, bool& shown) {
    ImGui::Checkbox(name, &shown);
    draw_tooltip((std::string(text) + key).c_str());
}

} // namespace

void draw_sense_look(bool has_keys, SenseLook& look) {
    const auto key = [has_keys](const char* text) { return has_keys ? text : ""; };
    draw_toggle("Obstacles", "Meshes and planes of kind solid", key(" (O)"), look.obstacles);
    ImGui::SameLine();
    draw_toggle("Light", "Kinds shadow and sky: dark blue without light, yellow in full light",
                key(" (Y)"), look.light);
    draw_toggle("Markers", "Kind space: markers that are left", key(" (X)"), look.markers);
    ImGui::SameLine();
    draw_toggle("Directions",
                "The direction in the answer to each module: kinds shadow, space, crowd, solid",
                key(" (D)"), look.directions);
}

void draw_environment_move(const std::string& name,
                           EnvironmentKind kind,
                           std::vector<EnvironmentMove>& moves) {
    if (kind != EnvironmentKind::Solid && kind != EnvironmentKind::Space &&
        kind != EnvironmentKind::Map) {
        return;
    }
    std::array<float, 3> by = move_of(moves, name);
    ImGui::PushID(name.c_str());
    const bool changed = ImGui::DragFloat3("##move", by.data(), 0.02F, 0.0F, 0.0F, "%.3g");
    const bool is_pointed = is_pointed_at();
    ImGui::SameLine();
    line(name);
    if (is_pointed || is_pointed_at()) {
        set_tooltip("Moved by x, y, z in m, in this window only; Shift+drag moves an obstacle");
    }
    ImGui::PopID();
    if (changed && std::all_of(by.begin(), by.end(), [](float x) { return std::isfinite(x); })) {
        set_move(name, by, moves);
    }
}

} // namespace lsys::view
