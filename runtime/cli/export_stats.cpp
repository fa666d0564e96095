// SPDX-License-Identifier: MIT
#include "runtime/cli/export_stats.h"

#include "runtime/derive/runtime_diagnostic.h"
#include "runtime/platform/memory.h"
#include "runtime/turtle/turtle_diagnostic.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace lsys::lsc {

namespace {

std::string number_text(double value) {
    return fmt::format("{:.4g}", value);
}

} // namespace

std::string export_stats_text(const Plant& plant, const Mesh& mesh, const ExportTiming& timing) {
    const Skeleton& skeleton = plant.skeleton;
    const SkeletonStats stats = measure(skeleton);
    std::string text;
    const auto row = [&text](const char* name, const std::string& value) {
        text += fmt::format("{:<18}{}\n", name, value);
    };
    row("generations", fmt::format("{}", plant.generations));
    row("seed", fmt::format("{}", plant.seed));
    row("modules", grouped_digits(plant.modules));
    row("segments", grouped_digits(skeleton.segments.size()));
    for (std::size_t order = 0; order < stats.segments_by_order.size(); ++order) {
        row(fmt::format("  of order {}", order).c_str(),
            grouped_digits(stats.segments_by_order[order]));
    }
    row("objects", grouped_digits(skeleton.objects.size()));
    row("polygons", grouped_digits(skeleton.polygons.size()));
    row("height", number_text(stats.height) + " m");
    row("crown width", number_text(stats.crown_width) + " m");
    row("length", number_text(stats.length) + " m");
    row("volume", number_text(stats.volume) + " m3");
    row("mass", number_text(stats.mass) + " kg");
    row("vertices", grouped_digits(mesh.positions.size()));
    row("triangles", grouped_digits(mesh.indices.size() / 3));
    row("bytes", grouped_digits(timing.bytes));
    const auto milliseconds = [](double seconds) {
        return fmt::format("{:.1f} ms", 1e3 * seconds);
    };
    row("derivation", milliseconds(plant.derive_seconds));
    row("turtle", milliseconds(plant.draw_seconds));
    if (timing.physics_seconds > 0.0) {
        row("physics", milliseconds(timing.physics_seconds));
    }
    row("mesh", milliseconds(timing.mesh_seconds));
    row("file", milliseconds(timing.write_seconds));
    row("peak memory", byte_size_text(platform::peak_memory()));
    return text;
}

std::string export_stats_json(const Plant& plant, const Mesh& mesh, const ExportTiming& timing) {
    const Skeleton& skeleton = plant.skeleton;
    const SkeletonStats stats = measure(skeleton);
    nlohmann::ordered_json object = nlohmann::ordered_json::object();
    object["generations"] = plant.generations;
    object["seed"] = plant.seed;
    object["modules"] = plant.modules;
    object["segments"] = skeleton.segments.size();
    object["segments_by_order"] = stats.segments_by_order;
    object["objects"] = skeleton.objects.size();
    object["polygons"] = skeleton.polygons.size();
    object["height_m"] = stats.height;
    object["crown_width_m"] = stats.crown_width;
    object["length_m"] = stats.length;
    object["volume_m3"] = stats.volume;
    object["mass_kg"] = stats.mass;
    object["vertices"] = mesh.positions.size();
    object["triangles"] = mesh.indices.size() / 3;
    object["bytes"] = timing.bytes;
    nlohmann::ordered_json& stages = object["ms"];
    stages["derivation"] = 1e3 * plant.derive_seconds;
    stages["turtle"] = 1e3 * plant.draw_seconds;
    stages["physics"] = 1e3 * timing.physics_seconds;
    stages["mesh"] = 1e3 * timing.mesh_seconds;
    stages["file"] = 1e3 * timing.write_seconds;
    object["peak_memory_bytes"] = platform::peak_memory();
    return object.dump() + '\n';
}

} // namespace lsys::lsc
