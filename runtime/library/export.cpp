// SPDX-License-Identifier: MIT
#include "runtime/export/export.h"

#include "grammar/base/paths.h"
#include "runtime/library/impl/call.h"
#include "runtime/library/impl/data.h"
#include "runtime/library/impl/file_call.h"
#include "runtime/output/file_option_parsers.h"
#include "runtime/output/plant_files.h"
#include "runtime/output/presets.h"
#include "runtime/pipeline/named_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <lsys/export.h>
#include <optional>
#include <utility>

namespace lsys::v0 {

namespace {

std::optional<ExportFormat> find_format(std::string_view name) {
    for (const ExportFormat format : ::lsys::export_formats()) {
        if (traits_of(format).name == name) {
            return format;
        }
    }
    return std::nullopt;
}

/// The reason why a format does not accept the options; empty if it accepts them.
std::string find_conflict(const FormatTraits& traits, const ExportOptions& options) {
    if (options.compression != Compression::None && !traits.compresses) {
        return fmt::format("the format {} has no compression", traits.name);
    }
    if (options.up != UpAxis::Y && !traits.up_axes) {
        return fmt::format("+Y is up in the format {}", traits.name);
    }
    return {};
}

ExportCompression inner_compression(Compression compression) {
    switch (compression) {
    case Compression::None:
        break;
    case Compression::Quantize:
        return ExportCompression::Quantize;
    case Compression::Meshopt:
        return ExportCompression::Meshopt;
    }
    return ExportCompression::None;
}

/// Writes the files of a plant. Precondition: the options have been parsed, and do not conflict.
ExitStatus write_grown(const PlantFileOptions& options,
                       ExportFormat format,
                       const Plant::Data& plant,
                       const OutputContext& context) {
    PlantFileReport report;
    PlantOptions again = plant.options;
    again.height = options.height ? options.height : again.height;
    again.stream = again.stream || options.stream;
    if (options.grow) {
        ::lsys::Grammar grammar = copy_of(plant.grammar.data().grammar);
        ::lsys::Plant last;
        return write_growth_files(options, format, again, grammar, context, report, last);
    }
    if (!options.height) {
        return write_plant_files(options, format, {again.file, plant.grammar.data().grammar},
                                 plant.plant, context, report);
    }
    ::lsys::Grammar grammar = copy_of(plant.grammar.data().grammar);
    ::lsys::Plant grown;
    const ExitStatus status =
        context.console.take(grow_plant(again, grammar, context.project), grown);
    return status == ExitStatus::Ok
               ? write_plant_files(options, format, {again.file, grammar}, grown, context, report)
               : status;
}

/// The files that the grammar of a plant names, and those that its growth has read.
std::vector<std::string> inputs_of(const Plant::Data& plant) {
    const Grammar::Data& read = plant.grammar.data();
    std::vector<std::string> inputs = named_files(read.grammar.bytecode, read.file);
    inputs.insert(inputs.end(), read.inputs.begin(), read.inputs.end());
    inputs.insert(inputs.end(), plant.inputs.begin(), plant.inputs.end());
    return inputs;
}

/// Writes a mesh of a plant, unchanged. Stops with a message if no format has this name, or if it
/// does not accept the options.
::lsys::Outcome<void> write_mesh(const Plant::Data& plant,
                                 const Mesh& mesh,
                                 std::string_view format,
                                 const ExportOptions& options,
                                 std::uint32_t threads,
                                 const ByteSink& sink) {
    const std::optional<ExportFormat> found = find_format(format);
    std::string refusal = found ? find_conflict(traits_of(*found), options)
                                : fmt::format("there is no format `{}`", format);
    if (!refusal.empty()) {
        ::lsys::Messages messages;
        messages.add_error(std::move(refusal));
        return {Stop::Failed, std::move(messages)};
    }
    ExportInfo info;
    info.grammar = path_text(path_of(plant.options.file).filename());
    info.name = options.name;
    info.seed = plant.plant.seed;
    info.generations = plant.plant.generations;
    info.generator = fmt::format("liblsys {}", version());
    info.compression = inner_compression(options.compression);
    info.threads = threads;
    info.user_meshes = &plant.plant.user_meshes;
    info.up = options.up == UpAxis::Z ? ::lsys::UpAxis::Z : ::lsys::UpAxis::Y;
    return export_mesh(*mesh.data().mesh, plant.plant.skeleton, *found, info, sink);
}

Outcome<std::vector<std::string>> write_plant_to(const Plant& plant,
                                                 const std::string& path,
                                                 const FileReceiver* receive,
                                                 const Options& options,
                                                 const Project& project) {
    const Grammar::Data& read = plant.data().grammar.data();
    Call call(project, {read.file}, read.policy);
    const auto write = [&](const OutputContext& context) {
        const Result<PlantFileOptions> parsed = parse_plant_files(path, options);
        if (!parsed) {
            return report_error(parsed.error(), context.console);
        }
        const PlantFileOptions& file_options = parsed.value();
        const std::optional<ExportFormat> format =
            file_options.format ? file_options.format : ::lsys::format_of_path(path);
        if (!format) {
            return report_error(
                Error{fmt::format("`{}` has no extension of a known format: {}", path,
                                  format_names("or", [](const FormatTraits&) { return true; }))},
                context.console);
        }
        const std::string conflict = find_conflict(file_options, *format, context);
        return conflict.empty() ? write_grown(file_options, *format, plant.data(), context)
                                : report_error(Error{conflict}, context.console);
    };
    return call.run<std::vector<std::string>>(
        [&] { return write_files(call, receive, inputs_of(plant.data()), write); },
        [](std::vector<std::string> paths) { return paths; });
}

} // namespace

const std::vector<std::string>& export_formats() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const ExportFormat format : ::lsys::export_formats()) {
            all.emplace_back(traits_of(format).name);
        }
        return all;
    }();
    return names;
}

