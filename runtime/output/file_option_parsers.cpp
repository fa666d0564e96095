// SPDX-License-Identifier: MIT
#include "runtime/output/file_option_parsers.h"

#include "runtime/meshing/detail_levels.h"
#include "runtime/program/arguments.h"
#include "runtime/program/find_option.h"
#include "runtime/program/option_parsers.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>

namespace lsys {

namespace {

void add_unit(CLI::App& app, LengthUnit& target) {
    const std::string unit =
        fmt::format("Unit of lengths in {} (default m)",
                    format_names("and", [](const FormatTraits& format) { return format.units; }));
    add_choice<LengthUnit>(app, "--unit", target,
                           {{"m", LengthUnit::Metres},
                            {"cm", LengthUnit::Centimetres},
                            {"mm", LengthUnit::Millimetres}},
                           unit.c_str());
}

void add_collision(CLI::App& app, CollisionKind& kind, CollisionNames& names) {
    add_choice<CollisionKind>(app, "--collision", kind,
                              {{"none", CollisionKind::None},
                               {"capsules", CollisionKind::Capsules},
                               {"hulls", CollisionKind::Hulls}},
                              "Shapes of trunk and boughs for the physics of engines, as nodes of "
                              "glTF (default none)");
    add_choice<CollisionNames>(app, "--collision-names", names,
                               {{"unreal", CollisionNames::Unreal},
                                {"godot", CollisionNames::Godot},
                                {"unity", CollisionNames::Unity}},
                               "Names of the collision nodes: UCP_tree_00 and UCX_tree_00; "
                               "tree_00-convcolonly; tree_collider_00 "
                               "(default unreal)");
}

/// Adds the options of unit, pivot and collision shapes of plant files.
void add_unit_pivot_collision(CLI::App& app, PlantFileOptions& options) {
    add_unit(app, options.unit);
    add_choice<PlantPivot>(
        app, "--pivot", options.pivot,
        {{"origin", PlantPivot::Origin},
         {"base", PlantPivot::Base},
         {"centre", PlantPivot::Centre}},
        "Point that becomes the origin of the file: the start of the turtle, the base of the trunk "
        "or the middle of the plant (default origin)");
    add_collision(app, options.collision, options.collision_names);
}

void add_compression(CLI::App& app, std::optional<ExportCompression>& compression) {
    add_choice<std::optional<ExportCompression>>(
        app, "--compress", compression,
        {{"none", ExportCompression::None},
         {"quantize", ExportCompression::Quantize},
         {"meshopt", ExportCompression::Meshopt}},
        "glb and gltf: numbers of 8 to 16 bits (KHR_mesh_quantization), with `meshopt` compressed "
        "by EXT_meshopt_compression too (default none)");
}

void add_surface(CLI::App& app, SurfaceOptions& options) {
    const std::string up =
        fmt::format("Axis that points up in {} (default y)",
                    format_names("and", [](const FormatTraits& format) { return format.up_axes; }));
    add_choice<UpAxis>(app, "--up", options.up, {{"y", UpAxis::Y}, {"z", UpAxis::Z}}, up.c_str());
    app.add_flag(
        "--both-sides", options.both_sides,
        fmt::format("Write leaves a second time, reversed, in {}: for readers that show "
                    "front faces only",
                    format_names("and", [](const FormatTraits& each) { return each.back_faces; })));
}

std::vector<std::string> arguments_of(const std::vector<NamedOption>& named) {
    std::vector<std::string> arguments;
    for (const auto& [name, value] : named) {
        arguments.push_back(value.empty() ? "--" + name : fmt::format("--{}={}", name, value));
    }
    return arguments;
}

Result<void> parse(CLI::App& app, const std::vector<std::string>& arguments) {
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
        return {};
    } catch (const CLI::ParseError& error) {
        const UsageError usage = to_usage_error(error, app, "");
        return Error{usage.help.starts_with("did you mean")
                         ? fmt::format("{}; {}", usage.message, usage.help)
                         : usage.message};
    }
}

/// Parses named options; if they name a preset, parses them again with its options in front. `add`
/// adds the options of a struct, except `--output`, to a command line.
template <typename Options, typename Add>
Result<Options> parse_named(PresetCommand command,
                            const std::string& output,
                            const std::vector<NamedOption>& named,
                            const Add& add) {
    std::vector<std::string> arguments = arguments_of(named);
    for (bool with_preset = false;; with_preset = true) {
        Options options;
        CLI::App app;
        app.set_help_flag();
        app.allow_windows_style_options(false); // `/a` is a path
        add(app, options);
        if (const Result<void> parsed = parse(app, arguments); !parsed) {
            return parsed.error();
        }
        options.output = output;
        if (with_preset) {
            return options;
        }
        const Result<std::vector<std::string>> more =
            find_preset_arguments(options.preset, command, format_of(options), app);
        if (!more) {
            return more.error();
        }
        if (more.value().empty()) {
            return options;
        }
        arguments.insert(arguments.begin(), more.value().begin(), more.value().end());
    }
}

} // namespace

