// SPDX-License-Identifier: MIT
#include "viewer/app/panel_focus.h"

#include <array>
#include <cstddef>
#include <imgui.h>
#include <imgui_internal.h>

namespace lsys::view {

namespace {

/// Windows that can have the keyboard while no dialog is open, in the order of the key F6.
constexpr std::array<const char*, 6> kPanels = {"Panel",    "Buttons", "Trace",
                                                "Messages", "Making",  "Keys"};

/// The outermost window that has the keyboard; null: the picture has it.
ImGuiWindow* focused_panel() {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    return context.NavWindow == nullptr || context.NavDisableHighlight
               ? nullptr
               : context.NavWindow->RootWindow;
}

/// Whether the window was drawn in the last frame.
bool is_shown(const ImGuiWindow* window) {
    return window != nullptr && window->WasActive;
}

/// Gives the keyboard to a window, where it goes to the control that had it last; null: to the
/// picture.
void focus(ImGuiWindow* window) {
    ImGuiContext& context = *ImGui::GetCurrentContext();
    if (window == nullptr) {
        ImGui::FocusWindow(nullptr);
        context.NavDisableHighlight = true;
        return;
    }
    ImGuiWindow* const inner = window->NavLastChildNavWindow;
    ImGuiWindow* const last = is_shown(inner) ? inner : window;
    ImGui::FocusWindow(last);
    if (last->NavLastIds[0] == 0) {
        ImGui::NavInitWindow(last, false);
    }
    context.NavDisableHighlight = false;
    context.NavDisableMouseHover = true; // until the mouse moves
}

ImGuiWindow* next_panel() {
    const ImGuiWindow* const now = focused_panel();
    std::size_t next = 0;
    for (std::size_t i = 0; i < kPanels.size(); ++i) {
        if (now != nullptr && ImGui::FindWindowByName(kPanels.at(i)) == now) {
            next = i + 1;
        }
    }
    for (; next < kPanels.size(); ++next) {
        ImGuiWindow* const window = ImGui::FindWindowByName(kPanels.at(next));
        if (is_shown(window)) {
            return window;
        }
    }
    return nullptr;
}

} // namespace

void PanelFocus::begin(DialogKeys dialog, FocusMove move) {
    ImGuiContext& context = *ImGui::GetCurrentContext();
    if (dialog != DialogKeys::NoDialog && dialog_ == DialogKeys::NoDialog) {
        const ImGuiWindow* const window = focused_panel();
        before_ = window == nullptr ? "" : window->Name;
    }
    if (dialog == DialogKeys::NoDialog && dialog_ != DialogKeys::NoDialog) {
        ImGuiWindow* const window =
            before_.empty() ? nullptr : ImGui::FindWindowByName(before_.c_str());
        focus(is_shown(window) ? window : nullptr);
        ImGui::GetIO().WantTextInput = false; // set by a text field of the dialog
    }
    if (dialog == DialogKeys::OfPanels && dialog_ != DialogKeys::OfPanels) {
        context.NavDisableHighlight = false;
        context.NavDisableMouseHover = true;
    } else if (dialog == DialogKeys::OfControls) {
        context.NavDisableHighlight = true;
    }
    dialog_ = dialog;
    if (dialog == DialogKeys::NoDialog && move != FocusMove::None) {
        focus(move == FocusMove::Next ? next_panel() : nullptr);
    }
}

void PanelFocus::end(DialogKeys dialog) {
    const bool has_list =
        ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    const ImGuiWindow* const window = focused_panel();
    const bool has_panel =
        dialog_ != DialogKeys::NoDialog
            ? !before_.empty() // the keyboard returns in the next frame
            : window != nullptr && (window->Flags & ImGuiWindowFlags_NoNavInputs) == 0;
    if (dialog == DialogKeys::NoDialog && dialog_ != DialogKeys::NoDialog) {
        ImGui::GetIO().WantTextInput = false; // set by a text field of the dialog
    }
    has_keys_ =
        dialog == DialogKeys::OfPanels || has_list || (dialog == DialogKeys::NoDialog && has_panel);
}

} // namespace lsys::view
