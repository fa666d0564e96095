// SPDX-License-Identifier: MIT
#include "viewer/app/panels.h"

#include "viewer/app/export_dialog.h"
#include "viewer/app/forest_panel.h"
#include "viewer/app/picture_dialog.h"
#include "viewer/app/plant_panel.h"
#include "viewer/app/recent_files.h"
#include "viewer/app/unsaved_dialog.h"
#include "viewer/app/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <imgui.h>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lsys::view {

namespace {

constexpr float kPanelWidth = 340.0F;
constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
/// Flags of an overlay with controls, to which F6 can give the keyboard.
constexpr ImGuiWindowFlags kUsedOverlay = kOverlay & ~ImGuiWindowFlags_NoNav;

/// The part of the window beside the panel.
struct Area {
    ImVec2 low;
    ImVec2 high;
};

Area picture_area(const PanelState& panels, float scale) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float left = panels.panels ? std::min(panel_width(scale), size.x) : 0.0F;
    return {{left, 0.0F}, {size.x - source_width(panels, size.x, scale), size.y}};
}

constexpr int kNameWidth = 12; // width in characters of the names of statistics

void time_row(const char* name, double seconds) {
    line(fmt::format("{:<{}}{:>9.1f} ms", name, kNameWidth, kMillisecondsPerSecond * seconds));
}

void count_row(const char* name, std::uint64_t count) {
    line(fmt::format("{:<{}}{:>9}", name, kNameWidth, grouped(count)));
}

void draw_plant_times(const PlantView& view) {
    const PlantViewStats& stats = view.stats();
    if (const PlantDocument* const document = view.document()) {
        time_row("Compile", document->load_seconds);
        time_row("Derive", document->plant.derive_seconds);
        time_row("Turtle", document->plant.draw_seconds);
        time_row("Mesh", document->mesh_seconds);
        time_row("Upload", stats.upload_seconds);
        time_row("Reload", stats.swap_seconds);
        time_row("First frame", stats.shown_seconds);
        if (view.settings.simulates) {
            time_row("Simulate", stats.bend_seconds);
        }
        time_row("Frame", stats.draw_seconds);
    }
    count_row("Draw calls", stats.drawn.draws);
    count_row("Triangles", stats.drawn.triangles);
}

/// Draws which processor chooses the visible trees, and how long it takes.
void draw_culling(const ForestFrameStats& frame) {
    line(frame.is_culled_on_device ? "Culling: GPU" : "Culling: CPU");
    time_row("  CPU", 1e-3 * frame.cull_cpu_milliseconds);
    if (frame.is_culled_on_device) {
        time_row("  GPU", 1e-3 * frame.cull_gpu_milliseconds);
    }
}

void draw_forest_times(const ForestView& view) {
    const ForestViewStats& stats = view.stats();
    if (const ForestDocument* const document = view.document()) {
        time_row("Heroes", document->grown.cache_seconds);
        time_row("Placement", document->grown.place_seconds);
        time_row("Mesh", document->mesh_seconds);
        time_row("Upload", stats.upload_seconds);
        time_row("Reload", stats.swap_seconds);
        time_row("First frame", stats.shown_seconds);
        time_row("Frame", stats.draw_seconds);
        const ForestFrameStats& frame = view.renderer().forest_stats();
        std::uint64_t near = 0;
        for (const std::uint32_t trees : frame.trees_of_level) {
            near += trees;
        }
        count_row("Full trees", near);
        count_row("Impostors", frame.far_trees);
        count_row("Clusters", frame.clusters);
        count_row("  trees", frame.clustered_trees);
        draw_culling(frame);
        if (!view.has_all_impostors()) {
            line("Baking impostors");
        }
    }
    count_row("Draw calls", stats.drawn.draws);
    count_row("Triangles", stats.drawn.triangles + view.renderer().forest_stats().device_triangles);
}

