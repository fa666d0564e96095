// SPDX-License-Identifier: MIT
// PanelFocus: the part of the window that has the keyboard: the picture, a panel or a dialog. While
// a panel or dialog has it, a ring is drawn around one of its controls.
#pragma once

#include <cstdint>
#include <string>

namespace lsys::view {

/// Names of the child windows of the source pane that have the keyboard in turn: the buttons, and
/// the lines, which handle their keys themselves.
inline constexpr const char* kSourceButtons = "Source buttons";
inline constexpr const char* kSourceLines = "Source lines";

/// Where the user wants the keyboard: in the next panel, or in the picture.
enum class FocusMove : std::uint8_t { None, Next, Picture };

/// Who handles the keys of the open dialog: the panels (ImGui), or Controls, whose dialogs have no
/// ring.
enum class DialogKeys : std::uint8_t { NoDialog, OfPanels, OfControls };

class PanelFocus {
public:
    /// Call before the panels are drawn. FocusMove::Next gives the keyboard to the next panel, and
    /// after the last one to the picture. A dialog gets the keyboard when it opens, and gives it
    /// back when it closes.
    void begin(DialogKeys dialog, FocusMove move);
    /// Call after the panels are drawn. `dialog`: the dialog for the next frame.
    void end(DialogKeys dialog);
    /// Whether a panel or a dialog of ImGui has the keyboard. Does not need ImGui.
    [[nodiscard]] bool has_keys() const { return has_keys_; }

private:
    DialogKeys dialog_ = DialogKeys::NoDialog;
    std::string before_; // window that had the keyboard before the dialog; empty: the picture
    bool has_keys_ = false;
};

} // namespace lsys::view
