// SPDX-License-Identifier: MIT
// ViewSwitcher: owns the view of a window: a PlantView or a ForestView, according to the file, or
// without a file a StartView.
#pragma once

#include "viewer/app/forest_view.h"
#include "viewer/app/plant_view.h"
#include "viewer/app/start_view.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace lsys::view {

/// A request that waits until the user has decided what happens to unsaved changes.
struct Leaving {
    std::string file; // file to open; empty: the window is to be closed
};

class ViewSwitcher {
public:
    ViewSwitcher(const ViewOptions& options,
                 const Console& console,
                 Renderer& renderer,
                 std::function<void()> wake);

    [[nodiscard]] View& current() { return *current_; }
    /// The plant view; null if another kind of view is shown.
    [[nodiscard]] PlantView* plant() { return plant_; }
    /// The forest view; null if another kind of view is shown.
    [[nodiscard]] ForestView* forest() { return forest_; }

    /// Opens another file, a scene as a forest or a grammar as a plant, and moves the camera so
    /// that it shows all of it. If there are unsaved changes, only sets leaving().
    void open(const std::string& file);
    /// Returns whether the window may be closed. If there are unsaved changes, sets leaving() and
    /// returns false.
    [[nodiscard]] bool may_quit();
    /// The last request that found unsaved changes; nullopt: no request waits.
    [[nodiscard]] const std::optional<Leaving>& leaving() const { return leaving_; }
    /// Drops the waiting request.
    void stay() { leaving_.reset(); }
    /// Carries out the waiting request without saving. Returns whether the window is to be closed.
    /// Precondition: leaving() has a value.
    [[nodiscard]] bool leave();
    /// Opens the next file (`step` 1) or the previous file (-1) in the folder of the file shown.
    void open_neighbour(int step);
    /// The scene that was shown before the plant; empty: none.
    [[nodiscard]] const std::string& last_scene() const { return last_scene_; }

private:
    void make(const ViewOptions& options);  // replaces the current view
    void open_now(const std::string& file); // open() without a look at unsaved changes

    ViewOptions options_;
    Console console_;
    Renderer* renderer_;
    std::function<void()> wake_;
    std::string last_scene_; // last_scene()
    std::optional<Leaving> leaving_;
    PlantView* plant_ = nullptr;   // null: another view is shown
    ForestView* forest_ = nullptr; // null: another view is shown
    std::unique_ptr<View> current_;
};

} // namespace lsys::view
