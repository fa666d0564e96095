// SPDX-License-Identifier: MIT
// Presets: sets of options for the program that will read a file. A preset only adds options to the
// command line: options given by the user have priority.
#pragma once

#include "runtime/export/export.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

enum class PresetCommand : std::uint8_t { Export, Forest };

/// An option that a preset sets.
struct PresetOption {
    std::string_view preset;
    PresetCommand command = PresetCommand::Export;
    std::string_view name;  // such as `--unit`
    std::string_view value; // empty for a flag
    /// Options that prevent this option, separated by blanks; `--output=-`: only this value
    /// prevents it.
    std::string_view unless;
    /// Whether a format accepts the option. Null: all formats of the preset accept it.
    bool (*takes)(const FormatTraits& format) = nullptr;
};

/// A row of presets.def.
struct Preset {
    std::string_view name;
    std::string_view programs;       // names of the programs that read the files
    std::string_view plant_formats;  // names of formats for `lsc export`, separated by blanks
    std::string_view forest_formats; // names of formats for `lsc forest`; empty: none
};

[[nodiscard]] std::span<const Preset> presets();
[[nodiscard]] std::span<const PresetOption> preset_options();
/// Whether the preset supports a format for files of a command.
[[nodiscard]] bool
is_suitable(const Preset& preset, PresetCommand command, const FormatTraits& format);
/// The message that the preset does not suit a format.
[[nodiscard]] std::string
unsuitable_text(const Preset& preset, PresetCommand command, std::string_view format);

/// The options that a preset adds, as on the command line: `--unit=mm`. Omits an option if
/// `is_given` is true for its name or for a word of PresetOption::unless, or if the format does not
/// accept the option. If an option has several rows, the first row that is not omitted counts.
[[nodiscard]] std::vector<std::string>
preset_arguments(const Preset& preset,
                 PresetCommand command,
                 const FormatTraits& format,
                 const std::function<bool(std::string_view option)>& is_given);

/// All options of a preset for a command: "--pivot base --unit mm". If an option has several rows,
/// the first one.
[[nodiscard]] std::string preset_text(const Preset& preset, PresetCommand command);
/// The presets of a command as a table for `--help`.
[[nodiscard]] std::string preset_table(PresetCommand command);

} // namespace lsys
