#include "runtime/export/export.h"

#include "runtime/library/impl/call.h"
#include "runtime/library/impl/data.h"

#include <fmt/format.h>

#include <algorithm>
#include <lsys/export.h>
#include <optional>

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
    Call call(project);
    const ::lsys::Plant& drawn = plant.data().plant;
    std::uint64_t bytes = 0;
    const auto work = [&]() -> ::lsys::Outcome<std::uint64_t> {
        const std::optional<ExportFormat> found = find_format(format);
        ::lsys::Messages messages;
        std::string refusal = found ? find_conflict(traits_of(*found), options)
                                    : fmt::format("there is no format `{}`", format);
        if (!refusal.empty()) {
            messages.add_error(std::move(refusal));
            return {Stop::Failed, std::move(messages)};
        }
        ExportInfo info;
        info.grammar = plant.data().grammar;
        info.name = options.name;
        info.seed = drawn.seed;
        info.generations = drawn.generations;
        info.generator = fmt::format("liblsys {}", version());
        info.compression = inner_compression(options.compression);
        info.threads = project.threads;
        info.user_meshes = &drawn.user_meshes;
        info.up = options.up == UpAxis::Z ? ::lsys::UpAxis::Z : ::lsys::UpAxis::Y;
        ::lsys::Outcome<void> written = export_mesh(mesh.data().mesh, drawn.skeleton, *found, info,
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

} // namespace lsys::v0
