// SPDX-License-Identifier: MIT
// CameraBookmarks: nine cameras with names for each plant or scene, stored in the user's state
// folder.
#pragma once

#include "runtime/program/console.h"
#include "viewer/scene/camera.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace lsys::view {

inline constexpr std::size_t kBookmarks = 9;

struct CameraBookmark {
    std::string name; // one line
    Camera camera;
};

class CameraBookmarks {
public:
    /// Reads the bookmarks of `file` from the state folder, unless the last call had the same
    /// `file`. Skips lines that are not bookmarks. Without a state folder, the bookmarks of a file
    /// are lost when another file is shown.
    void show(const std::string& state_folder, const std::string& file);

    /// Bookmark 1 has index 0.
    [[nodiscard]] const std::array<std::optional<CameraBookmark>, kBookmarks>& all() const {
        return bookmarks_;
    }
    /// Sets the camera of bookmark `index` + 1 (`index`: 0 to 8). An existing bookmark keeps its
    /// name; a new one is named "Camera 1", with its own number.
    void set(std::size_t index, const Camera& camera, const Console& console);
    /// Precondition: the bookmark is set.
    void rename(std::size_t index, const std::string& name, const Console& console);
    void remove(std::size_t index, const Console& console);

private:
    void write(const Console& console) const; // writes all bookmarks to path_

    std::string path_; // file of the bookmarks; empty: they are not stored
    std::string file_; // plant or scene whose bookmarks are loaded
    std::array<std::optional<CameraBookmark>, kBookmarks> bookmarks_;
};

} // namespace lsys::view
