// SPDX-License-Identifier: MIT
// The start page, which a window without a file shows: recent files and a gallery of samples; and
// the dialog that opens a file.
#pragma once

#include "viewer/app/file_browser.h"
#include "viewer/app/sample_gallery.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace lsys::view {

/// Uploads a picture and returns its number for ImGui::Image(), like Window::add_image().
using AddImage = std::function<std::uintptr_t(const Texture& picture)>;

/// State of the start page. The selection is a recent file or a sample.
struct StartPage {
    bool is_loaded = false;     // load() has been called
    std::string samples_folder; // empty: no samples are installed
    std::vector<std::string> recent;
    std::vector<GallerySample> samples;
    std::vector<std::uintptr_t> images; // pictures of the first samples, as far as uploaded
    bool in_recent = false;             // the selection is among the recent files
    std::size_t selected = 0;           // index in `recent` or `samples`
    std::size_t columns = 1;            // columns of the gallery
    bool wants_scroll = false;          // the page must scroll to the selection
    std::string letters;                // letters typed since the last move of the selection

    /// Reads the list of recent files in the folder `state`, and the samples in `folder`.
    void load(const std::string& state, const std::string& folder);
    /// Moves the selection right and down within the gallery; from the first column of the gallery,
    /// left into the recent files; and back.
    void move(int right, int down);
    /// Selects the first sample whose name contains all letters typed since an arrow key last moved
    /// the selection. If there is none, selects the next sample whose name contains `text`.
    void find(const std::string& text);
    /// The file selected; empty if there is none.
    [[nodiscard]] std::string selected_file() const;
};

/// Draws the start page over the whole window. Uploads at most one picture. Returns the path of the
/// file that was clicked, or an empty path. Sets `wants_dialog` if the button that opens a file was
/// pressed.
[[nodiscard]] std::string
draw_start_page(StartPage& page, const AddImage& add_image, bool& wants_dialog);
/// Whether pictures of samples have not been uploaded yet, so that the page must be drawn again.
[[nodiscard]] bool is_loading(const StartPage& page);

/// Draws the dialog in the middle of the window. Returns the path of the file that was clicked, or
/// an empty path. `is_open` becomes false after *Cancel*.
[[nodiscard]] std::string draw_open_dialog(FileBrowser& browser, bool& is_open);

} // namespace lsys::view
