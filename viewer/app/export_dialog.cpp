// SPDX-License-Identifier: MIT
#include "viewer/app/export_dialog.h"

#include "grammar/base/paths.h"
#include "viewer/app/output_path.h"
#include "viewer/app/widgets.h"

#include <filesystem>
#include <imgui.h>

namespace lsys::view {

namespace {

void draw_presets(std::string& preset) {
    constexpr const char* kAny = "any program";
    if (ImGui::BeginCombo("For", preset.empty() ? kAny : preset.c_str())) {
        if (ImGui::Selectable(kAny, preset.empty())) {
            preset.clear();
        }
        for (const std::string& each : export_presets()) {
            if (ImGui::Selectable(each.c_str(), each == preset)) {
                preset = each;
            }
        }
        ImGui::EndCombo();
    }
    draw_tooltip("A preset for the program that reads the file");
}

} // namespace

bool draw_export_dialog(ExportSettings& output, bool& is_open) {
    bool is_wanted = false;
    if (begin_dialog("Export the plant", is_open)) {
        if (begins_editing()) {
            ImGui::SetKeyboardFocusHere();
        }
        const bool is_entered = edit_text("File", output.file);
        draw_tooltip("The extension chooses the format: .glb, .gltf, .obj, .usda, .usdz, .ply, "
                     ".stl, .off, .svg");
        const std::string problem = problem_of_export(output.file);
        draw_problem(problem);
        draw_presets(output.preset);
        auto lods = static_cast<int>(output.lods);
        if (ImGui::SliderInt("Levels", &lods, 0, 12, "%d", ImGuiSliderFlags_AlwaysClamp)) {
            output.lods = static_cast<std::uint32_t>(lods);
        }
        draw_tooltip(
            "Levels of detail in the file; 0: only the plant shown, or what the preset writes");
        std::error_code ignored;
        const bool exists = std::filesystem::exists(path_of(output.file), ignored);
        is_wanted = end_dialog(exists ? "Replace" : "Write", problem, is_entered, is_open);
    }
    ImGui::End();
    return is_wanted;
}

} // namespace lsys::view
