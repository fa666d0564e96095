// SPDX-License-Identifier: MIT
// Options of files of plants that conflict.
#include "runtime/output/plant_files.h"
#include "runtime/output/surface_options.h"

#include <fmt/format.h>

#include <string>

namespace lsys {

namespace {

/// A message about options of levels of detail that conflict; empty if none do.
std::string find_lod_conflict(const PlantFileOptions& options,
                              ExportFormat format,
                              const OutputContext& context) {
    if (options.lod_files && options.lods == 0) {
        return "--lod-files needs the number of levels: --lods";
    }
    if (options.lods == 0) {
        return {};
    }
    if (options.mesh.level != 0) {
        return "--lods and --level do not go together: --lods writes several levels, --level one "
               "of them";
    }
    if (options.frames != 0) {
        return "--lods and --frames do not go together: each level has different vertices, and the "
               "skin or the shapes fit only one level; --level K writes one coarser, animated "
               "level";
    }
    if (options.mesh.method == MeshMethod::Solid) {
        return "--lods and --method solid do not go together: a solid has no coarser levels; a "
               "larger "
               "--min-width gives it fewer triangles";
    }
    if (!traits_of(format).uses_mesh) {
        return fmt::format("--lods needs a format with triangles, which {} is not",
                           traits_of(format).name);
    }
    const bool one_file = traits_of(format).lods && !options.lod_files;
    if (one_file && options.buffers == BufferPlace::Separate) {
        return "--lods embeds buffer and pictures in its one file; --buffers separate needs "
               "--lod-files";
    }
    if (!one_file && !context.can_write_beside(options.output)) {
        return fmt::format("--lods writes several files here, which need a file name; {} hold all "
                           "levels in one",
                           format_names("and", [](const FormatTraits& each) { return each.lods; }));
    }
    return {};
}

} // namespace

std::string
find_conflict(const PlantFileOptions& options, ExportFormat format, const OutputContext& context) {
    const bool bends = options.gravity || options.wind;
    std::string conflict = find_surface_conflict(options.surface, format);
    if (conflict.empty()) {
        conflict = find_lod_conflict(options, format, context);
    }
    if (!conflict.empty()) {
        return conflict;
    }
    const auto names_with = [](bool FormatTraits::*feature) {
        return format_names("or", [feature](const FormatTraits& each) { return each.*feature; });
    };
    if (options.compression && !traits_of(format).compresses) {
        return fmt::format("--compress needs {}, not {}", names_with(&FormatTraits::compresses),
                           traits_of(format).name);
    }
    if (options.buffers && !traits_of(format).separates) {
        return fmt::format("--buffers needs {}, not {}", names_with(&FormatTraits::separates),
                           traits_of(format).name);
    }
    if (options.grow && options.frames == 0) {
        return "--grow needs the number of its frames: --frames N";
    }
    if (options.grow && bends) {
        return "--grow and --gravity or --wind do not go together: the frames show either the "
               "generations of a plant or the motion of the last one";
    }
    if (options.grow && (options.wind_data || options.bones)) {
        return "--grow and --wind-data or --bones do not go together, because branches come and "
               "go; "
               "both are for the plant that has grown, without --grow";
    }
    if (options.grow &&
        options.compression.value_or(ExportCompression::None) != ExportCompression::None) {
        return "--grow and --compress do not go together: the changes from frame to frame are not "
               "quantised; fewer --frames or --level K make a smaller file";
    }
    if (options.grow && options.stream) {
        return "--grow and --stream do not go together, because a generation is drawn between "
               "stored words";
    }
    constexpr std::uint32_t kMinLoopFrames = 3;
    if (options.loop && options.frames < kMinLoopFrames) {
        return fmt::format(
            "--loop needs --frames N of at least {}, because the last frame equals the first",
            kMinLoopFrames);
    }
    if (options.bones && (options.frames == 0 || !traits_of(format).motion)) {
        return fmt::format(
            "--bones are joints of an animation: --frames N and {}",
            format_names("or", [](const FormatTraits& each) { return each.motion; }));
    }
    if (options.wind_data && !traits_of(format).wind_data) {
        return fmt::format(
            "--wind-data is for {}",
            format_names("and", [](const FormatTraits& each) { return each.wind_data; }));
    }
    if (options.unit != LengthUnit::Metres && !traits_of(format).units) {
        return fmt::format("--unit is for {}; {}",
                           format_names("and", [](const auto& each) { return each.units; }),
                           traits_of(format).collision
                               ? "glTF is in metres by definition, and importers scale it to the "
                                 "unit of the engine"
                               : "this format has a scale of its own");
    }
    if (options.collision != CollisionKind::None && !traits_of(format).collision) {
        return fmt::format(
            "--collision is for {}",
            format_names("and", [](const FormatTraits& each) { return each.collision; }));
    }
    if (options.grow && options.collision != CollisionKind::None) {
        return "--grow and --collision do not go together, because branches come and go; take the "
               "shapes from a file of the plant that has grown, without --grow";
    }
    if (options.loop && options.grow) {
        return "--loop and --grow do not go together, because the grown plant differs from the "
               "first frame";
    }
    if (options.loop && (!options.wind || !(options.wind->gust > 0.0F))) {
        return "--loop needs gusts, without which a plant comes to rest: --wind 8,0,0,0.5";
    }
    if (options.settle && !bends) {
        return "--settle needs a force: --gravity or --wind";
    }
    if (options.frames != 0 && !bends && !options.grow) {
        return "--frames needs something that moves: --gravity, --wind or --grow";
    }
    const bool one_file = options.grow ? traits_of(format).film : traits_of(format).motion;
    if (options.frames != 0 && options.output == "-" && !one_file) {
        return fmt::format(
            "--frames writes several files of this format, which do not go to standard "
            "output; {} hold all frames in one",
            format_names("and", [&](const FormatTraits& each) {
                return options.grow ? each.film : each.motion;
            }));
    }
    return {};
}

} // namespace lsys
