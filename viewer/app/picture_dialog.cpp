// SPDX-License-Identifier: MIT
#include "viewer/app/picture_dialog.h"

#include "grammar/base/paths.h"
#include "runtime/platform/child.h"
#include "runtime/program/files.h"
#include "viewer/app/output_path.h"
#include "viewer/app/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <imgui.h>

namespace lsys::view {

namespace {

struct NamedSize {
    const char* name;
    std::uint32_t width; // pixels; 0: the width of the window's picture
    std::uint32_t height;
};
constexpr std::array<NamedSize, 4> kSizes = {{{"Window", 0, 0},
                                              {"1280x720", 1280, 720},
                                              {"1920x1080", 1920, 1080},
                                              {"3840x2160", 3840, 2160}}};
constexpr int kMaxSide = 16'384; // pixels

void draw_size(const View& view, PictureSettings& settings) {
    for (const NamedSize& each : kSizes) {
        if (ImGui::RadioButton(each.name,
                               settings.width == each.width && settings.height == each.height)) {
            settings.width = each.width;
            settings.height = each.height;
        }
        ImGui::SameLine();
    }
    ImGui::NewLine();
    std::array<int, 2> size = {
        static_cast<int>(settings.width == 0 ? view.picture_width() : settings.width),
        static_cast<int>(settings.height == 0 ? view.picture_height() : settings.height)};
    if (ImGui::InputInt2("Size", size.data())) {
        settings.width = static_cast<std::uint32_t>(std::clamp(size[0], 1, kMaxSide));
        settings.height = static_cast<std::uint32_t>(std::clamp(size[1], 1, kMaxSide));
    }
    draw_tooltip("Width and height in pixels");
}

/// Draws the duration, rate and format of a film. `has_ffmpeg`: whether a .mp4 file can be written.
void draw_film(const View& view, PictureSettings& settings, bool has_ffmpeg) {
    int kind = static_cast<int>(settings.kind);
    if (ImGui::Combo("Motion", &kind, view.has_growth() ? "Turntable\0Growth\0" : "Turntable\0")) {
        settings.kind = static_cast<FilmKind>(kind);
    }
    draw_tooltip("Once around, or the growth to the last generation or year; at rest, without "
                 "gravity");
    ImGui::SliderFloat("Seconds", &settings.seconds, 1.0F, 60.0F, "%.1f",
                       ImGuiSliderFlags_Logarithmic);
    ImGui::SliderFloat("Pictures/s", &settings.frames_per_second, 1.0F, 60.0F, "%.0f");
    settings.seconds = std::clamp(settings.seconds, 0.1F, 3600.0F);
    settings.frames_per_second = std::clamp(settings.frames_per_second, 1.0F, 240.0F);
    if (has_ffmpeg) {
        ImGui::Checkbox("One .mp4 file", &settings.as_mp4);
    } else {
        settings.as_mp4 = false;
        ImGui::TextDisabled("With ffmpeg installed, films can be .mp4 files");
    }
}

} // namespace

bool draw_picture_dialog(const View& view, PictureSettings& settings, bool& is_open) {
    bool is_wanted = false;
    if (begin_dialog("Picture or film", is_open)) {
        if (ImGui::IsWindowAppearing()) {
            // Looks for ffmpeg each time the dialog opens, because the user may have installed it
            // since.
            settings.has_ffmpeg = !platform::find_program("ffmpeg").empty();
        }
        if (ImGui::RadioButton("Picture", !settings.is_film)) {
            settings.is_film = false;
        }
        ImGui::SameLine();
        if (ImGui::RadioButton("Film", settings.is_film)) {
            settings.is_film = true;
        }
        draw_size(view, settings);
        bool is_smooth = settings.samples > 1;
        ImGui::Checkbox("Antialiasing", &is_smooth);
        settings.samples = is_smooth ? 4 : 1;
        if (!view.is_forest() && !(settings.is_film && settings.as_mp4)) {
            ImGui::SameLine();
            ImGui::Checkbox("Transparent background", &settings.transparent);
            draw_tooltip("A PNG without sky and ground");
        }
        if (settings.is_film) {
            draw_film(view, settings, settings.has_ffmpeg);
        }
        bool is_entered = edit_text("Folder", settings.folder);
        draw_tooltip("Empty: the current folder");
        if (begins_editing()) {
            ImGui::SetKeyboardFocusHere();
        }
        is_entered = edit_text("Name", settings.name) || is_entered;
        const std::string path = settings.is_film && !settings.as_mp4
                                     ? numbered_path(settings.path(), 1)
                                     : settings.path();
        const std::string problem =
            settings.name.empty() ? "the picture has no name" : problem_of_output(path);
        if (problem.empty()) {
            line(settings.is_film ? fmt::format("{}: {} pictures", path, settings.frames()) : path);
        }
        draw_problem(problem);
        std::error_code ignored;
        const bool exists = std::filesystem::exists(path_of(path), ignored);
        is_wanted = end_dialog(exists ? "Replace" : "Write", problem, is_entered, is_open);
    }
    ImGui::End();
    return is_wanted;
}

} // namespace lsys::view
