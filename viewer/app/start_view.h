// SPDX-License-Identifier: MIT
// StartView: the view of a window without a file; draws an empty sky behind the start page.
#pragma once

#include "viewer/app/view.h"

#include <string>

namespace lsys::view {

class StartView final : public View {
public:
    using View::View;

    bool update() override { return false; }
    bool draw(std::uint32_t width, std::uint32_t height) override {
        Frame frame;
        frame.width = width;
        frame.height = height;
        frame.samples = 1;
        return draw_frame(frame);
    }
    void picture_shown(double /*draw_seconds*/) override {}
    [[nodiscard]] bool is_busy() const override { return false; }
    [[nodiscard]] std::optional<MakingState> making() const override { return std::nullopt; }
    void cancel_making() override {}
    void record_edits() override {}
    void undo() override {}
    void redo() override {}
    void reload() override {}
    void frame_all() override {}
    /// Always empty.
    [[nodiscard]] const std::string& path() const override { return options_.file; }
    [[nodiscard]] LoadedSources loaded_sources() const override { return common_sources(); }
    [[nodiscard]] ViewOptions picture_options(FilmKind /*kind*/) const override { return options_; }
    [[nodiscard]] Camera& camera() override { return camera_; }

protected:
    [[nodiscard]] PickRequest request_for(const Picked& /*picked*/) const override { return {}; }

private:
    Camera camera_;
};

} // namespace lsys::view