void draw_statistics(ViewSwitcher& switcher, const Area& area) {
    ImGui::SetNextWindowPos({area.high.x - 8.0F, 8.0F}, ImGuiCond_Always, {1.0F, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.55F);
    if (ImGui::Begin("Statistics", nullptr, kOverlay | ImGuiWindowFlags_AlwaysAutoResize)) {
        if (const ForestView* const forest = switcher.forest()) {
            draw_forest_times(*forest);
        } else if (const PlantView* const plant = switcher.plant()) {
            draw_plant_times(*plant);
        }
        const Renderer& renderer = switcher.current().renderer();
        line(fmt::format("Quality: {}", name_of(renderer.quality())));
        time_row("Frame CPU", 1e-3 * renderer.frame_times().cpu);
        time_row("Frame GPU", 1e-3 * renderer.frame_times().gpu);
        count_row("GL objects", renderer.live_objects());
        count_row("GL errors", renderer.errors().size());
    }
    ImGui::End();
}

const ImVec4 kErrorColour{1.0F, 0.72F, 0.66F, 1.0F};
const ImVec4 kWarningColour{1.0F, 0.93F, 0.7F, 1.0F};

/// Converts a bright text colour for light panels: darker and more saturated.
ImVec4 on_panel(const ImVec4& colour) {
    if (ImGui::GetStyle().Colors[ImGuiCol_WindowBg].x < 0.5F) {
        return colour;
    }
    const auto darker = [](float x) { return 0.7F * x * x * x; };
    return {darker(colour.x), darker(colour.y), darker(colour.z), colour.w};
}

/// Draws a message; a click shows or hides its source lines. `is_open`: whether they are shown at
/// first.
void draw_message(
    const ShownMessage& message, int number, bool is_open, View& view, PanelState& panels) {
    ImGui::PushID(number);
    ImGui::PushStyleColor(
        ImGuiCol_Text,
        on_panel(message.severity == Severity::Error ? kErrorColour : kWarningColour));
    if (message.text.empty()) {
        line(message.head);
    } else {
        ImGui::SetNextItemOpen(is_open, ImGuiCond_Appearing);
        if (ImGui::TreeNodeEx("message", ImGuiTreeNodeFlags_SpanFullWidth, "%s",
                              message.head.c_str())) {
            line(message.text);
            if (message.place) {
                if (ImGui::SmallButton("Show in the source")) {
                    panels.source.look.is_shown = true;
                    panels.source.show(*message.place);
                }
                ImGui::SameLine();
                if (ImGui::SmallButton("Open in the editor")) {
                    open_in_editor(*message.place, view, panels);
                }
            }
            ImGui::TreePop();
        }
    }
    ImGui::PopStyleColor();
    ImGui::PopID();
}

/// Draws the messages of the grammar or scene, of shaders and of OpenGL, unless the user has closed
/// them. Returns the upper edge of their panel or, without messages, the lower edge of the area.
float draw_messages(View& view, PanelState& panels, const Area& area) {
    if (!panels.closed_messages.empty()) {
        if (panels.closed_messages == view.all_messages()) {
            return area.high.y;
        }
        panels.closed_messages.clear();
    }
    std::vector<ShownMessage> errors;
    if (!view.shader_message().empty()) {
        errors.push_back({Severity::Error, "error: " + view.shader_message(), {}});
    }
    for (const std::string& error : view.renderer().errors()) {
        errors.push_back({Severity::Error, "error: OpenGL: " + error, {}});
    }
    float top = area.high.y;
    if (view.entries().empty() && errors.empty()) {
        return top;
    }
    const float width = std::max(area.high.x - area.low.x - 16.0F, 100.0F);
    ImGui::SetNextWindowPos({area.low.x + 8.0F, area.high.y - 8.0F}, ImGuiCond_Always,
                            {0.0F, 1.0F});
    ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, 0.5F * area.high.y});
    ImGui::SetNextWindowBgAlpha(0.85F);
    constexpr ImGuiWindowFlags kFlags = (kUsedOverlay & ~ImGuiWindowFlags_NoScrollbar) |
                                        ImGuiWindowFlags_HorizontalScrollbar |
                                        ImGuiWindowFlags_AlwaysAutoResize;
    if (ImGui::Begin("Messages", nullptr, kFlags)) {
        if (ImGui::SmallButton("Close (M)")) {
            panels.closed_messages = view.all_messages();
        }
        int number = 0;
        for (const ShownMessage& message : view.entries()) {
            // Notes may stay on screen for long, so at first only their first line is shown.
            const bool is_note = message.severity == Severity::Note;
            const bool is_open = number == 0 && !is_note && !panels.source.look.is_shown;
            draw_message(message, number, is_open, view, panels);
            ++number;
        }
        for (const ShownMessage& message : errors) {
            draw_message(message, number++, false, view, panels);
        }
        top = ImGui::GetWindowPos().y;
    }
    ImGui::End();
    return top;
}

