// SPDX-License-Identifier: MIT
#include "viewer/app/view_switcher.h"

#include "runtime/pipeline/forest.h"
#include "viewer/app/file_browser.h"

#include <utility>

namespace lsys::view {

ViewSwitcher::ViewSwitcher(const ViewOptions& options,
                           const Console& console,
                           Renderer& renderer,
                           std::function<void()> wake)
    : options_(options), console_(console), renderer_(&renderer), wake_(std::move(wake)) {
    make(options_);
}

void ViewSwitcher::make(const ViewOptions& options) {
    plant_ = nullptr;
    forest_ = nullptr;
    // The old view must end before the new view is made, because both watch files and use the
    // renderer.
    current_.reset();
    if (options.file.empty()) {
        current_ = std::make_unique<StartView>(options, console_, *renderer_, wake_);
    } else if (options.is_forest) {
        auto forest = std::make_unique<ForestView>(options, console_, *renderer_, wake_);
        forest_ = forest.get();
        current_ = std::move(forest);
    } else {
        auto plant = std::make_unique<PlantView>(options, console_, *renderer_, wake_);
        plant_ = plant.get();
        current_ = std::move(plant);
    }
}

void ViewSwitcher::open_neighbour(int step) {
    if (current_->path().empty()) {
        return;
    }
    const std::string file = neighbour_file(current_->path(), step);
    if (file.empty()) {
        current_->set_note("There is no other file in this folder");
    } else {
        open(file);
    }
}

void ViewSwitcher::open(const std::string& file) {
    if (current_->is_unsaved()) {
        leaving_ = Leaving{file};
    } else {
        open_now(file);
    }
}

bool ViewSwitcher::may_quit() {
    if (current_->is_unsaved()) {
        leaving_ = Leaving{};
    }
    return !leaving_;
}

bool ViewSwitcher::leave() {
    const std::string file = std::exchange(leaving_, std::nullopt)->file;
    if (!file.empty()) {
        open_now(file);
    }
    return file.empty();
}

void ViewSwitcher::open_now(const std::string& file) {
    const bool is_forest = is_scene(file);
    if (forest_ != nullptr && is_scene(forest_->path())) {
        last_scene_ = forest_->path();
    }
    if (is_forest && forest_ != nullptr) {
        forest_->open(file);
        return;
    }
    if (!is_forest && plant_ != nullptr) {
        plant_->open(file);
        return;
    }
    ViewOptions options = options_;
    use_other_file(options, file);
    make(options);
}

} // namespace lsys::view
