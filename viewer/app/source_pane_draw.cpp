// SPDX-License-Identifier: MIT
// SourcePane: its drawing with widgets of ImGui.
#include "grammar/base/utf8.h"
#include "viewer/app/panel_focus.h"
#include "viewer/app/source_pane.h"
#include "viewer/app/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <imgui.h>
#include <imgui_internal.h>

namespace lsys::view {

namespace {

constexpr float kRowSpacing = 2.0F; // between rows, pixels

/// Colours of text on dark and on light panels.
struct Shade {
    ImU32 dark;
    ImU32 light;

    [[nodiscard]] ImU32 get() const { return is_light_theme() ? light : dark; }
    static bool is_light_theme() { return ImGui::GetStyle().Colors[ImGuiCol_WindowBg].x > 0.5F; }
};
constexpr Shade shade(ImU32 dark, ImU32 light) {
    // Converts 0xRRGGBB to the order of bytes of ImGui.
    const auto turned = [](ImU32 rgb) {
        return 0xFF000000U | (rgb & 0xFFU) << 16U | (rgb & 0xFF00U) | (rgb >> 16U & 0xFFU);
    };
    return {turned(dark), turned(light)};
}

constexpr Shade kText = shade(0xD8DCE0, 0x202428);
/// Colours of tokens, by SourceTokenKind.
constexpr std::array<Shade, 8> kTokenShades{
    shade(0x8FD6A0, 0x1B6B34), // module
    shade(0x9CC4FF, 0x0B4FA8), // constant
    shade(0xF0C98A, 0x8A4B00), // formal
    shade(0xE6E08C, 0x6A5B00), // function
    shade(0xF2A6D0, 0x9A1F6A), // production
    shade(0xC4A8FF, 0x5B2BB5), // keyword
    shade(0x7FD8D8, 0x006A70), // setting
    shade(0x8A929A, 0x6A7076), // comment
};
constexpr Shade kNumber = shade(0x6E767E, 0x8A9096);

ImU32 ink_of(TextColour colour) {
    switch (colour) {
    case TextColour::Red:
        return shade(0xFF9C90, 0xB01818).get();
    case TextColour::Green:
        return shade(0x98F098, 0x116A1E).get();
    case TextColour::Yellow:
        return shade(0xFFE08A, 0x8A5A00).get();
    case TextColour::Blue:
        return shade(0x8FA8D8, 0x4A5A80).get();
    case TextColour::Cyan:
        return shade(0x8CE8F5, 0x04647A).get();
    case TextColour::Plain:
    case TextColour::Bold:
        break;
    }
    return kText.get();
}

ImU32 ink_of(Severity severity) {
    return ink_of(severity_colour(severity));
}

ImU32 translucent(ImU32 colour, ImU32 alpha) {
    return (colour & 0x00FFFFFFU) | alpha << 24U;
}

/// Places and sizes for drawing a row.
struct RowPlaces {
    ImVec2 corner;            // upper left corner of the row
    float text_left = 0.0F;   // left edge of the text of a line
    float character = 0.0F;   // width of a character
    float line_height = 0.0F; // height of a line of text
    float row_height = 0.0F;
    float right = 0.0F; // right edge of the visible part
    float left = 0.0F;
};

void put(ImVec2 at, ImU32 colour, std::string_view text) {
    ImGui::GetWindowDrawList()->AddText(at, colour, text.data(), text.data() + text.size());
}

/// Draws text that begins in a column; returns the column after the text.
std::uint32_t
put_part(const RowPlaces& at, std::uint32_t column, ImU32 colour, std::string_view text) {
    put({at.text_left + at.character * static_cast<float>(column), at.corner.y}, colour, text);
    return column + text_width(text);
}

/// The column of the byte at `offset` in a line.
std::uint32_t column_of(std::string_view line, std::size_t offset) {
    return text_width(expanded(line.substr(0, std::min(offset, line.size())), 0));
}

/// Max number of bytes of a line that are drawn; the remaining bytes of very long lines are not.
constexpr std::size_t kMaxDrawnBytes = 2000;

void draw_line(const ShownSource& source, std::uint32_t number, const RowPlaces& at) {
    const std::string_view text = source.file->line_text(number).substr(0, kMaxDrawnBytes);
    const std::uint32_t begin = source.file->line_begin(number);
    const auto end = begin + static_cast<std::uint32_t>(text.size());
    auto token = std::partition_point(source.tokens.begin(), source.tokens.end(),
                                      [begin](const SourceToken& one) { return one.end <= begin; });
    std::uint32_t column = 0;
    const auto put_bytes = [&](std::uint32_t from, std::uint32_t to, ImU32 colour) {
        column =
            put_part(at, column, colour, expanded(text.substr(from - begin, to - from), column));
    };
    std::uint32_t done = begin;
    for (; token != source.tokens.end() && token->begin < end; ++token) {
        const std::uint32_t from = std::max(token->begin, done);
        const std::uint32_t to = std::min(token->end, end);
        if (from >= to) {
            continue;
        }
        if (done < from) {
            put_bytes(done, from, kText.get());
        }
        put_bytes(from, to, kTokenShades.at(static_cast<std::size_t>(token->kind)).get());
        done = to;
    }
    if (done < end) {
        put_bytes(done, end, kText.get());
    }
    const std::string digits = fmt::format("{}", number);
    put({at.text_left - at.character * static_cast<float>(digits.size() + 1), at.corner.y},
        kNumber.get(), digits);
}

/// Underlines the marked bytes of a line.
void draw_underlines(const ShownSource& source, std::uint32_t number, const RowPlaces& at) {
    const std::string_view text = source.file->line_text(number);
    auto message =
        std::partition_point(source.messages.begin(), source.messages.end(),
                             [number](const SourceMessage& one) { return one.line < number; });
    for (; message != source.messages.end() && message->line == number; ++message) {
        const std::uint32_t begin = column_of(text, message->begin);
        const std::uint32_t end = std::max(column_of(text, message->end), begin + 1);
        const float y = at.corner.y + at.line_height;
        ImGui::GetWindowDrawList()->AddLine(
            {at.text_left + at.character * static_cast<float>(begin), y},
            {at.text_left + at.character * static_cast<float>(end), y}, ink_of(message->severity));
    }
}

void draw_marks(const ShownSource& source,
                const SourceMessage& message,
                bool has_label,
                const RowPlaces& at) {
    const std::string_view text = source.file->line_text(message.line);
    const std::uint32_t begin = column_of(text, message.begin);
    const std::uint32_t end = std::max(column_of(text, message.end), begin + 1);
    const ImU32 colour = ink_of(message.severity);
    const std::uint32_t after = put_part(at, begin, colour, std::string(end - begin, '^'));
    if (has_label) {
        put_part(at, after + 1, colour, message.label);
    }
}

void draw_runs(const TextLine& line, const RowPlaces& at) {
    std::uint32_t column = 0;
    for (const TextRun& run : line) {
        column = put_part(at, column, ink_of(run.colour), run.text);
    }
}

/// Draws the button and the title of a fix. Returns whether the button was pressed.
bool draw_fix(const SourceFix& fix, bool can_apply, const RowPlaces& at) {
    const char* const name = fix.is_certain ? "Apply fix" : "Apply this repair";
    bool pressed = false;
    ImGui::SetCursorScreenPos({at.text_left, at.corner.y});
    if (!can_apply || !fix.refusal.empty()) {
        put_part(at, 0, ink_of(TextColour::Green), "help: " + fix.title);
        return false;
    }
    ImGui::PushStyleColor(ImGuiCol_Text, ink_of(TextColour::Green));
    pressed = ImGui::SmallButton(name);
    ImGui::PopStyleColor();
    draw_tooltip(fix.is_certain ? "Writes the file (Ctrl+Enter); Ctrl+Z takes it back"
                                : "One of several repairs. Writes the file; Ctrl+Z takes it back");
    put({ImGui::GetItemRectMax().x + at.character, at.corner.y}, ink_of(TextColour::Green),
        fix.title);
    return pressed;
}

/// Draws the bar at the left edge of the pane, with which the user changes the width.
void draw_border(SourcePane& pane, float scale, float height) {
    const float thickness = 6.0F * scale;
    ImGui::InvisibleButton("border", {thickness, std::max(height, 1.0F)});
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        ImGui::GetWindowDrawList()->AddRectFilled(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                                  ImGui::GetColorU32(ImGuiCol_SeparatorHovered));
    }
    if (ImGui::IsItemActive()) {
        const float right = ImGui::GetIO().DisplaySize.x;
        pane.look.width = std::clamp((right - ImGui::GetIO().MousePos.x) / scale, kMinSourceWidth,
                                     kMaxSourceWidth);
    }
}

std::string file_label(const ShownSource& source) {
    const std::string name = source.path.substr(source.path.find_last_of('/') + 1);
    return source.messages.empty() ? name : fmt::format("{} ({})", name, source.messages.size());
}

void draw_files(SourcePane& pane) {
    const SourceText& text = *pane.text();
    if (text.files.size() == 1) {
        line(file_label(text.files.front()));
        draw_tooltip(text.files.front().path.c_str());
        return;
    }
    ImGui::SetNextItemWidth(-1.0F);
    if (ImGui::BeginCombo("##files", file_label(*pane.source()).c_str())) {
        for (std::size_t i = 0; i < text.files.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(file_label(text.files[i]).c_str(), i == pane.file_index())) {
                pane.select_file(i);
            }
            draw_tooltip(text.files[i].path.c_str());
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
}

void draw_buttons(SourcePane& pane, View& view, PlantView* plant, SourceActions& actions) {
    if (ImGui::Button("Editor")) {
        actions.opens = pane.place_to_open(view);
    }
    draw_tooltip("Open the selected line in the editor of $VISUAL, or in VS Code (Ctrl+E)");
    ImGui::SameLine();
    if (ImGui::Button("<")) {
        pane.go_to_message(-1, view);
    }
    draw_tooltip("Previous message (Shift+F8)");
    ImGui::SameLine();
    if (ImGui::Button("> Message")) {
        pane.go_to_message(1, view);
    }
    draw_tooltip("Next message (F8)");
    if (plant != nullptr && pane.text() != nullptr && !pane.text()->fixed.empty()) {
        ImGui::SameLine();
        if (ImGui::Button(fmt::format("Fix all ({})", pane.text()->fix_count).c_str())) {
            pane.apply_all(*plant);
        }
        draw_tooltip("Writes what `lsc check --fix` writes; Ctrl+Z takes it back");
    }
    ImGui::SameLine();
    if (ImGui::Button("Close")) {
        actions.closes = true;
    }
    draw_tooltip("Close the source (U)");
}

/// Draws the background of a row: the selection, and the statement that drew the picked part.
void draw_background(const SourcePane& pane, const SourceRow& row, const RowPlaces& at) {
    const auto is_in = [&row](const LineRange& lines) {
        return lines.first != 0 && row.line >= lines.first && row.line <= lines.last;
    };
    const ImVec2 opposite{at.right, at.corner.y + at.row_height};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (row.kind != SourceRow::Kind::Line) {
        const Shade under = shade(0xFFFFFF, 0x000000);
        list.AddRectFilled({at.left, at.corner.y}, opposite, translucent(under.get(), 14));
        return;
    }
    if (is_in(pane.highlighted())) {
        const Shade shown = shade(0xFFC040, 0xF0A000);
        list.AddRectFilled({at.left, at.corner.y}, opposite, translucent(shown.get(), 48));
        list.AddRectFilled({at.left, at.corner.y}, {at.left + 3.0F, opposite.y},
                           translucent(shown.get(), 255));
    }
    if (is_in(pane.selected())) {
        const Shade selection = shade(0x4A90FF, 0x2060D0);
        list.AddRectFilled({at.left, at.corner.y}, opposite, translucent(selection.get(), 56));
    }
}

/// Draws a row; a click selects its line, and a double click opens it in the editor.
void draw_row(SourcePane& pane,
              const SourceRow& row,
              const RowPlaces& at,
              PlantView* plant,
              SourceActions& actions) {
    const ShownSource& source = *pane.source();
    draw_background(pane, row, at);
    const bool is_hovered =
        ImGui::IsWindowHovered() &&
        ImGui::IsMouseHoveringRect({at.left, at.corner.y}, {at.right, at.corner.y + at.row_height});
    bool is_used = false; // whether a button of the row was pressed
    switch (row.kind) {
    case SourceRow::Kind::Line:
        draw_line(source, row.line, at);
        draw_underlines(source, row.line, at);
        break;
    case SourceRow::Kind::Marks:
        draw_marks(source, source.messages[row.message], row.index == 1, at);
        break;
    case SourceRow::Kind::Text:
    case SourceRow::Kind::Preview:
        draw_runs(pane.texts()[row.index], at);
        break;
    case SourceRow::Kind::Fix: {
        const SourceFix& fix = source.messages[row.message].fixes[row.index];
        const bool pressed = draw_fix(fix, plant != nullptr, at);
        is_used = ImGui::IsItemHovered();
        if (pressed) {
            pane.apply(fix, *plant);
        } else if (is_hovered && !is_used && !fix.refusal.empty()) {
            set_tooltip(fix.refusal);
        }
        break;
    }
    }
    if (!is_hovered || is_used) {
        return;
    }
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        pane.select_line(row.line, ImGui::GetIO().KeyShift);
    }
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        std::uint32_t column = 1;
        if (row.kind != SourceRow::Kind::Line) {
            column = source.messages[row.message].column;
        }
        actions.opens = FilePosition{source.path, row.line, column};
    }
}

