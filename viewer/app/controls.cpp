// SPDX-License-Identifier: MIT
#include "viewer/app/controls.h"

#include "grammar/base/paths.h"
#include "viewer/app/output_path.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <numbers>
#include <utility>

namespace lsys::view {

namespace {

bool is_held(const WindowInput& input, Key key) {
    return std::find(input.held.begin(), input.held.end(), key) != input.held.end();
}

float held_axis(const WindowInput& input, Key forwards, Key backwards) {
    return (is_held(input, forwards) ? 1.0F : 0.0F) - (is_held(input, backwards) ? 1.0F : 0.0F);
}

/// The scope after `scope` in the order of the key; after the last scope comes the first.
TraceScope scope_after(TraceScope scope) {
    switch (scope) {
    case TraceScope::Written:
        return TraceScope::Next;
    case TraceScope::Next:
        return TraceScope::Back;
    case TraceScope::Back:
        break;
    }
    return TraceScope::Written;
}

/// Index of the bookmark that a digit key selects.
std::optional<std::size_t> bookmark_of(Key key) {
    return key >= Key::One && key <= Key::Nine
               ? std::optional(static_cast<std::size_t>(key) - static_cast<std::size_t>(Key::One))
               : std::nullopt;
}

/// Rotates the camera around the target by half a turn per picture height that the mouse is
/// dragged.
void orbit(Camera& camera, const glm::vec2& drag, float height) {
    const float turn = std::numbers::pi_v<float> / std::max(height, 1.0F);
    if (drag != glm::vec2(0.0F)) {
        camera = orbited(camera, turn * drag.x, turn * drag.y);
    }
}

/// Moves the camera so that the target follows the dragged mouse.
void pan(Camera& camera, const glm::vec2& drag, float height) {
    if (drag != glm::vec2(0.0F)) {
        const float metres =
            2.0F * glm::distance(camera.eye, camera.target) *
            std::tan(0.5F * std::numbers::pi_v<float> / 180.0F * camera.field_of_view) /
            std::max(height, 1.0F);
        camera = moved(camera, -metres * drag.x, metres * drag.y, 0.0F);
    }
}

/// Converts a place in the window in pixels to half picture heights, right and up from the centre
/// of the picture.
glm::vec2 place_in_picture(const glm::vec2& pixels, const PixelArea& area) {
    // Picture and window have the same upper edge.
    const float half = 0.5F * static_cast<float>(area.height);
    return {(pixels.x - static_cast<float>(area.x) - 0.5F * static_cast<float>(area.width)) / half,
            (half - pixels.y) / half};
}

void zoom(Camera& camera, float wheel) {
    if (wheel != 0.0F) {
        constexpr float kZoomPerNotch = 0.85F;
        camera = zoomed(camera, std::pow(kZoomPerNotch, wheel));
    }
}

} // namespace

void open_in_editor(const FilePosition& place, View& view, PanelState& panels) {
    const Result<std::string> editor = panels.editors.open(place);
    view.set_note(editor ? fmt::format("opened {}:{} in {}", place.file, place.line, editor.value())
                         : editor.error().message);
}

void show_open_dialog(const View& view, PanelState& panels) {
    panels.browser.show(std::string(folder_of_path(view.path())));
    panels.dialog = OpenDialog::File;
}

void show_picture_dialog(const View& view, PanelState& panels) {
    panels.picture.name =
        unused_picture_name(panels.picture.folder, path_text(path_of(view.path()).stem()));
    panels.dialog = OpenDialog::Picture;
}

void take_picture(View& view, PanelState& panels) {
    PictureSettings settings = panels.picture;
    const std::string problem =
        settings.name.empty() ? "the picture has no name" : problem_of_output(settings.path());
    if (!problem.empty()) {
        view.set_note("not written: " + problem); // also shown in the dialog, which stays open
        return;
    }
    settings.width = settings.width == 0 ? view.picture_width() : settings.width;
    settings.height = settings.height == 0 ? view.picture_height() : settings.height;
    panels.dialog = OpenDialog::None;
    if (settings.width == 0) {
        view.set_note("not written: there is no picture yet");
    } else if (!settings.is_film) {
        view.write_picture(settings);
    } else if (view.is_unsaved()) {
        view.set_note("not written: a film shows saved trees; Ctrl+S saves the painted ones");
    } else if (settings.kind == FilmKind::Growth && !view.has_growth()) {
        view.set_note("not written: nothing grows here");
    } else if (panels.film.is_busy()) {
        view.set_note("not written: one film at a time");
    } else {
        panels.film.begin(view.picture_options(settings.kind), settings, panels.wake);
    }
}

void show_export_dialog(PanelState& panels) {
    panels.dialog = OpenDialog::Export;
}

void export_shown(PlantView& view, PanelState& panels) {
    const std::string problem = problem_of_export(view.settings.output.file);
    if (!problem.empty()) {
        view.set_note("not written: " + problem); // also shown in the dialog, which stays open
        return;
    }
    panels.dialog = OpenDialog::None;
    view.export_shown();
}

void ask_about_unsaved(const ViewSwitcher& switcher, PanelState& panels) {
    if (!switcher.leaving() || panels.dialog == OpenDialog::Unsaved) {
        return;
    }
    if (panels.dialog == OpenDialog::Sheet) {
        close_sheet(panels);
    }
    panels.save_failure.clear();
    panels.dialog = OpenDialog::Unsaved;
}

void answer_unsaved(UnsavedAnswer answer, ViewSwitcher& switcher, PanelState& panels) {
    if (!switcher.leaving()) {
        return;
    }
    View& view = switcher.current();
    if (answer == UnsavedAnswer::Save) {
        view.save();
        if (view.is_unsaved()) {
            panels.save_failure = view.note();
            return;
        }
    }
    panels.dialog = OpenDialog::None;
    if (answer == UnsavedAnswer::Cancel) {
        switcher.stay();
    } else {
        panels.quits = switcher.leave();
    }
}

void show_sheet(PlantView& view, PanelState& panels) {
    if (view.document() == nullptr) {
        view.set_note("There is no plant for a contact sheet");
        return;
    }
    const SheetSize cell = sheet_cell_size(panels.window_width, panels.window_height);
    panels.sheet.show(view, cell.width, cell.height, panels.wake);
    panels.dialog = OpenDialog::Sheet;
}

void close_sheet(PanelState& panels) {
    panels.sheet.close();
    panels.dialog = OpenDialog::None;
}

void take_from_sheet(std::size_t cell, PlantView& view, PanelState& panels) {
    take_cell(panels.sheet.cells.at(cell), view.settings);
    close_sheet(panels);
}

void next_seed(PlantView& view) {
    const std::uint64_t shown = view.document() == nullptr ? 0 : view.document()->plant.seed;
    view.settings.seed = view.settings.seed.value_or(shown) + 1;
}

void step_generations(PlantView& view, int step) {
    const std::uint32_t now = view.generations();
    view.settings.plays = false;
    if (step > 0 || now > 0) {
        view.settings.generations = step > 0 ? now + 1 : now - 1;
    }
}

void next_forest_key(ForestView& view) {
    const std::uint64_t shown =
        view.document() == nullptr ? 0 : view.document()->scene.placement.key;
    view.settings.edits.key = shown + 1;
}

void Controls::apply(const WindowInput& input,
                     double seconds,
                     const PixelArea& area,
                     ViewSwitcher& switcher,
                     PanelState& panels) {
    for (const std::string& file : input.dropped) {
        if (panels.dialog == OpenDialog::Sheet) {
            close_sheet(panels);
        }
        panels.dialog = OpenDialog::None;
        switcher.open(file);
    }
    if (use_pages(input, switcher, panels)) {
        pressed_.reset();
        is_moving_ = false;
    } else {
        apply_to_view(input, seconds, area, switcher, panels);
    }
    if (input.close_requested || std::exchange(panels.wants_to_quit, false)) {
        panels.quits = switcher.may_quit();
    }
    ask_about_unsaved(switcher, panels);
}

void Controls::apply_to_view(const WindowInput& input,
                             double seconds,
                             const PixelArea& area,
                             ViewSwitcher& switcher,
                             PanelState& panels) {
    for (const KeyPress& press : input.presses) {
        if (press.alt) {
            press_with_alt(press.key, switcher, panels);
        }
    }
    ForestView* const shown = switcher.forest();
    PlantView* const plant = switcher.plant();
    WindowInput rest = input;
    rest.left_drag = glm::vec2(0.0F);
    if (plant != nullptr && !panels.flies && move_obstacle(input, area, *plant)) {
        pressed_.reset();
        apply(rest, seconds, static_cast<float>(area.height), *plant, panels);
        return;
    }
    if (shown != nullptr && !panels.flies && shown->settings.tool == PaintTool::None &&
        move_obstacle(input, area, *shown)) {
        pressed_.reset();
        apply(rest, seconds, area, *shown, panels);
        return;
    }
    if (!panels.flies && (shown == nullptr || shown->settings.tool == PaintTool::None)) {
        click(input, area, switcher.current());
    } else {
        pressed_.reset();
    }
    if (shown != nullptr) {
        apply(input, seconds, area, *shown, panels);
    } else if (plant != nullptr) {
        apply(input, seconds, static_cast<float>(area.height), *plant, panels);
    }
}

void Controls::press_with_alt(Key key, ViewSwitcher& switcher, PanelState& panels) {
    View& view = switcher.current();
    if (const std::optional<std::size_t> index = bookmark_of(key)) {
        panels.bookmarks.show(panels.state_folder, view.path());
        if (const std::optional<CameraBookmark>& bookmark = panels.bookmarks.all().at(*index)) {
            view.camera() = bookmark->camera;
        } else {
            view.set_note(fmt::format("There is no camera {0}: Ctrl+{0} sets it", *index + 1));
        }
    }
    if (key == Key::Left || key == Key::Right) {
        switcher.open_neighbour(key == Key::Right ? 1 : -1);
    }
}

bool Controls::use_pages(const WindowInput& input, ViewSwitcher& switcher, PanelState& panels) {
    const bool is_start = switcher.current().path().empty();
    if (!is_start && panels.dialog == OpenDialog::None) {
        return false;
    }
    std::string chosen;
    FileBrowser& browser = panels.browser;
    if (panels.dialog == OpenDialog::File && !input.text.empty()) {
        browser.set_text(browser.text() + input.text);
    } else if (panels.dialog == OpenDialog::None) {
        panels.start.find(input.text);
    }
    for (const KeyPress& press : input.presses) {
        press_in_page(press, switcher, panels, chosen);
    }
    if (!chosen.empty()) {
        panels.dialog = OpenDialog::None;
        switcher.open(chosen);
    }
    return true;
}

/// Handles keys that the panels have not handled.
void Controls::press_in_page(const KeyPress& press,
                             ViewSwitcher& switcher,
                             PanelState& panels,
                             std::string& chosen) {
    if (press.control) {
        panels.wants_to_quit = panels.wants_to_quit || press.key == Key::Q;
        if (press.key == Key::O &&
            (panels.dialog == OpenDialog::None || panels.dialog == OpenDialog::Picture ||
             panels.dialog == OpenDialog::Export)) {
            show_open_dialog(switcher.current(), panels);
        }
        return;
    }
    const bool accepts = press.key == Key::Enter;
    const bool cancels = press.key == Key::Escape && !panels.has_open_list;
    switch (panels.dialog) {
    case OpenDialog::File:
        press_in_browser(press, panels, chosen);
        break;
    case OpenDialog::Picture:
        if (accepts) {
            take_picture(switcher.current(), panels);
        } else if (cancels) {
            panels.dialog = OpenDialog::None;
        }
        break;
    case OpenDialog::Export:
        if (accepts && switcher.plant() != nullptr) {
            export_shown(*switcher.plant(), panels);
        } else if (cancels) {
            panels.dialog = OpenDialog::None;
        }
        break;
    case OpenDialog::Sheet:
        if (cancels) {
            close_sheet(panels);
        }
        break;
    case OpenDialog::Unsaved:
        if (accepts || cancels) {
            answer_unsaved(accepts ? UnsavedAnswer::Save : UnsavedAnswer::Cancel, switcher, panels);
        }
        break;
    case OpenDialog::None:
        if (press.key == Key::F1) {
            panels.help = !panels.help;
        } else if (press.key == Key::Escape) {
            panels.help = false;
        } else if (accepts) {
            chosen = panels.start.selected_file();
        } else {
            const auto axis = [&press](Key less, Key more) {
                return static_cast<int>(press.key == more) - static_cast<int>(press.key == less);
            };
            const int right = axis(Key::Left, Key::Right);
            const int down = axis(Key::Up, Key::Down);
            if (right != 0 || down != 0) {
                panels.start.move(right, down);
            }
        }
        break;
    }
}

void Controls::press_in_browser(const KeyPress& press, PanelState& panels, std::string& chosen) {
    FileBrowser& browser = panels.browser;
    constexpr int kPage = 10; // entries
    switch (press.key) {
    case Key::Escape:
        panels.dialog = OpenDialog::None;
        break;
    case Key::Enter:
        chosen = browser.accept();
        break;
    case Key::Up:
        press.alt ? browser.go_up() : browser.move(-1);
        break;
    case Key::Down:
        browser.move(1);
        break;
    case Key::PageUp:
        browser.move(-kPage);
        break;
    case Key::PageDown:
        browser.move(kPage);
        break;
    case Key::Backspace:
        browser.erase_character();
        break;
    case Key::Tab:
        browser.complete();
        break;
    case Key::Home:
        if (press.alt) {
            browser.go_home();
        }
        break;
    default:
        break;
    }
}

void Controls::apply(
    const WindowInput& input, double seconds, float height, PlantView& view, PanelState& panels) {
    for (const KeyPress& one : input.presses) {
        press(one, view, panels);
    }
    Camera& camera = view.settings.camera;
    is_moving_ = panels.flies;
    if (panels.flies) {
        fly(input, static_cast<float>(seconds), height, camera);
        return;
    }
    orbit(camera, input.left_drag, height);
    pan(camera, input.right_drag + input.middle_drag, height);
    zoom(camera, input.wheel);
}

void Controls::apply(const WindowInput& input,
                     double seconds,
                     const PixelArea& area,
                     ForestView& view,
                     PanelState& panels) {
    for (const KeyPress& one : input.presses) {
        press(one, view, panels);
    }
    Camera& camera = view.settings.camera;
    const auto height = static_cast<float>(area.height);
    is_moving_ = panels.flies;
    if (panels.flies) {
        fly(input, static_cast<float>(seconds), height, camera);
        return;
    }
    zoom(camera, input.wheel);
    if (view.settings.tool == PaintTool::None) {
        orbit(camera, input.left_drag, height);
        pan(camera, input.right_drag + input.middle_drag, height);
        return;
    }
    orbit(camera, input.right_drag, height);
    pan(camera, input.middle_drag, height);
    use_tool(input, area, view);
}

void Controls::click(const WindowInput& input, const PixelArea& area, View& view) {
    constexpr float kMaxClickMotion = 3.0F; // pixels of motion that still count as a click
    for (const PointerEvent& event : input.pointer_events) {
        if (event.kind == PointerEvent::Kind::Press) {
            pressed_ = event.place;
            continue;
        }
        if (pressed_ && glm::distance(*pressed_, event.place) > kMaxClickMotion) {
            pressed_.reset(); // dragged too far for a click
        }
        if (event.kind == PointerEvent::Kind::Release && pressed_) {
            // Picture and window have the same upper edge.
            const glm::vec2 place = *pressed_ - glm::vec2(static_cast<float>(area.x), 0.0F);
            if (place.x >= 0.0F && place.y >= 0.0F) {
                view.pick(
                    {static_cast<std::uint32_t>(place.x), static_cast<std::uint32_t>(place.y)});
            }
            pressed_.reset();
        }
    }
}

namespace {

template <typename ObstacleView>
bool move_obstacle_of(ObstacleView& view, const WindowInput& input, const PixelArea& area) {
    bool holds = view.has_grabbed();
    for (const PointerEvent& event : input.pointer_events) {
        const glm::vec2 place = place_in_picture(event.place, area);
        if (event.kind == PointerEvent::Kind::Press) {
            view.release_obstacle(); // the button may have been released over a dialog
            holds = event.shift && view.grab_obstacle(place);
            continue;
        }
        view.drag_obstacle(place);
        if (event.kind == PointerEvent::Kind::Release) {
            view.release_obstacle();
        }
    }
    return holds;
}

} // namespace

bool Controls::move_obstacle(const WindowInput& input, const PixelArea& area, PlantView& view) {
    return move_obstacle_of(view, input, area);
}

bool Controls::move_obstacle(const WindowInput& input, const PixelArea& area, ForestView& view) {
    return move_obstacle_of(view, input, area);
}

void Controls::use_tool(const WindowInput& input, const PixelArea& area, ForestView& view) {
    const auto place = [&area](const glm::vec2& pixels) { return place_in_picture(pixels, area); };
    for (const PointerEvent& event : input.pointer_events) {
        if (event.kind == PointerEvent::Kind::Release) {
            view.end_stroke();
        } else {
            view.apply_tool(place(event.place), event.kind == PointerEvent::Kind::Press,
                            event.shift);
        }
    }
    if (input.over_picture && (input.has_events || !input.pointer_events.empty())) {
        view.hover(place(input.mouse));
    }
}

void Controls::fly(const WindowInput& input, float seconds, float height, Camera& camera) {
    const float turn = std::numbers::pi_v<float> / (2.0F * std::max(height, 1.0F));
    camera = turned(camera, turn * input.motion.x, -turn * input.motion.y);
    constexpr float kSpeedPerNotch = 1.2F;
    constexpr float kFaster = 4.0F;
    speed_ *= std::pow(kSpeedPerNotch, input.wheel);
    // At speed 1 the camera reaches the target in two seconds.
    const float metres = 0.5F * speed_ * (is_held(input, Key::Shift) ? kFaster : 1.0F) * seconds *
                         glm::distance(camera.eye, camera.target);
    camera =
        moved(camera, metres * held_axis(input, Key::D, Key::A),
              metres * held_axis(input, Key::E, Key::Q), metres * held_axis(input, Key::W, Key::S));
}

bool Controls::press_common(const KeyPress& press, View& view, PanelState& panels) {
    if (press.alt) {
        return true; // press_with_alt() has handled it
    }
    if (const std::optional<std::size_t> index = bookmark_of(press.key);
        press.control && index && !view.path().empty()) {
        panels.bookmarks.show(panels.state_folder, view.path());
        panels.bookmarks.set(*index, view.camera(), view.console());
        view.set_note(fmt::format("Camera {0} is set: Alt+{0} goes to it", *index + 1));
        return true;
    }
    if (press.control) {
        switch (press.key) {
        case Key::Q:
            panels.wants_to_quit = true;
            return true;
        case Key::O:
            show_open_dialog(view, panels);
            return true;
        case Key::E:
            open_in_editor(panels.source.place_to_open(view), view, panels);
            return true;
        case Key::C:
            if (panels.source.has_focus) {
                ImGui::SetClipboardText(panels.source.selected_text().c_str());
            }
            return true;
        case Key::Z:
            press.shift ? view.redo() : view.undo();
            return true;
        case Key::Y:
            view.redo();
            return true;
        default:
            return false;
        }
    }
    switch (press.key) {
    case Key::F6:
        panels.focus_move = FocusMove::Next;
        return true;
    case Key::Tab:
        panels.flies = !panels.flies;
        return true;
    case Key::Escape:
        if (press.in_control) {
            return true; // the key ends the use of the control
        }
        if ((panels.focus.has_keys() || panels.source.has_focus) && !panels.flies) {
            panels.focus_move = FocusMove::Picture;
            return true;
        }
        if (view.making()) {
            view.cancel_making();
            return true;
        }
        if (panels.film.is_busy()) {
            panels.film.cancel();
            view.set_note("Cancelled: no film is written");
            return true;
        }
        panels.help = false;
        panels.flies = false;
        view.forget_picked();
        return false; // the view handles Escape too
    case Key::F1:
        panels.help = !panels.help;
        return true;
    case Key::F8:
        panels.source.look.is_shown = true;
        panels.source.go_to_message(press.shift ? -1 : 1, view);
        return true;
    default:
        break;
    }
    if (panels.source.look.is_shown && panels.source.has_focus && panels.source.press(press)) {
        return true;
    }
    if (panels.flies) {
        return false; // letters move the camera
    }
    switch (press.key) {
    case Key::F:
        view.frame_all();
        return true;
    case Key::One:
        view.show_from(StandardView::Front);
        return true;
    case Key::Two:
        view.show_from(StandardView::Side);
        return true;
    case Key::Three:
        view.show_from(StandardView::Top);
        return true;
    case Key::C:
        ImGui::SetClipboardText(to_text(view.camera()).c_str());
        return true;
    case Key::R:
        view.reload();
        return true;
    case Key::P:
        if (press.shift) {
            view.write_screenshot();
        } else {
            show_picture_dialog(view, panels);
        }
        return true;
    case Key::U:
        panels.source.look.is_shown = !panels.source.look.is_shown;
        return true;
    case Key::H:
        panels.panels = !panels.panels;
        return true;
    case Key::A:
        panels.statistics = !panels.statistics;
        return true;
    case Key::M: {
        std::string messages = view.all_messages();
        panels.closed_messages =
            panels.closed_messages == messages ? std::string() : std::move(messages);
        return true;
    }
    default:
        return false;
    }
}

void Controls::press(const KeyPress& press, ForestView& view, PanelState& panels) {
    if (press_common(press, view, panels)) {
        return;
    }
    ForestViewSettings& settings = view.settings;
    if (press.control) {
        if (press.key == Key::S) {
            view.save();
        } else if (press.key == Key::Enter) {
            panels.source.apply_here(view, nullptr);
        }
        return;
    }
    const auto take = [&settings](PaintTool tool) {
        settings.tool = settings.tool == tool ? PaintTool::None : tool;
    };
    constexpr float kBrushStep = 1.25F;
    const auto step = [&](bool more) {
        if (settings.tool != PaintTool::None) {
            settings.brush.radius = std::clamp(
                settings.brush.radius * (more ? kBrushStep : 1.0F / kBrushStep), 0.1F, kMaxBrush);
        } else if (view.default_years() != 0 && (more || view.years() > 0)) {
            view.set_years(more ? view.years() + 1 : view.years() - 1);
        }
    };
    switch (press.key) {
    case Key::Escape:
        settings.tool = PaintTool::None;
        return;
    case Key::Space:
        view.play_or_pause();
        return;
    case Key::PageUp:
        step(true);
        return;
    case Key::PageDown:
        step(false);
        return;
    default:
        break;
    }
    if (panels.flies) {
        return;
    }
    switch (press.key) {
    case Key::B:
        take(PaintTool::Brush);
        break;
    case Key::O:
        take(PaintTool::OneTree);
        break;
    case Key::X:
        take(PaintTool::Eraser);
        break;
    case Key::W:
        settings.wireframe = !settings.wireframe;
        break;
    case Key::S:
        settings.shadows = !settings.shadows;
        break;
    case Key::V:
        settings.figure = !settings.figure;
        break;
    case Key::L:
        settings.colours = settings.colours == BranchColours::Natural ? BranchColours::Id
                           : settings.colours == BranchColours::Id    ? BranchColours::Age
                           : settings.colours == BranchColours::Age   ? BranchColours::Hero
                                                                      : BranchColours::Natural;
        break;
    case Key::N:
        next_forest_key(view);
        break;
    default:
        break;
    }
}

void Controls::press(const KeyPress& press, PlantView& view, PanelState& panels) {
    if (press_common(press, view, panels)) {
        return;
    }
    if (press.control) {
        if (press.key == Key::S) {
            view.save();
        } else if (press.key == Key::Enter) {
            panels.source.apply_here(view, &view);
        }
        return;
    }
    PlantViewSettings& settings = view.settings;
    switch (press.key) {
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
        return;
    }
    switch (press.key) {
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
    case Key::V:
        settings.figure = !settings.figure;
        break;
    case Key::G:
        settings.ground = !settings.ground;
        break;
    case Key::O:
        settings.senses.obstacles = !settings.senses.obstacles;
        break;
    case Key::Y:
        settings.senses.light = !settings.senses.light;
        break;
    case Key::X:
        settings.senses.markers = !settings.senses.markers;
        break;
    case Key::D:
        settings.senses.directions = !settings.senses.directions;
        break;
    case Key::B:
        settings.simulates = !settings.simulates;
        break;
    case Key::N:
        next_seed(view);
        break;
    case Key::K:
        show_sheet(view, panels);
        break;
    case Key::E:
        show_export_dialog(panels);
        break;
    case Key::T:
        view.trace(view.shows_trace() ? scope_after(view.trace_scope()) : view.trace_scope());
        break;
    default:
        break;
    }
}

} // namespace lsys::view
