// SPDX-License-Identifier: MIT
// The target of the output of a forest, and conflicts of its options.
#include "grammar/base/paths.h"
#include "runtime/output/forest_files.h"
#include "runtime/output/surface_options.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>

namespace lsys {

namespace {

bool has_instances(const FormatTraits& format) {
    return format.write_forest != nullptr;
}

/// A message if --collision, --unit or --pivot does not fit the output; empty if all fit.
std::string find_option_conflict(const ForestFileOptions& options, const ForestTarget& target) {
    const bool has_format =
        target.kind == ForestOutputKind::Instances || target.kind == ForestOutputKind::Mesh;
    if (options.collision != CollisionKind::None) {
        if (target.kind != ForestOutputKind::Instances || !traits_of(target.format).collision) {
            return fmt::format(
                "--collision is for {} with instances",
                format_names("and", [](const auto& each) { return each.collision; }));
        }
        if (options.instance_kind != ForestInstances::Trees) {
            return "--collision is for whole trees of one level of detail: --instances trees";
        }
    }
    const bool metres = options.unit == LengthUnit::Metres;
    if (!has_format && !(metres && options.pivot == ForestPivot::Origin)) {
        return "--unit and --pivot are for files of trees";
    }
    if (has_format && !metres && !traits_of(target.format).units) {
        return fmt::format("--unit is for {}; {}",
                           format_names("and", [](const auto& each) { return each.units; }),
                           traits_of(target.format).collision
                               ? "glTF is in metres by definition, and importers scale it to the "
                                 "unit of the engine"
                               : "this format has a scale of its own");
    }
    return {};
}

} // namespace

Result<ForestTarget> target_of(const ForestFileOptions& options) {
    if (options.output.empty()) {
        return ForestTarget{};
    }
    const std::filesystem::path path = path_of(options.output);
    if (path.extension() == ".json") {
        return ForestTarget{ForestOutputKind::Statistics};
    }
    const std::optional<ExportFormat> format = format_of_path(options.output);
    if (options.bake) {
        if (!format || !traits_of(*format).uses_mesh) {
            return Error{
                fmt::format("`{}`: --bake writes {}", options.output,
                            format_names("or", [](const auto& each) { return each.uses_mesh; }))};
        }
        return ForestTarget{ForestOutputKind::Mesh, *format};
    }
    if (!format || !has_instances(traits_of(*format))) {
        return Error{fmt::format("`{}` has no extension of a format with instances ({}), nor json "
                                 "for statistics; --bake writes other formats",
                                 options.output, format_names("or", has_instances))};
    }
    return ForestTarget{ForestOutputKind::Instances, *format};
}

std::string find_conflict(const ForestFileOptions& options,
                          const ForestTarget& target,
                          std::optional<float> rho) {
    if (options.expand && options.bake) {
        return "--expand and --bake do not go together: the one writes a node for each tree, the "
               "other one mesh of all";
    }
    if (options.expand &&
        (target.kind != ForestOutputKind::Instances || !traits_of(target.format).expands_forest)) {
        return "--expand is for " +
               format_names("and", [](const auto& each) { return each.expands_forest; });
    }
    const bool has_format =
        target.kind == ForestOutputKind::Instances || target.kind == ForestOutputKind::Mesh;
    if (options.compression && !(has_format && traits_of(target.format).compresses)) {
        return "--compress is for " +
               format_names("and", [](const auto& each) { return each.compresses; });
    }
    const bool lods = options.instance_kind == ForestInstances::Lods;
    if (options.instance_kind != ForestInstances::Branches && rho.value_or(0.0F) > 0.0F) {
        return fmt::format(
            "--instances {} shows heroes as they are, so --rho does not go with it; more "
            "--heroes make more different trees",
            lods ? "lods" : "trees");
    }
    if (options.viewpoint && !lods) {
        return "--viewpoint is for --instances lods, whose trees have levels by distance";
    }
    if (lods && options.frames != 0) {
        return "--instances lods and --frames do not go together: levels are fitted to the trees "
               "of "
               "one moment; --instances trees writes a series";
    }
    if (lods && target.kind == ForestOutputKind::Statistics) {
        return "--instances lods has no statistics of its own; use --instances trees";
    }
    if (options.mesh.method == MeshMethod::Solid) {
        return "--method solid is for a single plant: the branches of a forest are instances";
    }
    if (target.kind == ForestOutputKind::None || target.kind == ForestOutputKind::Statistics) {
        if (options.surface.up != UpAxis::Y || options.surface.both_sides) {
            return "--up and --both-sides are for files of trees";
        }
    } else if (std::string conflict = find_surface_conflict(options.surface, target.format);
               !conflict.empty()) {
        return conflict;
    }
    if (const std::string conflict = find_option_conflict(options, target); !conflict.empty()) {
        return conflict;
    }
    if (options.frames != 0 && (options.output.empty() || options.output == "-")) {
        return "--frames writes a numbered series, so it needs -o FILE";
    }
    return {};
}

} // namespace lsys
