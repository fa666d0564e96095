// SPDX-License-Identifier: MIT
// Options of files of plants and forests: added to a command line, or parsed from names and values for
// the public library.
#pragma once

#include "grammar/base/result.h"
#include "runtime/output/file_options.h"
#include "runtime/output/presets.h"
#include "runtime/pipeline/scene_overrides.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lsys {

/// The option --preset with the presets of the command.
void add_preset(CLI::App& app, PresetCommand command, std::string& target);

// The options of files of plants, in the order of `lsc export --help`, which has more options.
/// --format, --preset, and the options of all files: place, unit, compression, axes.
void add_plant_form(CLI::App& app, PlantFileOptions& options);
/// The options of meshes and levels of detail.
void add_plant_mesh(CLI::App& app, PlantFileOptions& options);
/// The options of bending, motion and growth.
void add_plant_motion(CLI::App& app, PlantFileOptions& options);

// The options of files of forests, in the order of `lsc forest --help`.
/// The options of all files, without --preset.
void add_forest_form(CLI::App& app, ForestFileOptions& options);
/// --frames, and the options of meshes.
void add_forest_mesh(CLI::App& app, ForestFileOptions& options);

/// The format in which a file will be written; null if the name of the output has no known extension.
[[nodiscard]] const FormatTraits* format_of(const PlantFileOptions& options);
[[nodiscard]] const FormatTraits* format_of(const ForestFileOptions& options);

/// The options that a preset adds to those that `app` has parsed. Error: the preset has no files of
/// the format. Empty without a preset, or if the format is unknown. `format` may be null.
[[nodiscard]] Result<std::vector<std::string>> find_preset_arguments(std::string_view preset,
                                                                     PresetCommand command,
                                                                     const FormatTraits* format,
                                                                     const CLI::App& app);

/// An option by its name without dashes and its value, empty for a flag: {"lods", "6"}.
using NamedOption = std::pair<std::string, std::string>;
/// Options of the file `output`, including the options of its preset. Error: an unknown option or
/// an invalid value.
[[nodiscard]] Result<PlantFileOptions> parse_plant_files(const std::string& output,
                                                         const std::vector<NamedOption>& options);
[[nodiscard]] Result<ForestFileOptions> parse_forest_files(const std::string& output,
                                                           const std::vector<NamedOption>& options);

/// An option that one of the functions below reads.
struct OptionHelp {
    std::string name;       // without dashes
    std::string value_name; // "METRES", "none|capsules|hulls"; empty for a flag
    std::string text;
};
enum class OptionSet : std::uint8_t { Plant, Forest, Scene };
[[nodiscard]] std::vector<OptionHelp> describe_options(OptionSet set);

/// Options of `lsc forest` that replace values of a scene.
[[nodiscard]] Result<SceneOverrides> parse_scene_overrides(const std::vector<NamedOption>& options);

} // namespace lsys
