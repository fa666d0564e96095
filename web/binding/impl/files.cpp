// SPDX-License-Identifier: MIT
#include "web/binding/impl/files.h"

#include "runtime/output/file_option_parsers.h"
#include "runtime/output/forest_files.h"
#include "runtime/output/output_set.h"
#include "runtime/output/plant_files.h"
#include "runtime/pipeline/forest.h"
#include "runtime/pipeline/instancing_choice.h"
#include "runtime/pipeline/plant.h"
#include "runtime/program/console.h"
#include "web/binding/impl/read_options.h"

#include <fmt/format.h>

#include <functional>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace lsys::web {

namespace {

/// Runs `write` with a context that collects messages and files, and adds the files to `answer`.
Outcome<void> collect(const Session& session,
                      Answer& answer,
                      const std::function<ExitStatus(const OutputContext& context)>& write) {
    std::istringstream in; // the console uses no stream of the process
    std::ostringstream out;
    Messages messages;
    const Console console({in, out, out, false, nullptr, "lsys"}, {}, messages);
    std::string bytes;
    Json files = Json::array();
    const FileReceiver receive = [&](const FilePiece& piece) {
        bytes += piece.bytes;
        if (piece.is_last) {
            files.push_back({{"name", piece.name}, {"bytes", answer.add(std::move(bytes))}});
            bytes = {};
        }
        return true;
    };
    const OutputContext context{console, session.project(), "lsys for the web", &receive, nullptr};
    const ExitStatus status = write(context);
    if (status != ExitStatus::Ok) {
        return {stop_of(status), std::move(messages)};
    }
    answer.head["files"] = std::move(files);
    return {std::move(messages)};
}

/// Writes the plant of a request.
ExitStatus write_grown(const Json& request, const Session& session, const OutputContext& context) {
    const Console& console = context.console;
    const auto path = request.at("path").get<std::string>();
    const Result<PlantFileOptions> parsed =
        parse_plant_files(path, named_options_of(request, "options"));
    if (!parsed) {
        return report_error(parsed.error(), console);
    }
    const PlantFileOptions& options = parsed.value();
    const std::optional<ExportFormat> format =
        options.format ? options.format : format_of_path(path);
    if (!format) {
        return report_error(Error{fmt::format("`{}` has no extension of a known format", path)},
                            console);
    }
    if (std::string conflict = find_conflict(options, *format, context); !conflict.empty()) {
        return report_error(Error{std::move(conflict)}, console);
    }
    PlantOptions plant_options = plant_options_of(request);
    plant_options.height = options.height ? options.height : plant_options.height;
    plant_options.stream = options.stream;
    Grammar grammar;
    ExitStatus status = console.take(
        load_grammar(plant_options.file, grammar_options_of(request), session.project()), grammar);
    if (status != ExitStatus::Ok) {
        return status;
    }
    PlantFileReport report;
    Plant plant;
    if (options.grow) {
        return write_growth_files(options, *format, plant_options, grammar, context, report, plant);
    }
    status = console.take(grow_plant(plant_options, grammar, session.project()), plant);
    return status == ExitStatus::Ok
               ? write_plant_files(options, *format, {plant_options.file, grammar}, plant, context,
                                   report)
               : status;
}

/// Writes the forest of a request.
ExitStatus write_placed(const Json& request, const Session& session, const OutputContext& context) {
    const Console& console = context.console;
    const Project& project = session.project();
    const Result<ForestFileOptions> parsed = parse_forest_files(
        request.at("path").get<std::string>(), named_options_of(request, "options"));
    if (!parsed) {
        return report_error(parsed.error(), console);
    }
    const ForestFileOptions& options = parsed.value();
    const Result<ForestTarget> target = target_of(options);
    if (!target) {
        return report_error(target.error(), console);
    }
    Result<SceneOverrides> overrides = parse_scene_overrides(named_options_of(request, "scene"));
    if (!overrides) {
        return report_error(overrides.error(), console);
    }
    overrides.value().grammar = grammar_options_of(request);
    if (options.instance_kind != ForestInstances::Branches) {
        overrides.value().rho = 0.0F; // no branch is replaced by a recorded one
    }
    if (std::string conflict = find_conflict(options, target.value(), overrides.value().rho);
        !conflict.empty()) {
        return report_error(Error{std::move(conflict)}, console);
    }
    if (options.frames != 0) {
        return report_error(Error{"frames of forests are files of lsc only"}, console);
    }
    const auto names = request.at("names").get<std::vector<std::string>>();
    LoadedScene loaded;
    ExitStatus status = console.take(load_scene(names, overrides.value(), project), loaded);
    if (status == ExitStatus::Ok) {
        status = console.take(choose_instancing(loaded, project));
    }
    GrownForest grown;
    if (status == ExitStatus::Ok) {
        status = console.take(grow_species(loaded, project, {}), grown);
    }
    if (status == ExitStatus::Ok) {
        status = console.take(place_forest(loaded.scene, project, grown));
    }
    std::vector<std::vector<InstanceMeshes>> meshes;
    if (status == ExitStatus::Ok && options.instance_kind != ForestInstances::Lods) {
        status = console.take(mesh_forest(grown, options.mesh, project), meshes);
    }
    std::optional<Mesh> ground;
    if (status == ExitStatus::Ok) {
        status = make_ground(target.value(), grown, context, ground);
    }
    if (status != ExitStatus::Ok) {
        return status;
    }
    return lsys::write_forest(
        {options, target.value(), context, loaded.scene, meshes, ground ? &*ground : nullptr},
        grown);
}

} // namespace

Outcome<void> write_plant(Session& session, const Json& request, Answer& answer) {
    return collect(session, answer, [&](const OutputContext& context) {
        return write_grown(request, session, context);
    });
}

Outcome<void> write_forest(Session& session, const Json& request, Answer& answer) {
    return collect(session, answer, [&](const OutputContext& context) {
        return write_placed(request, session, context);
    });
}

} // namespace lsys::web