std::string format_of_path(std::string_view path) {
    const std::optional<ExportFormat> format = ::lsys::format_of_path(path);
    return format ? std::string(traits_of(*format).name) : std::string();
}

Outcome<std::uint64_t> export_plant(const Plant& plant,
                                    const Mesh& mesh,
                                    std::string_view format,
                                    const std::function<bool(std::string_view piece)>& write,
                                    const ExportOptions& options,
                                    const Project& project) {
    const Grammar::Data& read = plant.data().grammar.data();
    Call call(project, {read.file}, read.policy);
    std::uint64_t bytes = 0;
    const auto work = [&]() -> ::lsys::Outcome<std::uint64_t> {
        ::lsys::Outcome<void> written =
            write_mesh(plant.data(), mesh, format, options, project.threads,
                       call.guarded_sink([&](std::string_view piece) {
                           bytes += piece.size();
                           return write(piece);
                       }));
        if (!written) {
            return {written.stop(), std::move(written.messages())};
        }
        return {bytes, std::move(written.messages())};
    };
    return call.run<std::uint64_t>(work, [](std::uint64_t count) { return count; });
}

Outcome<std::vector<std::string>> save_mesh(const Plant& plant,
                                            const Mesh& mesh,
                                            const std::string& path,
                                            std::string_view format,
                                            const ExportOptions& options,
                                            const Project& project) {
    const Grammar::Data& read = plant.data().grammar.data();
    Call call(project, {read.file}, read.policy);
    const auto write = [&](const OutputContext& context) {
        OutputSet files(context);
        const ExitStatus status = files.add(path, [&](const ByteSink& sink) {
            return write_mesh(plant.data(), mesh, format, options, project.threads, sink);
        });
        return status == ExitStatus::Ok ? files.commit() : status;
    };
    return call.run<std::vector<std::string>>(
        [&] { return write_files(call, nullptr, inputs_of(plant.data()), write); },
        [](std::vector<std::string> paths) { return paths; });
}

const std::vector<std::string>& preset_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const Preset& preset : presets()) {
            all.emplace_back(preset.name);
        }
        return all;
    }();
    return names;
}

std::vector<OptionHelp> describe_options(OptionSet set) {
    const ::lsys::OptionSet inner = set == OptionSet::Plant    ? ::lsys::OptionSet::Plant
                                    : set == OptionSet::Forest ? ::lsys::OptionSet::Forest
                                                               : ::lsys::OptionSet::Scene;
    std::vector<OptionHelp> all;
    for (::lsys::OptionHelp& help : ::lsys::describe_options(inner)) {
        all.push_back({std::move(help.name), std::move(help.value_name), std::move(help.text)});
    }
    return all;
}

Outcome<std::vector<std::string>> save_plant(const Plant& plant,
                                             const std::string& path,
                                             const Options& options,
                                             const Project& project) {
    return write_plant_to(plant, path, nullptr, options, project);
}

Outcome<std::vector<std::string>> write_plant(const Plant& plant,
                                              const std::string& name,
                                              const FileReceiver& receive,
                                              const Options& options,
                                              const Project& project) {
    return write_plant_to(plant, name, &receive, options, project);
}

} // namespace lsys::v0