const FormatTraits* format_of(const PlantFileOptions& options) {
    const std::optional<ExportFormat> format =
        options.format ? options.format : format_of_path(options.output);
    return format ? &traits_of(*format) : nullptr;
}
const FormatTraits* format_of(const ForestFileOptions& options) {
    const std::optional<ExportFormat> format = format_of_path(options.output);
    return format ? &traits_of(*format) : nullptr;
}

void add_preset(CLI::App& app, PresetCommand command, std::string& target) {
    std::vector<std::pair<std::string, std::string>> names;
    for (const Preset& preset : presets()) {
        if (command == PresetCommand::Export || !preset.forest_formats.empty()) {
            names.emplace_back(preset.name, preset.name);
        }
    }
    add_choice<std::string>(app, "--preset", target, std::move(names),
                            "Options for the program that the file is for, listed below; options "
                            "given on the command line have priority");
}

void add_plant_form(CLI::App& app, PlantFileOptions& options) {
    std::vector<std::pair<std::string, std::optional<ExportFormat>>> formats;
    for (const ExportFormat format : export_formats()) {
        formats.emplace_back(traits_of(format).name, format);
    }
    add_choice(app, "--format", options.format, std::move(formats),
               "Format (default: by the extension of the output)");
    add_preset(app, PresetCommand::Export, options.preset);
    add_unit_pivot_collision(app, options);
    add_compression(app, options.compression);
    add_choice<std::optional<BufferPlace>>(
        app, "--buffers", options.buffers,
        {{"embedded", BufferPlace::Embedded}, {"separate", BufferPlace::Separate}},
        "gltf: the buffer in the file, or with the pictures beside it: tree.bin, tree.bark.png "
        "(default embedded)");
    add_surface(app, options.surface);
}

void add_plant_mesh(CLI::App& app, PlantFileOptions& options) {
    add_mesh(app, options.mesh);
    describe_detail_levels(app);
    add_parsed(
        app, "--lods", options.lods, integer(1, kMaxDetailLevel + 1),
        fmt::format(
            "Write N levels of detail, from the finest to the coarsest; where the plant has more, "
            "N "
            "in equal steps: {} hold them in one file (glTF as MSFT_lod, USD as the variant set "
            "LOD), other formats are files tree.LOD0.obj, tree.LOD1.obj, ... and tree.lods.json",
            format_names("and", [](const FormatTraits& format) { return format.lods; }))
            .c_str())
        ->type_name("N")
        ->group("Mesh");
    app.add_flag("--lod-files", options.lod_files,
                 "Write a file for each level in any format, and the list of distances "
                 "tree.lods.json")
        ->group("Mesh");
}

void add_plant_motion(CLI::App& app, PlantFileOptions& options) {
    const auto gravity = [](const std::string& text) { return parse_number(text, 0.0F, 1e6F); };
    add_parsed(app, "--gravity", options.gravity, gravity,
               "Bend the plant under its weight, in m/s2 (9.81 on Earth)")
        ->type_name("G")
        ->group("Physics");
    add_parsed(app, "--wind", options.wind, parse_wind,
               "Bend the plant in wind, in m/s; GUST is the fraction of the speed that varies")
        ->type_name("X,Y,Z[,GUST]")
        ->group("Physics");
    app.add_flag("--settle", options.settle,
                 "Start at rest; without --frames, export the plant at rest")
        ->group("Physics");
    constexpr std::uint64_t kMaxFrames = 1'000'000;
    const std::string frames =
        fmt::format("Number of frames: one animation in {}, else numbered files tree.0001.ply, "
                    "tree.0002.ply, ...",
                    format_names("and", [](const FormatTraits& format) { return format.motion; }));
    add_parsed(app, "--frames", options.frames, integer(1, kMaxFrames), frames.c_str())
        ->type_name("N")
        ->group("Physics");
    const auto bones = [](const std::string& text) -> Result<std::uint64_t> {
        constexpr std::uint64_t kMinJoints = 2;
        return text == "all" || text == "0" ? Result<std::uint64_t>(0)
                                            : parse_integer(text, kMinJoints, kMaxJoints);
    };
    add_parsed(app, "--bones", options.bones, bones,
               "Max number of joints of an animation's skin; all: one for each segment that moves "
               "(default 128)")
        ->type_name("N|all")
        ->group("Physics");
    app.add_flag("--wind-data", options.wind_data,
                 "Pivot, distance, phase and stiffness in TEXCOORD_1 and TEXCOORD_2 of glTF, for "
                 "the shaders in scripts/wind")
        ->group("Physics");
    app.add_flag(
           "--loop", options.loop,
           "With gusts: the last frame equals the first, so that the motion repeats without a jump")
        ->group("Physics");
    app.add_flag("--grow", options.grow,
                 "The frames show the plant from its axiom to its last generation, with growth "
                 "between generations");
    const auto rate = [](const std::string& text) { return parse_number(text, 0.1F, 1000.0F); };
    add_parsed(app, "--fps", options.frames_per_second, rate, "Frames per second (default 24)")
        ->type_name("F")
        ->group("Physics");
}

