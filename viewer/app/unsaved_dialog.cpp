// SPDX-License-Identifier: MIT
#include "viewer/app/unsaved_dialog.h"

#include "grammar/base/paths.h"
#include "viewer/app/widgets.h"

#include <fmt/format.h>

#include <imgui.h>

namespace lsys::view {

std::optional<UnsavedAnswer> draw_unsaved_dialog(ViewSwitcher& switcher, const PanelState& panels) {
    std::optional<UnsavedAnswer> answer;
    const View& view = switcher.current();
    const std::string& next = switcher.leaving()->file;
    bool is_open = true;
    if (begin_dialog("Unsaved changes", is_open)) {
        line(fmt::format("{} of {} are not saved.", view.is_forest() ? "Changes" : "Values",
                         name_of_path(view.path())));
        line(next.empty() ? "The window is about to close."
                          : fmt::format("{} is about to be opened.", name_of_path(next)));
        draw_problem(panels.save_failure);
        if (ImGui::Button("Save back (Enter)") || is_enter_free()) {
            answer = UnsavedAnswer::Save;
        }
        ImGui::SetItemDefaultFocus();
        draw_tooltip("Writes them to the file (Ctrl+S)");
        ImGui::SameLine();
        if (ImGui::Button("Discard")) {
            answer = UnsavedAnswer::Discard;
        }
        draw_tooltip("Goes on without them");
        ImGui::SameLine();
        if (ImGui::Button("Cancel (Esc)")) {
            answer = UnsavedAnswer::Cancel;
        }
    }
    ImGui::End();
    return is_open ? answer : UnsavedAnswer::Cancel;
}

} // namespace lsys::view
