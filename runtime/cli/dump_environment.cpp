// SPDX-License-Identifier: MIT
#include "runtime/cli/dump_environment.h"

#include "grammar/base/number_chars.h"
#include "runtime/pipeline/sensed_plant.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>

namespace lsys::lsc {

namespace {

template <typename Number>
void put_number(Number number, std::string& text) {
    std::array<char, 32> characters{};
    text.append(
        characters.data(),
        number_to_chars(characters.data(), characters.data() + characters.size(), number).ptr);
}

template <typename Numbers>
void append_list(const Numbers& numbers, std::string& text) {
    text += '[';
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text += i == 0 ? "" : ", ";
        put_number(numbers[i], text);
    }
    text += ']';
}

/// Appends the items of a JSON array, one per line.
template <typename Items, typename Append>
void append_items(std::string_view name,
                  const Items& items,
                  std::string& text,
                  const Append& append) {
    text += fmt::format(",\n      \"{}\": [", name);
    for (std::size_t i = 0; i < items.size(); ++i) {
        text += i == 0 ? "\n        " : ",\n        ";
        append(items[i]);
    }
    text += items.empty() ? "]" : "\n      ]";
}

void append_json(const SensedPart& part, std::string& text) {
    text += fmt::format("    {{\n      \"name\": \"{}\",\n      \"kind\": \"{}\"", part.name,
                        name_of(part.kind));
    if (part.cell != 0.0) {
        text += ",\n      \"cell\": ";
        put_number(part.cell, text);
    }
    append_items("modules", part.modules, text, [&](const SensedModule& module) {
        text += fmt::format("{{\"module\": {}, \"position\": ", module.position);
        append_list(module.place.position, text);
        text += ", \"heading\": ";
        append_list(module.place.heading, text);
        text += ", \"answer\": ";
        append_list(module.answer, text);
        text += '}';
    });
    if (part.cell != 0.0) {
        append_items("voxels", part.voxels, text, [&](const SensedVoxel& voxel) {
            text += "{\"middle\": ";
            append_list(voxel.middle, text);
            text += part.kind == EnvironmentKind::Sky ? ", \"area\": " : ", \"exposure\": ";
            put_number(voxel.value, text);
            text += '}';
        });
    }
    if (part.kind == EnvironmentKind::Space) {
        append_items("markers", part.markers, text,
                     [&](const Vector3& marker) { append_list(marker, text); });
    }
    text += "\n    }";
}

std::string json_of(const SensedPlant& plant) {
    std::string text = "{\n";
    if (plant.has_sensed) {
        text += fmt::format("  \"generation\": {},\n", plant.generation);
    }
    text += "  \"environments\": [";
    for (std::size_t i = 0; i < plant.parts.size(); ++i) {
        text += i == 0 ? "\n" : ",\n";
        append_json(plant.parts[i], text);
    }
    text += plant.parts.empty() ? "]\n}\n" : "\n  ]\n}\n";
    return text;
}

/// Kinds of points in a PLY file.
enum class PointKind : int { Place, Voxel, Marker };

/// A PLY file of points (Turk 1994) as text.
std::string ply_of(const SensedPlant& plant) {
    std::size_t count = 0;
    for (const SensedPart& part : plant.parts) {
        count += part.modules.size() + part.voxels.size() + part.markers.size();
    }
    std::string text = "ply\nformat ascii 1.0\n";
    for (std::size_t i = 0; i < plant.parts.size(); ++i) {
        text += fmt::format("comment environment {}: {} ({})\n", i, plant.parts[i].name,
                            name_of(plant.parts[i].kind));
    }
    text += fmt::format("comment kind 0: module, value: first number of its answer\n"
                        "comment kind 1: voxel, value: exposure or leaf area\n"
                        "comment kind 2: marker\n"
                        "element vertex {}\nproperty double x\nproperty double y\n"
                        "property double z\nproperty float value\nproperty uchar kind\n"
                        "property uchar environment\nend_header\n",
                        count);
    for (std::size_t i = 0; i < plant.parts.size(); ++i) {
        const SensedPart& part = plant.parts[i];
        const auto put = [&](const Vector3& place, float value, PointKind kind) {
            for (const double number : place) {
                put_number(number, text);
                text += ' ';
            }
            put_number(value, text);
            text += fmt::format(" {} {}\n", static_cast<int>(kind), i);
        };
        for (const SensedModule& module : part.modules) {
            put(module.place.position, module.answer.empty() ? 0.0F : module.answer.front(),
                PointKind::Place);
        }
        for (const SensedVoxel& voxel : part.voxels) {
            put(voxel.middle, static_cast<float>(voxel.value), PointKind::Voxel);
        }
        for (const Vector3& marker : part.markers) {
            put(marker, 0.0F, PointKind::Marker);
        }
    }
    return text;
}

} // namespace

ExitStatus
dump_environment(const DumpCommand& command, const Grammar& grammar, const Console& console) {
    PlantOptions options;
    options.file = command.file;
    options.generations = command.grammar.generations;
    options.seed = command.seed;
    const Project project = make_project(console, command.run);
    SensedPlant plant;
    const ExitStatus status = console.take(sense_plant(options, grammar, project), plant);
    if (status != ExitStatus::Ok) {
        return status;
    }
    const bool is_ply = command.environment_format == EnvironmentFormat::Ply;
    const std::string text = is_ply ? ply_of(plant) : json_of(plant);
    return report_result(write_file(command.output, text, console), console);
}

} // namespace lsys::lsc