void add_forest_form(CLI::App& app, ForestFileOptions& options) {
    add_compression(app, options.compression);
    app.add_flag("--expand", options.expand,
                 "glTF without EXT_mesh_gpu_instancing: one node per instance");
    app.add_flag("--bake", options.bake, "Write all triangles as one mesh");
    add_choice<ForestInstances>(
        app, "--instances", options.instance_kind,
        {{"branches", ForestInstances::Branches},
         {"trees", ForestInstances::Trees},
         {"lods", ForestInstances::Lods}},
        "branches: every tree is different; trees: whole heroes, few draw calls and as many "
        "different trees as --heroes; lods: whole heroes, each with the level of detail for its "
        "distance from --viewpoint (default branches)");
    add_parsed(app, "--viewpoint", options.viewpoint, parse_place,
               "Eye for --instances lods, in m (default: outside the edge of the forest)")
        ->type_name("X,Y,Z");
    add_unit(app, options.unit);
    add_choice<ForestPivot>(
        app, "--pivot", options.pivot,
        {{"origin", ForestPivot::Origin}, {"base", ForestPivot::Base}},
        "Place that becomes the origin of the file: the origin of the scene, or the ground in the "
        "middle of its rectangle (default origin)");
    add_collision(app, options.collision, options.collision_names);
    add_surface(app, options.surface);
    add_parsed(
        app, "--cell", options.cell,
        [](const std::string& text) { return parse_number(text, 0.0F, 1e6F); },
        "Side of the ground cells whose trees share one instance node; 0: one cell (default 100, "
        "with --instances trees or lods 0)")
        ->type_name("METRES");
}

void add_forest_mesh(CLI::App& app, ForestFileOptions& options) {
    constexpr std::uint64_t kMaxFrames = 10'000;
    add_parsed(app, "--frames", options.frames, integer(0, kMaxFrames),
               "Write N moments of a forest that grows, by domination or through its stages, as "
               "numbered files")
        ->type_name("N")
        ->group("Placement");
    add_mesh(app, options.mesh);
}

Result<std::vector<std::string>> find_preset_arguments(std::string_view name,
                                                       PresetCommand command,
                                                       const FormatTraits* format,
                                                       const CLI::App& app) {
    for (const Preset& preset : presets()) {
        if (preset.name != name || format == nullptr) {
            continue;
        }
        if (!is_suitable(preset, command, *format)) {
            return Error{unsuitable_text(preset, command, format->name)};
        }
        return preset_arguments(preset, command, *format, [&app](std::string_view word) {
            const std::size_t end = std::min(word.find('='), word.size());
            const CLI::Option* const option = find_option(app, std::string(word.substr(0, end)));
            if (option == nullptr) {
                return false;
            }
            const std::vector<std::string> values = option->results();
            return end == word.size() ? !values.empty()
                                      : std::find(values.begin(), values.end(),
                                                  word.substr(end + 1)) != values.end();
        });
    }
    return std::vector<std::string>{};
}

namespace {

void add_plant_files(CLI::App& app, PlantFileOptions& options) {
    add_plant_form(app, options);
    add_plant_mesh(app, options);
    add_plant_motion(app, options);
    add_height(app, options.height);
}

void add_forest_files(CLI::App& app, ForestFileOptions& options) {
    add_preset(app, PresetCommand::Forest, options.preset);
    add_forest_form(app, options);
    add_forest_mesh(app, options);
}

void add_scene(CLI::App& app, SceneOverrides& overrides) {
    add_scene_overrides(app, overrides, "--size");
    add_tree_height(app, overrides.height);
    add_seed(app, overrides.seed);
}

} // namespace

Result<PlantFileOptions> parse_plant_files(const std::string& output,
                                           const std::vector<NamedOption>& options) {
    return parse_named<PlantFileOptions>(PresetCommand::Export, output, options, add_plant_files);
}

Result<ForestFileOptions> parse_forest_files(const std::string& output,
                                             const std::vector<NamedOption>& options) {
    return parse_named<ForestFileOptions>(PresetCommand::Forest, output, options, add_forest_files);
}

Result<SceneOverrides> parse_scene_overrides(const std::vector<NamedOption>& options) {
    SceneOverrides overrides;
    CLI::App app;
    app.set_help_flag();
    app.allow_windows_style_options(false);
    add_scene(app, overrides);
    if (const Result<void> parsed = parse(app, arguments_of(options)); !parsed) {
        return parsed.error();
    }
    return overrides;
}

std::vector<OptionHelp> describe_options(OptionSet set) {
    PlantFileOptions plant;
    ForestFileOptions forest;
    SceneOverrides scene;
    CLI::App app;
    app.set_help_flag();
    switch (set) {
    case OptionSet::Plant:
        add_plant_files(app, plant);
        break;
    case OptionSet::Forest:
        add_forest_files(app, forest);
        break;
    case OptionSet::Scene:
        add_scene(app, scene);
        break;
    }
    std::vector<OptionHelp> all;
    for (const CLI::Option* option : app.get_options()) {
        const bool is_flag = option->get_items_expected_max() == 0;
        all.push_back({option->get_lnames().front(),
                       is_flag ? std::string() : option->get_type_name(),
                       option->get_description()});
    }
    return all;
}

} // namespace lsys
