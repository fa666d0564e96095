// SPDX-License-Identifier: MIT
#include "grammar/base/paths.h"
#include "runtime/cli/commands.h"
#include "runtime/cli/export_stats.h"
#include "runtime/cli/plant_options.h"
#include "runtime/cli/progress.h"
#include "runtime/export/export.h"
#include "runtime/output/plant_files.h"
#include "runtime/pipeline/plant.h"
#include "runtime/program/files.h"
#include "runtime/program/host.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace lsys::lsc {

namespace {

/// Prints the counts of the plant and the times of the export.
ExitStatus write_stats(const ExportCommand& command,
                       const PlantFileReport& report,
                       const Plant& plant,
                       const Console& console) {
    const std::string text = command.messages.format == MessageFormat::Json
                                 ? export_stats_json(plant, report.mesh, report.timing)
                                 : export_stats_text(plant, report.mesh, report.timing);
    if (command.output == "-") { // standard output is taken by the plant
        console.line(text);
        return ExitStatus::Ok;
    }
    return report_result(console.write(text), console);
}

/// A message about options that conflict with --variants; empty if none do.
std::string find_variant_conflict(const ExportCommand& command, ExportFormat format) {
    if (!command.variants) {
        return {};
    }
    const std::string instead = fmt::format(
        "a file for each value: -D {}={}", command.variants->name, command.variants->texts.front());
    if (!traits_of(format).variants) {
        return fmt::format("--variants is for {}; other formats take {}",
                           format_names("and", [](const auto& each) { return each.variants; }),
                           instead);
    }
    if (command.lods != 0) {
        return "--variants and --lods do not go together, because each plant has levels of its "
               "own; write " +
               instead;
    }
    if (command.frames != 0) {
        return "--variants and --frames do not go together, because each plant moves in its own "
               "way; write " +
               instead;
    }
    if (is_standard_input(command.file)) {
        return "--variants reads the grammar for each value, so it needs a file and not standard "
               "input";
    }
    const auto& definitions = command.grammar.definitions;
    if (std::any_of(definitions.begin(), definitions.end(),
                    [&](const Definition& each) { return each.name == command.variants->name; })) {
        return fmt::format("`{}` has one value by -D and several by --variants; leave out one of "
                           "them",
                           command.variants->name);
    }
    return {};
}

/// Moves the value out of an outcome and prints its messages, unless equal ones have been printed.
template <typename T>
ExitStatus
take_once(Outcome<T> outcome, T& value, const Console& console, std::set<std::string>& shown) {
    if (shown.insert(messages_text(outcome.messages(), console.options(), "lsc")).second) {
        console.show(outcome.messages());
    }
    if (!outcome) {
        return status_of(outcome.stop());
    }
    value = std::move(outcome.value());
    return ExitStatus::Ok;
}

/// Writes one plant per value of --variants into one file.
ExitStatus
export_variants(const ExportCommand& command, ExportFormat format, const OutputContext& context) {
    std::set<std::string> shown;
    const Console& console = context.console;
    const Project& project = context.project;
    const VariantValues& values = *command.variants;
    const auto grow = [&](std::size_t number, Grammar& grammar, Plant& plant) {
        ExportCommand variant = command;
        variant.grammar.definitions.push_back({values.name, values.values[number]});
        const ExitStatus status = take_once(load_grammar(variant.file, variant.grammar, project),
                                            grammar, console, shown);
        if (status != ExitStatus::Ok) {
            return status;
        }
        grammar.program.reset();
        return take_once(grow_plant(plant_options(variant), grammar, project), plant, console,
                         shown);
    };
    PlantFileReport report;
    Plant first;
    const ExitStatus status =
        write_variant_files(command, format, command.file, values, grow, context, report, first);
    return status == ExitStatus::Ok && command.stats ? write_stats(command, report, first, console)
                                                     : status;
}

/// Grows the plant of a compiled grammar in frames and writes them.
ExitStatus export_growth(const ExportCommand& command,
                         ExportFormat format,
                         Grammar& grammar,
                         const OutputContext& context) {
    PlantFileReport report;
    Plant last;
    const ExitStatus status =
        write_growth_files(command, format, plant_options(command), grammar, context, report, last);
    return status == ExitStatus::Ok && command.stats
               ? write_stats(command, report, last, context.console)
               : status;
}

/// `output` with a corrected extension: a format name with the same letters in another order, else
/// the most similar format name. Empty if none is similar.
std::string nearest_output(const std::string& output) {
    const std::size_t dot = output.rfind('.');
    const bool is_hidden = path_text(path_of(output).filename()).rfind('.') == 0; // `.glb`
    if (dot == std::string::npos || dot < folder_of_path(output).size() || is_hidden) {
        return {};
    }
    std::string ending = output.substr(dot + 1);
    std::string sorted = ending;
    std::sort(sorted.begin(), sorted.end());
    for (const std::string_view name :
         {"glb", "gltf", "obj", "ply", "stl", "svg", "usda", "usdz"}) {
        std::string letters(name);
        std::sort(letters.begin(), letters.end());
        if (letters == sorted) {
            return output.substr(0, dot + 1) + std::string(name);
        }
    }
    const auto nearest =
        nearest_name(ending, {"gltf", "usda", "usdz", "glb", "obj", "ply", "stl", "svg"});
    return nearest ? output.substr(0, dot + 1) + std::string(*nearest) : std::string();
}

} // namespace

ExitStatus run_command(const ExportCommand& command, const Console& console) {
    const std::optional<ExportFormat> format =
        command.format ? command.format : format_of_path(command.output);
    if (!format) {
        const std::string meant = nearest_output(command.output);
        return report_error(
            Error{fmt::format("`{}` has no extension of a known format: {}; {}", command.output,
                              format_names("or", [](const FormatTraits&) { return true; }),
                              meant.empty() ? "say which with --format"
                                            : fmt::format("did you mean `{}`?", meant))},
            console);
    }
    Grammar grammar;
    Project project = make_project(console, command.run);
    const OutputContext context{console, project, "lsc " LSC_VERSION};
    std::string conflict = find_variant_conflict(command, *format);
    if (conflict.empty()) {
        conflict = find_conflict(command, *format, context);
    }
    if (!conflict.empty()) {
        return report_error(Error{conflict}, console);
    }
    if (command.variants) {
        return export_variants(command, *format, context);
    }
    ExitStatus status = console.take(load_grammar(command.file, command.grammar, project), grammar);
    if (status != ExitStatus::Ok) {
        return status;
    }
    grammar.program.reset(); // frees memory for the plant
    if (command.grow) {
        return export_growth(command, *format, grammar, context);
    }
    Plant plant;
    PipelineProgress progress(console, project.host);
    Outcome<Plant> grown = grow_plant(plant_options(command), grammar, project);
    progress.clear();
    status = console.take(std::move(grown), plant);
    if (status != ExitStatus::Ok) {
        return status;
    }
    PlantFileReport report;
    status = write_plant_files(command, *format, {command.file, grammar}, plant, context, report);
    return status == ExitStatus::Ok && command.stats ? write_stats(command, report, plant, console)
                                                     : status;
}

} // namespace lsys::lsc
