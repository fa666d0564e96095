#include "viewer/app/controls.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <numbers>

namespace lsys::view {

namespace {

bool is_held(const WindowInput& input, Key key) {
    return std::find(input.held.begin(), input.held.end(), key) != input.held.end();
}

float held_way(const WindowInput& input, Key forwards, Key backwards) {
    return (is_held(input, forwards) ? 1.0F : 0.0F) - (is_held(input, backwards) ? 1.0F : 0.0F);
}

} // namespace

void next_seed(LiveView& view) {
    const std::uint64_t shown = view.document() == nullptr ? 0 : view.document()->plant.seed;
    view.settings.seed = view.settings.seed.value_or(shown) + 1;
}

void step_generations(LiveView& view, int step) {
    const std::uint32_t now = view.generations();
    view.settings.grows = false;
    if (step > 0 || now > 0) {
        view.settings.generations = step > 0 ? now + 1 : now - 1;
    }
}

void Controls::apply(
    const WindowInput& input, double seconds, float height, LiveView& view, PanelState& panels) {
    for (const KeyPress& one : input.presses) {
        press(one, view, panels);
    }
    for (const std::string& file : input.dropped) {
        view.open(file);
    }
    Camera& camera = view.settings.camera;
    is_moving_ = panels.flies;
    if (panels.flies) {
        fly(input, static_cast<float>(seconds), height, camera);
        return;
    }
    // Half a turn along the picture's height.
    const float turn = std::numbers::pi_v<float> / std::max(height, 1.0F);
    if (input.left_drag != glm::vec2(0.0F)) {
        camera = orbited(camera, turn * input.left_drag.x, turn * input.left_drag.y);
    }
    if (input.right_drag != glm::vec2(0.0F)) {
        // What lies at the target stays under the mouse.
        const float metres =
            2.0F * glm::distance(camera.eye, camera.target) *
            std::tan(0.5F * std::numbers::pi_v<float> / 180.0F * camera.field_of_view) /
            std::max(height, 1.0F);
        camera = moved(camera, -metres * input.right_drag.x, metres * input.right_drag.y, 0.0F);
    }
    if (input.wheel != 0.0F) {
        constexpr float kNotch = 0.85F;
        camera = zoomed(camera, std::pow(kNotch, input.wheel));
    }
}

void Controls::fly(const WindowInput& input, float seconds, float height, Camera& camera) {
    const float turn = std::numbers::pi_v<float> / (2.0F * std::max(height, 1.0F));
    camera = turned(camera, turn * input.motion.x, -turn * input.motion.y);
    constexpr float kNotch = 1.2F;
    constexpr float kFaster = 4.0F;
    speed_ *= std::pow(kNotch, input.wheel);
    // To the target within two seconds.
    const float metres = 0.5F * speed_ * (is_held(input, Key::Shift) ? kFaster : 1.0F) * seconds *
                         glm::distance(camera.eye, camera.target);
    camera =
        moved(camera, metres * held_way(input, Key::D, Key::A),
              metres * held_way(input, Key::E, Key::Q), metres * held_way(input, Key::W, Key::S));
}

void Controls::press(const KeyPress& press, LiveView& view, PanelState& panels) {
    LiveSettings& settings = view.settings;
    if (press.control) {
        panels.quits = panels.quits || press.key == Key::Q;
        return;
    }
    switch (press.key) {
    case Key::Tab:
        panels.flies = !panels.flies;
        return;
    case Key::Escape:
        panels.help = false;
        panels.flies = false;
        return;
    case Key::F1:
        panels.help = !panels.help;
        return;
    case Key::Space:
        view.play_or_pause();
        return;
    case Key::PageUp:
        step_generations(view, 1);
        return;
    case Key::PageDown:
        step_generations(view, -1);
        return;
    default:
        break;
    }
    if (panels.flies) {
        return; // letters move
    }
    switch (press.key) {
    case Key::F:
        view.frame_all();
        break;
    case Key::C:
        ImGui::SetClipboardText(to_text(settings.camera).c_str());
        break;
    case Key::W:
        settings.style =
            settings.style == PlantStyle::Wireframe ? PlantStyle::Surface : PlantStyle::Wireframe;
        break;
    case Key::I:
        settings.style =
            settings.style == PlantStyle::None ? PlantStyle::Surface : PlantStyle::None;
        break;
    case Key::L:
        settings.lines = settings.lines == LineKind::None       ? LineKind::Skeleton
                         : settings.lines == LineKind::Skeleton ? LineKind::TurtlePath
                                                                : LineKind::None;
        break;
    case Key::S:
        settings.shadows = !settings.shadows;
        break;
    case Key::G:
        settings.ground = !settings.ground;
        break;
    case Key::B:
        settings.bends = !settings.bends;
        break;
    case Key::N:
        next_seed(view);
        break;
    case Key::R:
        view.reload();
        break;
    case Key::P:
        view.write_screenshot();
        break;
    case Key::H:
        panels.panels = !panels.panels;
        break;
    case Key::A:
        panels.statistics = !panels.statistics;
        break;
    default:
        break;
    }
}

} // namespace lsys::view