ImVec4 colour_of(TextColour colour) {
    switch (colour) {
    case TextColour::Red:
        return {1.0F, 0.62F, 0.55F, 1.0F};
    case TextColour::Green:
        return {0.6F, 1.0F, 0.6F, 1.0F};
    case TextColour::Yellow:
        return {1.0F, 0.9F, 0.5F, 1.0F};
    case TextColour::Blue:
        return {0.55F, 0.65F, 0.85F, 1.0F};
    case TextColour::Cyan:
        return {0.55F, 0.95F, 1.0F, 1.0F};
    case TextColour::Plain:
    case TextColour::Bold:
        break;
    }
    return {0.92F, 0.92F, 0.92F, 1.0F};
}

/// Whether a line of a trace is a line of the grammar: "  7 | #grow ...".
bool is_source_line(const TextLine& text) {
    const std::string& gutter = text.empty() ? std::string() : text.front().text;
    const std::size_t digit = gutter.find_first_not_of(' ');
    return gutter.ends_with(" |") && digit != std::string::npos && gutter[digit] != '|';
}

constexpr float kTraceSpacing = 2.0F; // between the lines of a trace, pixels

void draw_trace_line(const TextLine& text) {
    if (text.empty()) {
        ImGui::NewLine();
        return;
    }
    if (is_source_line(text)) {
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const ImVec2 opposite{corner.x + ImGui::GetWindowWidth() + ImGui::GetScrollMaxX(),
                              corner.y + ImGui::GetTextLineHeight() + kTraceSpacing};
        constexpr ImU32 kSourceBackground = IM_COL32(255, 255, 255, 22);
        ImGui::GetWindowDrawList()->AddRectFilled(corner, opposite, kSourceBackground);
    }
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (i != 0) {
            ImGui::SameLine(0.0F, 0.0F);
        }
        ImGui::PushStyleColor(ImGuiCol_Text, on_panel(colour_of(text[i].colour)));
        line(text[i].text);
        ImGui::PopStyleColor();
    }
}

/// Width of the area, in pixels at the default text size, below which a description of a pick hides
/// the statistics, and the buttons of a trace need two rows.
constexpr float kNarrowArea = 640.0F;

void draw_trace_buttons(View& view, PanelState& panels, bool is_narrow) {
    const auto choice = [&view](const char* name, TraceScope scope, const char* help) {
        if (ImGui::RadioButton(name, view.trace_scope() == scope)) {
            view.trace(scope);
        }
        draw_tooltip(help);
        ImGui::SameLine();
    };
    choice("Why written", TraceScope::Written, "The step that wrote the module");
    choice("Next step", TraceScope::Next, "The step that rewrites the module");
    choice("Back to the axiom", TraceScope::Back, "Every step from the axiom to the module");
    if (is_narrow) {
        ImGui::NewLine();
    }
    if (ImGui::Button("Copy")) {
        std::string text;
        for (const TextLine& each : view.traced()) {
            text += plain_text(each) + '\n';
        }
        ImGui::SetClipboardText(text.c_str());
    }
    ImGui::SameLine();
    if (view.picked().place) {
        if (ImGui::Button("Editor")) {
            open_in_editor(*view.picked().place, view, panels);
        }
        draw_tooltip("Open the production in the editor of $VISUAL, or in VS Code");
        ImGui::SameLine();
    }
    if (ImGui::Button("Close")) {
        view.forget_trace();
    }
}

