// SPDX-License-Identifier: MIT
#include "viewer/app/plant_export.h"

#include "runtime/base/out_of_memory.h"
#include "runtime/output/file_option_parsers.h"
#include "runtime/output/plant_files.h"
#include "runtime/program/host.h"
#include "runtime/program/run_files.h"
#include "viewer/app/output_path.h"

#include <fmt/format.h>

#include <optional>
#include <sstream>
#include <utility>

namespace lsys::view {

namespace {

/// The options of `lsc export` that have the effect of the export settings and of the plant's mesh
/// options.
Result<PlantFileOptions> file_options(const ExportRequest& request) {
    const MeshOptions& mesh = request.options.mesh;
    std::vector<NamedOption> options;
    // The parser needs the method and the level, because they rule out some options of presets
    // (presets.def).
    if (mesh.method == MeshMethod::Solid) {
        options.emplace_back("method", "solid");
    }
    if (mesh.level != 0) {
        options.emplace_back("level", fmt::format("{}", mesh.level));
    }
    if (request.settings.lods != 0) {
        options.emplace_back("lods", fmt::format("{}", request.settings.lods));
    }
    if (!request.settings.preset.empty()) {
        options.emplace_back("preset", request.settings.preset);
    }
    Result<PlantFileOptions> files = parse_plant_files(request.settings.file, options);
    if (files) {
        files.value().mesh = mesh;
    }
    return files;
}

std::string unknown_format(const std::string& file) {
    return fmt::format("`{}` has no extension of a known format, such as .glb, .obj, .usda", file);
}

/// Writes the files of a request.
ExitStatus write(const ExportRequest& request, const OutputContext& context) {
    const Result<PlantFileOptions> options = file_options(request);
    if (!options) {
        return report_error(options.error(), context.console);
    }
    const std::optional<ExportFormat> format = format_of_path(request.settings.file);
    if (!format) {
        return report_error(Error{unknown_format(request.settings.file)}, context.console);
    }
    const std::string conflict = find_conflict(options.value(), *format, context);
    if (!conflict.empty()) {
        return report_error(Error{conflict}, context.console);
    }
    PlantFileReport report;
    return write_plant_files(options.value(), *format,
                             {request.options.file, request.document->grammar},
                             request.document->plant, context, report);
}

} // namespace

std::string export_plant(const ExportRequest& request, const std::atomic<bool>& cancelled) {
    std::istringstream in;
    std::ostringstream out;
    std::ostringstream err;
    RunFiles files;
    note_read(&files, request.inputs);
    Io io{in, out, err, false, &cancelled, "lsview"};
    io.files = &files;
    const Console console(io, request.options.messages);
    const Project project{make_file_host(&cancelled, request.options.run.files),
                          request.options.run.limits,
                          request.options.run.threads,
                          console.options().levels,
                          request.options.run.environments,
                          request.options.run.files};
    const OutputContext context{console, project, "lsview " LSC_VERSION, nullptr, nullptr};
    ExitStatus status = ExitStatus::Limit;
    const auto work = [&] {
        status = write(request, context);
        return true;
    };
    if (!catch_out_of_memory(work, [] { return false; })) {
        console.error("out of memory");
    }
    return status == ExitStatus::Ok ? "Wrote " + request.settings.file : err.str();
}

std::string problem_of_export(const std::string& file) {
    std::string problem = problem_of_output(file);
    return problem.empty() && !format_of_path(file) ? unknown_format(file) : problem;
}

std::vector<std::string> export_presets() {
    std::vector<std::string> names;
    for (const Preset& preset : presets()) {
        if (!preset.plant_formats.empty()) {
            names.emplace_back(preset.name);
        }
    }
    return names;
}

} // namespace lsys::view
