// SPDX-License-Identifier: MIT
#include "viewer/app/styled_text.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lsys::view {

namespace {

/// The colour that the parameters of an SGR code set; `now` if the parameters are unknown.
TextColour colour_of(std::string_view parameters, TextColour now) {
    static constexpr std::array<std::pair<std::string_view, TextColour>, 8> kColours{
        {{"", TextColour::Plain},
         {"0", TextColour::Plain},
         {"1", TextColour::Bold},
         {"1;31", TextColour::Red},
         {"1;32", TextColour::Green},
         {"1;33", TextColour::Yellow},
         {"1;34", TextColour::Blue},
         {"1;36", TextColour::Cyan}}};
    const auto* const found =
        std::find_if(kColours.begin(), kColours.end(),
                     [parameters](const auto& each) { return each.first == parameters; });
    return found == kColours.end() ? now : found->second;
}

} // namespace

std::vector<TextLine> styled_lines(std::string_view text) {
    std::vector<TextLine> lines;
    TextColour colour = TextColour::Plain;
    bool is_new_line = true;
    const auto add = [&](char c) {
        TextLine& line = lines.back();
        if (line.empty() || line.back().colour != colour) {
            line.push_back({colour, {}});
        }
        line.back().text += c;
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (std::exchange(is_new_line, false)) {
            lines.emplace_back();
        }
        if (text[i] == '\n') {
            is_new_line = true;
            continue;
        }
        if (text.substr(i, 2) != "\x1b[") {
            add(text[i]);
            continue;
        }
        const std::size_t end = text.find('m', i);
        if (end == std::string_view::npos) {
            break;
        }
        colour = colour_of(text.substr(i + 2, end - i - 2), colour);
        i = end;
    }
    return lines;
}

std::string plain_text(const TextLine& line) {
    std::string text;
    for (const TextRun& run : line) {
        text += run.text;
    }
    return text;
}

} // namespace lsys::view
