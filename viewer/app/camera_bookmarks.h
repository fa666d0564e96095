// SPDX-License-Identifier: MIT
// CameraBookmarks: nine cameras with names, kept for each plant or scene in the user's state
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
    /// Reads the bookmarks of `file` from the state folder, unless they are those held. Lines that
    /// are not understood are skipped. Without a state folder bookmarks last as long as `file` is
    /// shown.
    void show(const std::string& state_folder, const std::string& file);

    /// Bookmark 1 is the first.
    [[nodiscard]] const std::array<std::optional<CameraBookmark>, kBookmarks>& all() const {
        return bookmarks_;
    }
    /// Sets a camera; it keeps the name that it has, and is named "Camera 1" at first. `index`:
    /// 0 to 8.
    void set(std::size_t index, const Camera& camera, const Console& console);
    /// Precondition: the bookmark is set.
    void rename(std::size_t index, const std::string& name, const Console& console);
    void remove(std::size_t index, const Console& console);

private:
    void write(const Console& console) const;

    std::string path_; // of the stored bookmarks; empty: they are not stored
    std::string file_;
    std::array<std::optional<CameraBookmark>, kBookmarks> bookmarks_;
};

} // namespace lsys::view
