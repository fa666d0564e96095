// SPDX-License-Identifier: MIT
// ViewSwitcher: holds the view of a plant or of a forest, by the kind of the file; without a file,
// a StartView.
#pragma once

#include "viewer/app/forest_view.h"
#include "viewer/app/plant_view.h"
#include "viewer/app/start_view.h"

#include <functional>
#include <memory>
#include <string>

namespace lsys::view {

class ViewSwitcher {
public:
    ViewSwitcher(const ViewOptions& options,
                 const Console& console,
                 Renderer& renderer,
                 std::function<void()> wake);

    [[nodiscard]] View& current() { return *current_; }
    /// Null if another kind is shown.
    [[nodiscard]] PlantView* plant() { return plant_; }
    [[nodiscard]] ForestView* forest() { return forest_; }

    /// Opens and frames another file: a scene as a forest, a grammar as a plant. With unsaved
    /// changes the first call only warns.
    void open(const std::string& file);
    /// Opens the next file (`step` 1) or the previous one (-1) of the folder of the file shown.
    void open_neighbour(int step);
    /// Makes the next open() with unsaved changes warn again.
    void reset_warning() { refused_file_.clear(); }
    /// Scene shown before the plant; empty: none.
    [[nodiscard]] const std::string& last_scene() const { return last_scene_; }

private:
    void make(const ViewOptions& options);

    ViewOptions options_;
    Console console_;
    Renderer* renderer_;
    std::function<void()> wake_;
    std::string last_scene_;
    std::string refused_file_; // last file whose opening was refused because of unsaved changes
    PlantView* plant_ = nullptr;
    ForestView* forest_ = nullptr;
    std::unique_ptr<View> current_;
};

} // namespace lsys::view
