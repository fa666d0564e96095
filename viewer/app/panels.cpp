#include "viewer/app/panels.h"

#include "viewer/app/plant_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <imgui.h>
#include <string>

namespace lsys::view {

namespace {

constexpr float kPanelWidth = 340.0F;
constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

void line(const std::string& text) {
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
}

/// The part of the window beside the panel.
struct Area {
    ImVec2 low;
    ImVec2 high;
};

Area picture_area(const PanelState& panels, float scale) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float left = panels.panels ? std::min(panel_width(scale), size.x) : 0.0F;
    return {{left, 0.0F}, size};
}

void draw_statistics(const LiveView& view, const Area& area) {
    const LiveStats& stats = view.stats();
    ImGui::SetNextWindowPos({area.high.x - 8.0F, 8.0F}, ImGuiCond_Always, {1.0F, 0.0F});
    ImGui::SetNextWindowBgAlpha(0.55F);
    constexpr double kMilliseconds = 1e3;
    if (ImGui::Begin("Statistics", nullptr, kOverlay | ImGuiWindowFlags_AlwaysAutoResize)) {
        if (const PlantDocument* const document = view.document()) {
            const auto row = [](const char* name, double seconds) {
                line(fmt::format("{:<9}{:>8.1f} ms", name, kMilliseconds * seconds));
            };
            row("compile", document->load_seconds);
            row("derive", document->plant.derive_seconds);
            row("turtle", document->plant.draw_seconds);
            row("mesh", document->mesh_seconds);
            row("upload", stats.upload_seconds);
            row("swapped", stats.swap_seconds);
            row("seen", stats.shown_seconds);
            if (view.settings.bends) {
                row("bend", stats.bend_seconds);
            }
            row("picture", stats.draw_seconds);
        }
        line(fmt::format("{} draws, {} triangles", stats.drawn.draws, stats.drawn.triangles));
        line(fmt::format("{} objects, {} errors of OpenGL", view.renderer().live_objects(),
                         view.renderer().errors().size()));
    }
    ImGui::End();
}

/// What `lsc` says, as it is printed.
void draw_messages(const LiveView& view, const Area& area) {
    std::string text = view.messages();
    if (!view.shader_message().empty()) {
        text += "lsview: error: " + view.shader_message() + '\n';
    }
    for (const std::string& error : view.renderer().errors()) {
        text += "lsview: error: OpenGL: " + error + '\n';
    }
    if (text.empty()) {
        return;
    }
    const float width = std::max(area.high.x - area.low.x - 16.0F, 100.0F);
    const ImVec2 wanted = ImGui::CalcTextSize(text.data(), text.data() + text.size());
    const float bar = ImGui::GetStyle().ScrollbarSize + 2.0F * ImGui::GetStyle().WindowPadding.y;
    ImGui::SetNextWindowPos({area.low.x + 8.0F, area.high.y - 8.0F}, ImGuiCond_Always,
                            {0.0F, 1.0F});
    ImGui::SetNextWindowSize({width, std::min(wanted.y + bar, 0.5F * area.high.y)});
    ImGui::SetNextWindowBgAlpha(0.85F);
    constexpr ImGuiWindowFlags kFlags =
        (kOverlay & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_HorizontalScrollbar;
    const bool failed = view.failed() || !view.shader_message().empty();
    ImGui::PushStyleColor(ImGuiCol_Text, failed ? ImVec4(1.0F, 0.72F, 0.66F, 1.0F)
                                                : ImVec4(1.0F, 0.93F, 0.7F, 1.0F));
    if (ImGui::Begin("Messages", nullptr, kFlags)) {
        line(text);
    }
    ImGui::End();
    ImGui::PopStyleColor();
}

void draw_help(PanelState& panels, const Area& area) {
    ImGui::SetNextWindowPos({0.5F * (area.low.x + area.high.x), 0.5F * area.high.y},
                            ImGuiCond_Always, {0.5F, 0.5F});
    if (ImGui::Begin("Keys", &panels.help,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                         ImGuiWindowFlags_NoSavedSettings)) {
        for (const KeyHelp& help : kKeyHelp) {
            line(fmt::format("{:<12} {}", help.keys, help.what));
        }
    }
    ImGui::End();
}

void draw_hint(const LiveView& view, const PanelState& panels, const Area& area) {
    std::string text = view.note();
    if (panels.flies) {
        text = "flying: Esc or Tab ends it";
    } else if (!panels.panels && text.empty()) {
        text = "H shows the panels, F1 the keys";
    }
    if (text.empty()) {
        return;
    }
    ImGui::SetNextWindowPos({area.low.x + 8.0F, 8.0F});
    ImGui::SetNextWindowBgAlpha(0.55F);
    if (ImGui::Begin("Hint", nullptr,
                     kOverlay | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs)) {
        line(text);
    }
    ImGui::End();
}

} // namespace

float panel_width(float scale) {
    return kPanelWidth * scale;
}

void draw_panels(LiveView& view, PanelState& panels, float scale) {
    const Area area = picture_area(panels, scale);
    if (panels.panels) {
        ImGui::SetNextWindowPos({0.0F, 0.0F});
        ImGui::SetNextWindowSize({area.low.x, area.high.y});
        if (ImGui::Begin("Plant", nullptr,
                         ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                             ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                             ImGuiWindowFlags_NoTitleBar)) {
            draw_plant_panel(view, panels);
        }
        ImGui::End();
    }
    if (panels.statistics) {
        draw_statistics(view, area);
    }
    draw_messages(view, area);
    draw_hint(view, panels, area);
    if (panels.help) {
        draw_help(panels, area);
    }
}

} // namespace lsys::view
