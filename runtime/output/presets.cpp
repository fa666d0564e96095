// SPDX-License-Identifier: MIT
#include "runtime/output/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lsys {

namespace {

bool expands(const FormatTraits& format) {
    return format.expands_forest;
}

/// Whether files of the format do not state which axis is up. Most readers of such formats, like
/// PLY and STL, assume +Z.
bool omits_up_axis(const FormatTraits& format) {
    return format.up_axes && format.pictures == ExportPictures::None;
}

constexpr std::array kPresets{
#define LSYS_PRESET(name, programs, plants, forests) Preset{#name, programs, plants, forests},
#define LSYS_PRESET_OPTION(...)
#include "runtime/output/presets.def"
#undef LSYS_PRESET
#undef LSYS_PRESET_OPTION
};

constexpr std::array kOptions{
#define LSYS_PRESET(...)
#define LSYS_PRESET_OPTION(preset, command, name, value, unless, takes)                            \
    PresetOption{#preset, PresetCommand::command, name, value, unless, takes},
#include "runtime/output/presets.def"
#undef LSYS_PRESET
#undef LSYS_PRESET_OPTION
};

std::string_view formats_of(const Preset& preset, PresetCommand command) {
    return command == PresetCommand::Export ? preset.plant_formats : preset.forest_formats;
}

/// The words of a text, separated by blanks.
std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return words;
}

std::string option_text(const PresetOption& option, char between) {
    return option.value.empty() ? std::string(option.name)
                                : fmt::format("{}{}{}", option.name, between, option.value);
}

} // namespace

std::span<const Preset> presets() {
    return kPresets;
}

std::span<const PresetOption> preset_options() {
    return kOptions;
}

bool is_suitable(const Preset& preset, PresetCommand command, const FormatTraits& format) {
    const std::vector<std::string_view> names = words_of(formats_of(preset, command));
    return std::find(names.begin(), names.end(), format.name) != names.end();
}

std::string unsuitable_text(const Preset& preset, PresetCommand command, std::string_view format) {
    std::vector<std::string_view> names = words_of(formats_of(preset, command));
    std::sort(names.begin(), names.end());
    if (names.empty()) {
        return fmt::format("--preset {} is for a single plant", preset.name);
    }
    const auto last = names.end() - 1;
    return fmt::format("--preset {} is for {}{}{}, not {}", preset.name,
                       fmt::join(names.begin(), last, ", "), names.size() > 1 ? " and " : "", *last,
                       format);
}

std::vector<std::string>
preset_arguments(const Preset& preset,
                 PresetCommand command,
                 const FormatTraits& format,
                 const std::function<bool(std::string_view option)>& is_given) {
    std::vector<std::string> arguments;
    std::string_view last; // name of the last option taken; rows of an option are neighbours
    for (const PresetOption& option : kOptions) {
        if (option.preset != preset.name || option.command != command || option.name == last) {
            continue;
        }
        const std::vector<std::string_view> others = words_of(option.unless);
        if (!is_given(option.name) && std::none_of(others.begin(), others.end(), is_given) &&
            (option.takes == nullptr || option.takes(format))) {
            arguments.push_back(option_text(option, '='));
            last = option.name;
        }
    }
    return arguments;
}

std::string preset_text(const Preset& preset, PresetCommand command) {
    std::string text;
    std::string_view last;
    for (const PresetOption& option : kOptions) {
        if (option.preset == preset.name && option.command == command && option.name != last) {
            text += (text.empty() ? "" : " ") + option_text(option, ' ');
            last = option.name;
        }
    }
    return text;
}

std::string preset_table(PresetCommand command) {
    constexpr std::size_t kColumn = 10;
    std::string text;
    for (const Preset& preset : kPresets) {
        if (!formats_of(preset, command).empty()) {
            text +=
                fmt::format("  {:<{}}{} ({})\n  {:<{}}{}\n", preset.name, kColumn, preset.programs,
                            fmt::join(words_of(formats_of(preset, command)), ", "), "", kColumn,
                            preset_text(preset, command));
        }
    }
    return text;
}

} // namespace lsys
