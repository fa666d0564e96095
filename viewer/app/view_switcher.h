// SPDX-License-Identifier: MIT
// ViewSwitcher: holds the view of a plant or of a forest, by the kind of the file; without a file,
// a StartView.
#pragma once

#include "viewer/app/forest_view.h"
#include "viewer/app/plant_view.h"
#include "viewer/app/start_view.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace lsys::view {

/// A request that waits until the user has decided about unsaved changes.
struct Leaving {
    std::string file; // to open; empty: the window is to be closed
};

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
    /// changes only sets leaving().
    void open(const std::string& file);
    /// Returns whether the window may be closed. With unsaved changes it may not: then
    /// may_quit() sets leaving().
    [[nodiscard]] bool may_quit();
    /// The last request that found unsaved changes; empty: none waits.
    [[nodiscard]] const std::optional<Leaving>& leaving() const { return leaving_; }
    /// Drops the request.
    void stay() { leaving_.reset(); }
    /// Fulfils the request without saving. Returns whether the window is to be closed.
    /// Precondition: leaving().
    [[nodiscard]] bool leave();
    /// Opens the next file (`step` 1) or the previous one (-1) of the folder of the file shown.
    void open_neighbour(int step);
    /// Scene shown before the plant; empty: none.
    [[nodiscard]] const std::string& last_scene() const { return last_scene_; }

private:
    void make(const ViewOptions& options);
    void open_now(const std::string& file);

    ViewOptions options_;
    Console console_;
    Renderer* renderer_;
    std::function<void()> wake_;
    std::string last_scene_;
    std::optional<Leaving> leaving_;
    PlantView* plant_ = nullptr;
    ForestView* forest_ = nullptr;
    std::unique_ptr<View> current_;
};

} // namespace lsys::view