/// Draws the trace of the module picked last, with its lower edge at `bottom`.
void draw_trace(View& view, PanelState& panels, const Area& area, float bottom) {
    if (!view.shows_trace() || !view.picked().module) {
        return;
    }
    const float width = std::max(area.high.x - area.low.x - 16.0F, 100.0F);
    ImGui::SetNextWindowPos({area.low.x + 8.0F, bottom - 8.0F}, ImGuiCond_Always, {0.0F, 1.0F});
    ImGui::SetNextWindowBgAlpha(0.92F);
    if (ImGui::Begin("Trace", nullptr, kUsedOverlay | ImGuiWindowFlags_AlwaysAutoResize)) {
        draw_trace_buttons(view, panels, width < scaled(kNarrowArea));
        const ImGuiStyle& style = ImGui::GetStyle();
        const float text_height =
            static_cast<float>(std::max<std::size_t>(view.traced().size(), 1)) *
                (ImGui::GetTextLineHeight() + kTraceSpacing) +
            style.ScrollbarSize;
        const ImVec2 size{width - 2.0F * style.WindowPadding.x,
                          std::min(text_height, 0.45F * area.high.y)};
        // Each trace has its own scroll position.
        const std::string id =
            fmt::format("Text {} {} {}", static_cast<int>(view.trace_scope()),
                        view.picked().module->generation, view.picked().module->position);
        if (ImGui::BeginChild(id.c_str(), size, false, ImGuiWindowFlags_HorizontalScrollbar)) {
            ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0F, kTraceSpacing});
            if (view.traced().empty()) {
                ImGui::TextDisabled("deriving again ...");
            }
            for (const TextLine& each : view.traced()) {
                draw_trace_line(each);
            }
            ImGui::PopStyleVar();
        }
        ImGui::EndChild();
    }
    ImGui::End();
}

void draw_help(std::span<const KeyHelp> keys, PanelState& panels, const Area& area) {
    ImGui::SetNextWindowPos({0.5F * (area.low.x + area.high.x), 0.5F * area.high.y},
                            ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, ImGui::GetIO().DisplaySize);
    if (ImGui::Begin("Keys", &panels.help,
                     ImGuiWindowFlags_HorizontalScrollbar | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoFocusOnAppearing)) {
        for (const KeyHelp& help : keys) {
            line(fmt::format("{:<23} {}", help.keys, help.what));
        }
    }
    ImGui::End();
}

/// Wraps the text of an overlay so that the overlay stays within the area.
void wrap_within(const Area& area) {
    constexpr float kMargins = 32.0F; // pixels, on both sides
    ImGui::PushTextWrapPos(std::max(area.high.x - area.low.x - kMargins, 100.0F));
}