void draw_rows(SourcePane& pane, PlantView* plant, SourceActions& actions) {
    RowPlaces at;
    at.character = ImGui::CalcTextSize("0").x;
    at.line_height = ImGui::GetTextLineHeight();
    at.row_height = at.line_height + kRowSpacing;
    const std::uint32_t lines = pane.source()->file->line_count();
    const std::size_t digits = fmt::format("{}", lines).size();
    const float gutter = at.character * static_cast<float>(digits + 2);
    const ImVec2 origin = ImGui::GetCursorScreenPos(); // moves when the pane is scrolled
    at.text_left = origin.x + gutter;
    at.left = ImGui::GetWindowPos().x;
    at.right = at.left + ImGui::GetWindowWidth();
    constexpr std::uint32_t kMinColumns = 20;
    const float visible =
        ImGui::GetWindowWidth() - gutter - ImGui::GetStyle().ScrollbarSize - 2.0F * at.character;
    pane.lay_out(
        std::max(kMinColumns, static_cast<std::uint32_t>(std::max(visible, 0.0F) / at.character)));
    const std::vector<SourceRow>& rows = pane.rows();
    if (const std::optional<std::uint32_t> target = pane.take_target()) {
        const auto row = std::partition_point(
            rows.begin(), rows.end(), [&](const SourceRow& one) { return one.line < *target; });
        const auto after = std::partition_point(
            row, rows.end(), [&](const SourceRow& one) { return one.line <= *target; });
        const float top = at.row_height * static_cast<float>(row - rows.begin());
        const float bottom = at.row_height * static_cast<float>(after - rows.begin());
        const float height = ImGui::GetWindowHeight() - 2.0F * at.row_height;
        if (top < ImGui::GetScrollY() || bottom > ImGui::GetScrollY() + height) {
            ImGui::SetScrollY(std::max(0.0F, top - height / 3.0F));
        }
    }
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()), at.row_height);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            at.corner = {origin.x, origin.y + at.row_height * static_cast<float>(i)};
            ImGui::PushID(i);
            draw_row(pane, rows[static_cast<std::size_t>(i)], at, plant, actions);
            ImGui::PopID();
            ImGui::SetCursorScreenPos({origin.x, at.corner.y + at.row_height});
        }
    }
    // Reserves the area of all rows, for the scroll bars.
    const float width = gutter + at.character * static_cast<float>(std::min<std::size_t>(
                                                    pane.source()->columns, kMaxDrawnBytes));
    ImGui::SetCursorScreenPos(origin);
    ImGui::Dummy({width, at.row_height * static_cast<float>(rows.size())});
}

