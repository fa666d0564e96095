// ViewSwitcher: the view that a window shows: of a plant or of a forest, by the file.
#pragma once

#include "viewer/app/forest_view.h"
#include "viewer/app/plant_view.h"

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

    [[nodiscard]] View& shown() { return *shown_; }
    /// Null if the other is shown.
    [[nodiscard]] PlantView* plant() { return plant_; }
    [[nodiscard]] ForestView* forest() { return forest_; }

    /// Shows another file, all in view: a scene as a forest, a grammar as a plant. Not while
    /// something is unsaved: that is said, and asking once more shows it.
    void open(const std::string& file);
    /// The scene that was shown before its grammar; empty: none.
    [[nodiscard]] const std::string& last_scene() const { return last_scene_; }

private:
    void make(const ViewOptions& options);

    ViewOptions options_;
    Console console_;
    Renderer* renderer_;
    std::function<void()> wake_;
    std::string last_scene_;
    std::string refused_; // because something is unsaved
    PlantView* plant_ = nullptr;
    ForestView* forest_ = nullptr;
    std::unique_ptr<View> shown_;
};

} // namespace lsys::view
