// SPDX-License-Identifier: MIT
// The start page, shown without a file: recent files and a gallery of samples; and the dialog that
// opens a file.
#pragma once

#include "viewer/app/file_browser.h"
#include "viewer/app/sample_gallery.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lsys::view {

/// Uploads a picture for ImGui::Image(): Window::add_image().
using AddImage = std::function<std::uintptr_t(const Texture& picture)>;

/// State of the start page. The selection is a recent file or a sample.
struct StartPage {
    bool is_loaded = false;
    std::string samples_folder; // empty: no samples are installed
    std::vector<std::string> recent;
    std::vector<GallerySample> samples;
    std::vector<std::uintptr_t> images; // pictures of the first samples, uploaded so far
    bool in_recent = false;             // the selection is among the recent files
    std::size_t selected = 0;
    std::size_t columns = 1;   // columns of the gallery
    bool wants_scroll = false; // the page must scroll to the selection
    std::string letters;       // typed since the selection was last moved

    /// Reads the list of recent files in `state`, and the samples of `folder`.
    void load(const std::string& state, const std::string& folder);
    /// Moves the selection: right and down within the gallery, from its first column to the left
    /// into the recent files, and back.
    void move(int right, int down);
    /// Selects the first sample whose name contains the letters typed since the selection was last
    /// moved by an arrow; if there is none, the next one that contains `text` alone.
    void find(const std::string& text);
    /// The file selected; empty if there is none.
    [[nodiscard]] std::string selected_file() const;
};

/// Draws the start page over the whole window. Uploads at most one picture. Returns the file
/// clicked, or an empty path. `wants_dialog` is set by the button that opens a file.
[[nodiscard]] std::string
draw_start_page(StartPage& page, const AddImage& add_image, bool& wants_dialog);
/// Whether pictures of samples are still to be uploaded, so that the page is to be drawn again.
[[nodiscard]] bool is_loading(const StartPage& page);

/// Draws the dialog in the middle of the window. Returns the file chosen by the mouse, or an empty
/// path; `is_open` becomes false after *Cancel*.
[[nodiscard]] std::string draw_open_dialog(FileBrowser& browser, bool& is_open);

} // namespace lsys::view