/// Draws the lines of the description picked last, in the corner opposite to the statistics, below
/// a note.
void draw_picked(const View& view, const Area& area) {
    if (view.picked().lines.empty()) {
        return;
    }
    ImGui::SetNextWindowPos({area.low.x + 8.0F, scaled(48.0F)});
    ImGui::SetNextWindowBgAlpha(0.7F);
    if (ImGui::Begin("Picked", nullptr,
                     kOverlay | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs)) {
        wrap_within(area);
        for (const std::string& each : view.picked().lines) {
            line(each);
        }
        if (!view.picked().hint.empty()) {
            ImGui::TextDisabled("%s", view.picked().hint.c_str());
        }
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

void draw_hint(ViewSwitcher& switcher, const PanelState& panels, const Area& area) {
    std::string text = switcher.current().note();
    const ForestView* const forest = switcher.forest();
    if (panels.flies) {
        text = "Flying: Esc or Tab to stop";
    } else if (!panels.panels && text.empty()) {
        text = "H: panels, F1: keys";
    } else if (text.empty() && forest != nullptr && forest->document() != nullptr &&
               !forest->has_all_impostors()) {
        text = "Drawing the pictures of distant trees ...";
    }
    if (text.empty()) {
        return;
    }
    ImGui::SetNextWindowPos({area.low.x + 8.0F, 8.0F});
    ImGui::SetNextWindowBgAlpha(0.55F);
    if (ImGui::Begin("Hint", nullptr,
                     kOverlay | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs)) {
        wrap_within(area);
        line(text);
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

/// Draws the text about what is being made, with a button that cancels it.
void draw_making(View& view, PanelState& panels, const Area& area) {
    const std::optional<MakingState> of_view = view.making();
    const std::optional<MakingState> making = of_view ? of_view : panels.film.state();
    if (!making) {
        return;
    }
    ImGui::SetNextWindowPos({0.5F * (area.low.x + area.high.x), scaled(48.0F)}, ImGuiCond_Always,
                            {0.5F, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.85F);
    if (ImGui::Begin("Making", nullptr, kUsedOverlay | ImGuiWindowFlags_AlwaysAutoResize)) {
        line(making->text);
        if (making->fraction) {
            ImGui::ProgressBar(*making->fraction, {kPanelWidth, 0.0F});
        }
        if (ImGui::Button("Cancel (Esc)")) {
            if (of_view) {
                view.cancel_making();
            } else {
                panels.film.cancel();
                view.set_note("Cancelled: no film is written");
            }
        }
    }
    ImGui::End();
}

/// Draws the camera bookmarks of the file, with their names.
void draw_bookmarks(View& view, PanelState& panels) {
    panels.bookmarks.show(panels.state_folder, view.path());
    if (!ImGui::CollapsingHeader("Cameras")) {
        return;
    }
    bool has_any = false;
    for (std::size_t i = 0; i < kBookmarks; ++i) {
        const std::optional<CameraBookmark>& bookmark = panels.bookmarks.all().at(i);
        if (!bookmark) {
            continue;
        }
        has_any = true;
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Button(fmt::format("{}", i + 1).c_str())) {
            view.camera() = bookmark->camera;
        }
        draw_tooltip("Go to this camera (Alt and the number)");
        ImGui::SameLine();
        std::string name = bookmark->name;
        edit_text("##name", name);
        ImGui::SameLine();
        if (ImGui::SmallButton("x")) {
            panels.bookmarks.remove(i, view.console());
        } else if (name != bookmark->name) {
            panels.bookmarks.rename(i, name, view.console());
        }
        ImGui::PopID();
    }
    if (!has_any) {
        ImGui::TextDisabled("Ctrl+1 to 9 keeps a camera");
    }
}

void draw_window_look(PanelState& panels) {
    if (ImGui::CollapsingHeader("Window")) {
        WindowLook& look = panels.look;
        ImGui::SetNextItemWidth(-label_width());
        ImGui::SliderFloat("Text size", &look.text_size, kMinTextSize, kMaxTextSize, "x%.2f",
                           ImGuiSliderFlags_AlwaysClamp);
        ImGui::Checkbox("Light panels", &look.is_light);
        ImGui::SameLine();
        ImGui::Checkbox("Statistics", &panels.statistics);
        draw_tooltip("Times and numbers of the last picture (A)");
    }
}

constexpr ImGuiWindowFlags kSide = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                   ImGuiWindowFlags_NoTitleBar;

void draw_edit_buttons(ViewSwitcher& switcher) {
    View& view = switcher.current();
    if (ImGui::Button("Undo")) {
        view.undo();
    }
    draw_tooltip("Ctrl+Z");
    ImGui::SameLine();
    if (ImGui::Button("Redo")) {
        view.redo();
    }
    draw_tooltip("Ctrl+Y");
    ImGui::SameLine();
    const PlantView* const plant = switcher.plant();
    ImGui::BeginDisabled(plant != nullptr ? !plant->has_changed_values() : !view.is_unsaved());
    if (ImGui::Button("Write to file")) {
        view.save();
    }
    ImGui::EndDisabled();
    draw_tooltip(plant != nullptr
                     ? "Writes changed constants, settings and seed to the file (Ctrl+S)"
                     : "Writes painted and erased trees and the season to the scene (Ctrl+S)");
}

void draw_output_buttons(ViewSwitcher& switcher, PanelState& panels) {
    if (ImGui::Button("Open")) {
        show_open_dialog(switcher.current(), panels);
    }
    draw_tooltip("Opens a file (Ctrl+O)");
    ImGui::SameLine();
    if (ImGui::Button("Picture")) {
        show_picture_dialog(switcher.current(), panels);
    }
    draw_tooltip("Writes a picture or a film (P); Shift+P writes NAME-1.png at once");
    if (PlantView* const plant = switcher.plant()) {
        ImGui::SameLine();
        if (ImGui::Button("Export")) {
            show_export_dialog(panels);
        }
        draw_tooltip("Writes a file for another program (E)");
        ImGui::SameLine();
        if (ImGui::Button("Sheet")) {
            show_sheet(*plant, panels);
        }
        draw_tooltip("Shows nine seeds, or values of constants, to choose from (K)");
    }
    ImGui::SameLine();
    if (ImGui::Button("Keys")) {
        panels.help = !panels.help;
    }
    draw_tooltip("Lists the keys (F1)");
}

void draw_view_buttons(View& view, SourcePane& source) {
    if (ImGui::Button("Frame all")) {
        view.frame_all();
    }
    draw_tooltip("Shows everything (F)");
    const auto button = [&view](const char* name, const char* help, StandardView standard) {
        ImGui::SameLine();
        if (ImGui::Button(name)) {
            view.show_from(standard);
        }
        draw_tooltip(help);
    };
    button("Front", "Looks from +Z (1)", StandardView::Front);
    button("Side", "Looks from the side (2)", StandardView::Side);
    button("Top", "Looks from above (3)", StandardView::Top);
    ImGui::SameLine();
    if (ImGui::Button("Source")) {
        source.look.is_shown = !source.look.is_shown;
    }
    draw_tooltip("Shows the text of the grammar with its messages (U)");
}

/// Draws the buttons below the panel, which are always visible. Returns the path of the file to
/// open; empty: none.
std::string draw_buttons(ViewSwitcher& switcher, PanelState& panels) {
    std::string wanted;
    draw_edit_buttons(switcher);
    if (switcher.plant() != nullptr && !switcher.last_scene().empty()) {
        ImGui::SameLine();
        if (ImGui::Button("Back to forest")) {
            wanted = switcher.last_scene();
        }
    }
    draw_output_buttons(switcher, panels);
    draw_view_buttons(switcher.current(), panels.source);
    return wanted;
}

/// Draws the panel on the left. Returns the path of the file to open; empty: none.
std::string draw_side_panel(ViewSwitcher& switcher, PanelState& panels, const Area& area) {
    std::string wanted;
    constexpr float kRows = 3.0F; // number of rows of buttons
    const ImGuiStyle& style = ImGui::GetStyle();
    const float below = kRows * ImGui::GetFrameHeightWithSpacing() - style.ItemSpacing.y +
                        2.0F * style.WindowPadding.y;
    const float height = std::max(area.high.y - below, 1.0F);
    ImGui::SetNextWindowPos({0.0F, 0.0F});
    ImGui::SetNextWindowSize({area.low.x, height});
    if (ImGui::Begin("Panel", nullptr, kSide)) {
        if (ForestView* const forest = switcher.forest()) {
            wanted = draw_forest_panel(*forest);
        } else if (PlantView* const plant = switcher.plant()) {
            draw_plant_panel(*plant);
        }
        draw_bookmarks(switcher.current(), panels);
        draw_window_look(panels);
    }
    ImGui::End();
    ImGui::SetNextWindowPos({0.0F, height});
    ImGui::SetNextWindowSize({area.low.x, below});
    if (ImGui::Begin("Buttons", nullptr, kSide | ImGuiWindowFlags_NoScrollbar)) {
        if (std::string file = draw_buttons(switcher, panels); !file.empty()) {
            wanted = std::move(file);
        }
    }
    ImGui::End();
    return wanted;
}

/// Draws the panel and overlays of a plant or forest. Returns the path of the file to open; empty:
/// none.
std::string
draw_view_panels(ViewSwitcher& switcher, PanelState& panels, const Area& area, float scale) {
    std::string wanted;
    if (panels.panels) {
        wanted = draw_side_panel(switcher, panels, area);
    }
    // In a narrow area the text about the last pick would lie over the statistics.
    const bool has_room = area.high.x - area.low.x >= scaled(kNarrowArea) ||
                          switcher.current().picked().lines.empty();
    if (panels.statistics && has_room) {
        draw_statistics(switcher, area);
    }
    if (panels.source.look.is_shown) {
        const float width = ImGui::GetIO().DisplaySize.x - area.high.x;
        const SourceActions actions =
            draw_source_pane(panels.source, switcher.current(), switcher.plant(), width, scale);
        if (actions.opens) {
            open_in_editor(*actions.opens, switcher.current(), panels);
        }
        panels.source.look.is_shown = !actions.closes;
    }
    const float bottom = draw_messages(switcher.current(), panels, area);
    draw_hint(switcher, panels, area);
    draw_picked(switcher.current(), area);
    draw_trace(switcher.current(), panels, area, bottom);
    draw_making(switcher.current(), panels, area);
    if (panels.help) {
        draw_help(switcher.forest() != nullptr ? std::span<const KeyHelp>(kForestKeys)
                                               : std::span<const KeyHelp>(kPlantKeys),
                  panels, area);
    }
    return wanted;
}

void draw_sheet(ViewSwitcher& switcher, PanelState& panels) {
    PlantView* const plant = switcher.plant();
    if (plant == nullptr) { // another file was dropped on the window
        close_sheet(panels);
        return;
    }
    for (const auto& [cell, picture] : panels.sheet.take()) {
        panels.sheet.images.at(cell) = panels.add_image ? panels.add_image(picture) : 0;
    }
    const SheetAction action = draw_contact_sheet(panels.sheet, *plant);
    if (action.chosen_cell) {
        take_from_sheet(*action.chosen_cell, *plant, panels);
    } else if (action.closes) {
        close_sheet(panels);
    } else if (action.varies) {
        show_sheet(*plant, panels);
    }
}

std::string draw_start(const View& view, PanelState& panels) {
    if (!panels.start.is_loaded) {
        panels.start.load(panels.state_folder, samples_folder());
    }
    bool wants_dialog = false;
    std::string wanted = draw_start_page(panels.start, panels.add_image, wants_dialog);
    if (wants_dialog) {
        show_open_dialog(view, panels);
    }
    if (panels.help) {
        draw_help(kStartKeys, panels, {{0.0F, 0.0F}, ImGui::GetIO().DisplaySize});
    }
    return wanted;
}

DialogKeys keys_of(OpenDialog dialog) {
    return dialog == OpenDialog::None   ? DialogKeys::NoDialog
           : dialog == OpenDialog::File ? DialogKeys::OfControls
                                        : DialogKeys::OfPanels;
}

/// Draws the open dialog, except the contact sheet. Returns the path of the file to open; empty:
/// none.
std::string draw_dialog(ViewSwitcher& switcher, PanelState& panels) {
    std::string wanted;
    bool is_open = true;
    switch (panels.dialog) {
    case OpenDialog::File:
        wanted = draw_open_dialog(panels.browser, is_open);
        is_open = is_open && wanted.empty();
        break;
    case OpenDialog::Picture:
        if (draw_picture_dialog(switcher.current(), panels.picture, is_open)) {
            take_picture(switcher.current(), panels);
        }
        break;
    case OpenDialog::Export:
        if (PlantView* const plant = switcher.plant(); plant == nullptr) {
            is_open = false; // another file was dropped on the window
        } else if (draw_export_dialog(plant->settings.output, is_open)) {
            export_shown(*plant, panels);
        }
        break;
    case OpenDialog::Unsaved:
        if (!switcher.leaving()) {
            is_open = false;
        } else if (const std::optional<UnsavedAnswer> answer =
                       draw_unsaved_dialog(switcher, panels)) {
            answer_unsaved(*answer, switcher, panels);
        }
        break;
    case OpenDialog::Sheet:
    case OpenDialog::None:
        break;
    }
    if (!is_open) {
        panels.dialog = OpenDialog::None;
    }
    return wanted;
}

} // namespace

float panel_width(float scale) {
    return kPanelWidth * scale;
}

float source_width(const PanelState& panels, float window_width, float scale) {
    if (!panels.source.look.is_shown) {
        return 0.0F;
    }
    const float left = panels.panels ? std::min(panel_width(scale), window_width) : 0.0F;
    constexpr float kMaxPart = 0.6F; // of the width that the other panel leaves
    return std::min(panels.source.look.width * scale, kMaxPart * (window_width - left));
}

bool is_control_held() {
    return ImGui::IsAnyItemActive();
}

void draw_panels(ViewSwitcher& switcher, PanelState& panels, float scale) {
    panels.focus.begin(keys_of(panels.dialog), std::exchange(panels.focus_move, FocusMove::None));
    if (panels.dialog == OpenDialog::Sheet) {
        draw_sheet(switcher, panels);
    } else {
        std::string wanted =
            switcher.current().path().empty()
                ? draw_start(switcher.current(), panels)
                : draw_view_panels(switcher, panels, picture_area(panels, scale), scale);
        if (std::string chosen = draw_dialog(switcher, panels); !chosen.empty()) {
            wanted = std::move(chosen);
        }
        if (!wanted.empty()) {
            switcher.open(wanted);
        }
        ask_about_unsaved(switcher, panels);
    }
    panels.focus.end(keys_of(panels.dialog));
    panels.has_open_list =
        ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

} // namespace lsys::view