/// A ring around the window, as around the control that has the keyboard.
void draw_focus_ring() {
    const ImVec2 corner = ImGui::GetWindowPos();
    const ImVec2 opposite{corner.x + ImGui::GetWindowWidth(), corner.y + ImGui::GetWindowHeight()};
    ImGui::GetWindowDrawList()->AddRect(corner, opposite,
                                        ImGui::GetColorU32(ImGuiCol_NavHighlight));
}

} // namespace

SourceActions
draw_source_pane(SourcePane& pane, View& view, PlantView* plant, float width, float scale) {
    SourceActions actions;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x - width, 0.0F});
    ImGui::SetNextWindowSize({width, size.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    const bool is_open = ImGui::Begin(
        "Source", nullptr,
        ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
            ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    ImGui::PopStyleVar();
    pane.has_focus = false;
    if (is_open) {
        draw_border(pane, scale, size.y);
        ImGui::SameLine(0.0F, 0.0F);
        ImGui::BeginChild(kSourceButtons, {0.0F, 0.0F});
        ImGui::Dummy({0.0F, 0.0F});
        draw_buttons(pane, view, plant, actions);
        if (pane.source() == nullptr) {
            ImGui::TextWrapped("%s", pane.text() == nullptr ? "Reading the source ..."
                                                            : pane.text()->failure.c_str());
        } else {
            draw_files(pane);
            ImGui::Separator();
            // Each file has its own scroll position.
            ImGui::PushID(static_cast<int>(pane.file_index()));
            // Arrow keys do not go from the buttons to the lines; F6 does.
            ImGui::PushItemFlag(ImGuiItemFlags_NoNav, true);
            if (ImGui::BeginChild(kSourceLines, {0.0F, 0.0F}, false,
                                  ImGuiWindowFlags_HorizontalScrollbar | ImGuiWindowFlags_NoNav)) {
                draw_rows(pane, plant, actions);
            }
            if (ImGui::IsWindowFocused()) {
                draw_focus_ring();
            }
            ImGui::EndChild();
            ImGui::PopItemFlag();
            ImGui::PopID();
        }
        ImGui::EndChild();
        // A ring around a button means that the button has the keys.
        pane.has_focus = ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows) &&
                         !ImGui::GetIO().NavVisible;
    }
    ImGui::End();
    return actions;
}

} // namespace lsys::view
