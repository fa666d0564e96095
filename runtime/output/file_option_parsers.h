// SPDX-License-Identifier: MIT
// Options of files of plants and forests: added to a command line, or parsed from names and values
// for the public library.
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

/// Adds the option --preset, with the presets of the command.
void add_preset(CLI::App& app, PresetCommand command, std::string& target);

// Options of plant files, in the order of `lsc export --help`, which has more options.
/// Adds --format, --preset, and the options of unit, pivot, collision shapes, compression, buffers
/// and axes.
void add_plant_form(CLI::App& app, PlantFileOptions& options);
/// Adds the options of meshes and levels of detail.
void add_plant_mesh(CLI::App& app, PlantFileOptions& options);
/// Adds the options of bending, motion and growth.
void add_plant_motion(CLI::App& app, PlantFileOptions& options);

// Options of forest files, in the order of `lsc forest --help`.
/// Adds the options of compression, instances, unit, pivot, collision shapes and axes.
void add_forest_form(CLI::App& app, ForestFileOptions& options);
/// Adds --frames and the options of meshes.
void add_forest_mesh(CLI::App& app, ForestFileOptions& options);

/// The format of a file to write; null if it is not given and the name of the output has no known
/// extension.
[[nodiscard]] const FormatTraits* format_of(const PlantFileOptions& options);
[[nodiscard]] const FormatTraits* format_of(const ForestFileOptions& options);

/// The options that a preset adds to the options that `app` has parsed. Error: the preset does not
/// suit the format. Empty without a preset, or if the format is unknown. `format` may be null.
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
/// Like parse_plant_files(), for a forest file.
[[nodiscard]] Result<ForestFileOptions> parse_forest_files(const std::string& output,
                                                           const std::vector<NamedOption>& options);

/// An option that the parser of an OptionSet accepts.
struct OptionHelp {
    std::string name;       // name without dashes
    std::string value_name; // "METRES", "none|capsules|hulls"; empty for a flag
    std::string text;
};
/// The options of parse_plant_files(), parse_forest_files() and parse_scene_overrides().
enum class OptionSet : std::uint8_t { Plant, Forest, Scene };
/// The options of a set, for help texts.
[[nodiscard]] std::vector<OptionHelp> describe_options(OptionSet set);

/// Options of `lsc forest` that replace values of a scene.
[[nodiscard]] Result<SceneOverrides> parse_scene_overrides(const std::vector<NamedOption>& options);

} // namespace lsys
