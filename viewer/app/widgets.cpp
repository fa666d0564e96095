// SPDX-License-Identifier: MIT
#include "viewer/app/widgets.h"

#include "viewer/app/daylight.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <imgui_internal.h>
#include <numbers>

namespace lsys::view {

float scaled(float pixels) {
    constexpr float kUsualSize = 13.0F; // default text size, pixels
    return pixels * ImGui::GetFontSize() / kUsualSize;
}

float label_width() {
    constexpr float kUsualWidth = 110.0F;
    return scaled(kUsualWidth);
}

void line(const std::string& text) {
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
}

namespace {

/// Whether the user last used the keyboard, so that ImGui draws a ring around a control.
bool uses_keyboard() {
    return ImGui::GetCurrentContext()->NavDisableMouseHover && ImGui::GetIO().NavVisible;
}

} // namespace

void set_tooltip(const std::string& text) {
    if (uses_keyboard()) {
        // Placed beside the window, so that the next controls stay visible.
        ImGui::SetNextWindowPos(
            {ImGui::GetWindowPos().x + ImGui::GetWindowWidth(), ImGui::GetItemRectMin().y});
    }
    constexpr float kCharacters = 45.0F; // in a line
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(kCharacters * ImGui::CalcTextSize("0").x);
    line(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool is_pointed_at() {
    return ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) ||
           (uses_keyboard() && ImGui::IsItemFocused());
}

void draw_tooltip(const char* text) {
    if (is_pointed_at()) {
        set_tooltip(text);
    }
}

namespace {

constexpr const char* kRefused = "refused"; // state of a dialog: it has refused Enter

bool presses_enter() {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false) ||
           ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_KeyPadEnter), false);
}

} // namespace

bool edit_text(const char* label, std::string& text) {
    std::array<char, 1024> bytes{};
    std::snprintf(bytes.data(), bytes.size(), "%s", text.c_str());
    if (ImGui::InputText(label, bytes.data(), bytes.size())) {
        text = bytes.data();
    }
    return ImGui::IsItemDeactivated() && presses_enter();
}

bool begin_dialog(const char* name, bool& is_open) {
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5F * all.x, 0.5F * all.y}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, all);
    return ImGui::Begin(name, &is_open,
                        ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                            ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove);
}

bool is_enter_free() {
    // Without a ring, no control handles Enter.
    return !ImGui::GetIO().NavVisible && !ImGui::IsAnyItemActive() && ImGui::IsWindowFocused() &&
           presses_enter();
}

bool begins_editing() {
    return ImGui::IsWindowAppearing() ||
           ImGui::GetStateStorage()->GetBool(ImGui::GetID(kRefused), false);
}

bool end_dialog(const std::string& button,
                const std::string& problem,
                bool is_entered,
                bool& is_open) {
    ImGui::GetStateStorage()->SetBool(ImGui::GetID(kRefused), is_entered && !problem.empty());
    ImGui::BeginDisabled(!problem.empty());
    const bool is_pressed = ImGui::Button((button + " (Enter)").c_str());
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Cancel (Esc)")) {
        is_open = false;
    }
    return is_pressed || (problem.empty() && (is_entered || is_enter_free()));
}

void draw_problem(const std::string& problem) {
    if (!problem.empty()) {
        const bool is_dark = ImGui::GetStyle().Colors[ImGuiCol_WindowBg].x < 0.5F;
        ImGui::PushStyleColor(ImGuiCol_Text, is_dark ? ImVec4(1.0F, 0.6F, 0.5F, 1.0F)
                                                     : ImVec4(0.7F, 0.1F, 0.0F, 1.0F));
        line(problem);
        ImGui::PopStyleColor();
    }
}

std::string grouped(std::uint64_t number) {
    std::string digits = fmt::format("{}", number);
    for (std::size_t at = digits.size(); at > 3;) {
        at -= 3;
        digits.insert(at, 1, ',');
    }
    return digits;
}

void draw_quality(Quality& quality) {
    int chosen = static_cast<int>(quality);
    if (ImGui::Combo("Quality", &chosen, "Auto\0Low\0Medium\0High\0")) {
        quality = static_cast<Quality>(chosen);
    }
}

/// Edits a wind: its speed, and the direction to which it blows, in degrees from +X towards +Z.
void draw_wind(Wind& wind) {
    constexpr float kDegrees = 180.0F / std::numbers::pi_v<float>;
    float speed = std::hypot(wind.velocity.x, wind.velocity.z);
    float direction = speed > 0.0F ? std::atan2(wind.velocity.z, wind.velocity.x) * kDegrees : 0.0F;
    // Keep a min speed: at speed 0 the velocity would lose its direction.
    constexpr float kMin = 1e-4F;
    bool changed = ImGui::SliderFloat("Wind speed", &speed, 0.0F, 40.0F, "%.1f m/s");
    changed |=
        ImGui::SliderFloat("Wind direction", &direction, -180.0F, 180.0F, "%.0f deg from +X");
    if (changed) {
        speed = std::max(speed, kMin);
        wind.velocity = {speed * std::cos(direction / kDegrees), wind.velocity.y,
                         speed * std::sin(direction / kDegrees)};
    }
    ImGui::SliderFloat("Gusts", &wind.gust, 0.0F, 2.0F, "%.2f");
}

void draw_sun(const SceneLight& scene, SceneLight& light) {
    const SceneLight shown = replaced(scene, light);
    SunPlace sun = shown.sun.value_or(sun_of(Light{}));
    double turbidity = shown.turbidity.value_or(kDefaultTurbidity);
    constexpr double kZero = 0.0;
    constexpr double kTurn = 360.0;
    constexpr double kLowest = -6.0; // civil dusk
    constexpr double kHighest = 90.0;
    bool moved = ImGui::SliderScalar("Sun azimuth", ImGuiDataType_Double, &sun.azimuth, &kZero,
                                     &kTurn, "%.0f deg", ImGuiSliderFlags_AlwaysClamp);
    draw_tooltip("Clockwise from north, which is -Z");
    moved |= ImGui::SliderScalar("Sun elevation", ImGuiDataType_Double, &sun.elevation, &kLowest,
                                 &kHighest, "%.0f deg", ImGuiSliderFlags_AlwaysClamp);
    draw_tooltip("Above the horizon");
    if (moved) {
        light.sun = sun;
    }
    if (ImGui::SliderScalar("Turbidity", ImGuiDataType_Double, &turbidity,
                            &SceneLight::kMinTurbidity, &SceneLight::kMaxTurbidity, "%.1f",
                            ImGuiSliderFlags_AlwaysClamp)) {
        light.turbidity = turbidity;
    }
    draw_tooltip("Haze of the sky: 2 very clear, 6 hazy");
    if (light.sun || light.turbidity) {
        if (ImGui::SmallButton("Reset light")) {
            light = {};
        }
    }
}

void draw_camera(Camera& camera) {
    // A camera has seven floats and an origin of three doubles, whose text fits into `text`.
    static_assert(sizeof(Camera) == 8 * sizeof(float) + 3 * sizeof(double));
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), "%s", to_text(camera).c_str());
    if (ImGui::InputText("##camera", text.data(), text.size(),
                         ImGuiInputTextFlags_EnterReturnsTrue)) {
        if (const Result<Camera> parsed = parse_camera(text.data(), camera)) {
            camera = parsed.value();
        }
    }
    ImGui::SameLine();
    if (ImGui::Button("Copy camera")) {
        ImGui::SetClipboardText(to_text(camera).c_str());
    }
}

} // namespace lsys::view
