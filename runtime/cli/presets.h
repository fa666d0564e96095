// Presets: options for the program that a file is made for. A preset stands for options of the
// command line, and for nothing else: an option that is given too wins.
#pragma once

#include "runtime/export/export.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys::lsc {

enum class PresetCommand : std::uint8_t { Export, Forest };

/// An option that a preset sets.
struct PresetOption {
    std::string_view preset;
    PresetCommand command = PresetCommand::Export;
    std::string_view name;  // `--unit`
    std::string_view value; // empty: the option is a flag
    /// Options that rule this one out, divided by blanks; `--output=-`: with this value only.
    std::string_view unless;
    /// Formats that take the option; null: all of the preset.
    bool (*takes)(const FormatTraits& format) = nullptr;
};

/// A row of presets.def.
struct Preset {
    std::string_view name;
    std::string_view use;     // the programs that the files are for
    std::string_view plants;  // names of formats for `lsc export`, divided by blanks
    std::string_view forests; // for `lsc forest`; empty: none
};

[[nodiscard]] std::span<const Preset> presets();
[[nodiscard]] std::span<const PresetOption> preset_options();
/// Whether the preset has files of the format for a command.
[[nodiscard]] bool suits(const Preset& preset, PresetCommand command, const FormatTraits& format);
/// The message that the preset has no files of a format.
[[nodiscard]] std::string
unsuitable_text(const Preset& preset, PresetCommand command, std::string_view format);

/// The options of a preset as on the command line, `--unit=mm`, without those for which `is_given`
/// (their own name, or a word of PresetOption::unless) and those that the format does not take. Of
/// several rows of an option the first that is left.
[[nodiscard]] std::vector<std::string>
preset_arguments(const Preset& preset,
                 PresetCommand command,
                 const FormatTraits& format,
                 const std::function<bool(std::string_view option)>& is_given);

/// All options of a preset for a command: "--pivot base --unit mm". Of several rows of an option the
/// first.
[[nodiscard]] std::string preset_text(const Preset& preset, PresetCommand command);
/// The presets of a command as a table for `--help`.
[[nodiscard]] std::string preset_table(PresetCommand command);

} // namespace lsys::lsc
