// SPDX-License-Identifier: MIT
#include "viewer/app/panel_focus.h"

#include <array>
#include <cstddef>
#include <imgui.h>
#include <imgui_internal.h>
#include <string_view>

namespace lsys::view {

namespace {

/// Windows other than dialogs that can have the keyboard, in the order of F6.
constexpr std::array<const char*, 8> kPanels = {"Panel", "Buttons",  kSourceButtons, kSourceLines,
                                                "Trace", "Messages", "Making",       "Keys"};

/// Whether a window is a part of the source pane that has the keyboard on its own. ImGui puts the
/// names of the windows around it before its own.
bool is_source_part(const ImGuiWindow& window, std::string_view name) {
    const std::string_view whole = window.Name;
    const std::size_t last = whole.find_last_of('/');
    return (window.Flags & ImGuiWindowFlags_ChildWindow) != 0 && last != std::string_view::npos &&
           whole.substr(last + 1, name.size()) == name;
}

/// The window with the keyboard: a panel, without the windows inside it, or a part of the source
/// pane; null: the picture has it.
ImGuiWindow* focused_panel() {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    ImGuiWindow* const window = context.NavWindow;
    if (window == nullptr || context.NavDisableHighlight) {
        return nullptr;
    }
    return is_source_part(*window, kSourceButtons) || is_source_part(*window, kSourceLines)
               ? window
               : window->RootWindow;
}

/// The window of an entry of kPanels; null: there is none.
ImGuiWindow* find_panel(const char* name) {
    if (ImGuiWindow* const window = ImGui::FindWindowByName(name)) {
        return window;
    }
    for (ImGuiWindow* const window : ImGui::GetCurrentContext()->Windows) {
        if (window->WasActive && is_source_part(*window, name)) {
            return window;
        }
    }
    return nullptr;
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
    if (last->NavLastIds[0] == 0 && (last->Flags & ImGuiWindowFlags_NoNavInputs) == 0) {
        ImGui::NavInitWindow(last, false);
    }
    context.NavDisableHighlight = false;
    context.NavDisableMouseHover = true; // until the mouse moves
}

ImGuiWindow* next_panel() {
    const ImGuiWindow* const now = focused_panel();
    std::size_t next = 0;
    for (std::size_t i = 0; i < kPanels.size(); ++i) {
        if (now != nullptr && find_panel(kPanels.at(i)) == now) {
            next = i + 1;
        }
    }
    for (; next < kPanels.size(); ++next) {
        ImGuiWindow* const window = find_panel(kPanels.at(next));
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
