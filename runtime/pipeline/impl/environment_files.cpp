// SPDX-License-Identifier: MIT
#include "runtime/pipeline/impl/environment_files.h"

#include "grammar/base/paths.h"
#include "runtime/base/grey_map.h"
#include "runtime/base/jpeg_texels.h"
#include "runtime/base/png_samples.h"
#include "runtime/environment/closed_mesh.h"
#include "runtime/meshing/user_mesh.h"
#include "runtime/pipeline/impl/relative_path_help.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace lsys {

namespace {

/// Luminance of a colour by the primaries of sRGB, whose channels are as stored in the file.
double grey_of(double red, double green, double blue) {
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

Result<EnvironmentPicture> read_png_greys(std::string_view bytes, std::uint64_t max_bytes) {
    constexpr std::size_t kBitDepth = 24; // offset of the bit depth in a PNG file
    PngRequest request;
    request.form = PngForm::SixteenBits;
    request.max_pixels = kMaxMapPixels;
    request.max_bytes = max_bytes;
    request.copy_bytes = sizeof(double);
    request.noun = "map";
    const Result<PngSamples> read = read_png_samples(bytes, request);
    if (!read) {
        return read.error();
    }
    const PngSamples& samples = read.value();
    const bool is_deep = bytes[kBitDepth] == 16;
    // Samples of at most 8 bits are read as 257 times their value.
    const unsigned unit = is_deep ? 1 : 257;
    const double white = is_deep ? 65535.0 : 255.0;
    EnvironmentPicture picture{samples.columns, samples.rows, {}};
    const std::size_t pixels = std::size_t{samples.columns} * samples.rows;
    picture.values.reserve(pixels);
    const auto sample = [&](std::size_t index) {
        const unsigned high = samples.bytes[2 * index];
        return static_cast<double>((high << 8U | samples.bytes[2 * index + 1]) / unit);
    };
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::size_t first = i * samples.channels;
        const double grey = samples.channels < 3
                                ? sample(first)
                                : grey_of(sample(first), sample(first + 1), sample(first + 2));
        picture.values.push_back(grey / white);
    }
    return picture;
}

Result<EnvironmentPicture> read_jpeg_greys(std::string_view bytes, std::uint64_t max_bytes) {
    constexpr double kWhite = 255.0;
    const Result<PictureTexels> read = read_jpeg_texels(bytes, kMaxMapPixels, max_bytes);
    if (!read) {
        return read.error();
    }
    const PictureTexels& texels = read.value();
    EnvironmentPicture picture{texels.columns, texels.rows, {}};
    const std::size_t pixels = std::size_t{texels.columns} * texels.rows;
    picture.values.reserve(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::uint8_t* const texel = texels.bytes.data() + 4 * i;
        picture.values.push_back(grey_of(texel[0], texel[1], texel[2]) / kWhite);
    }
    return picture;
}

class EnvironmentReader {
public:
    EnvironmentReader(const std::filesystem::path& folder,
                      const Grammar& grammar,
                      const Project& project,
                      FileBudget& budget,
                      Diagnostics& diagnostics)
        : folder_(folder), grammar_(grammar), project_(project), budget_(budget),
          diagnostics_(diagnostics) {}

    /// Reads the files of an environment. Returns false after an error.
    bool read(const BytecodeEnvironment& environment, EnvironmentFiles& files) {
        bool ok = true;
        for (const EnvironmentSurface& surface : environment.surfaces) {
            if (surface.path.empty()) {
                continue;
            }
            const Result<void> done = environment.kind == EnvironmentKind::Map
                                          ? read_picture(surface, files.picture)
                                          : read_mesh(surface, environment, files);
            if (!done) {
                ok = false;
                report(done.error(), surface);
            }
        }
        return ok;
    }

private:
    [[nodiscard]] std::string path_to(const EnvironmentSurface& surface) const {
        return path_text(folder_ / path_of(surface.path));
    }

    Result<std::string> read_bytes(const std::string& path) const {
        Result<std::string> bytes =
            project_.host.read_referenced_file(path, {~std::uint64_t{0}, budget_.left});
        if (!bytes) {
            return Error{fmt::format("cannot read `{}`: {}", path, bytes.error().message),
                         bytes.error().kind};
        }
        return bytes;
    }

    Result<void> read_mesh(const EnvironmentSurface& surface,
                           const BytecodeEnvironment& environment,
                           EnvironmentFiles& files) {
        const bool is_shape = environment.kind == EnvironmentKind::Space;
        const std::string path = path_to(surface);
        const Result<std::string> text = read_bytes(path);
        if (!text) {
            return text.error();
        }
        const Result<UserMesh> read = read_obj(text.value(), budget_.left - text.value().size());
        if (!read) {
            return Error{fmt::format("cannot use `{}`: {}", path, read.error().message),
                         read.error().kind};
        }
        Vector3 offset{}; // SpaceEnvironment moves a shape of markers itself
        for (std::size_t axis = 0; axis < offset.size() && !is_shape; ++axis) {
            offset[axis] = static_cast<double>(environment.at[axis]);
        }
        EnvironmentMesh& mesh = files.meshes.emplace_back();
        mesh.vertices.reserve(read.value().positions.size());
        for (const glm::vec3& place : read.value().positions) {
            mesh.vertices.push_back({static_cast<double>(place.x) + offset[0],
                                     static_cast<double>(place.y) + offset[1],
                                     static_cast<double>(place.z) + offset[2]});
        }
        const std::vector<std::uint32_t>& indices = read.value().indices;
        mesh.triangles.reserve(indices.size() / 3);
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            mesh.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
        }
        budget_.take(mesh.vertices.size() * sizeof(Vector3) +
                     mesh.triangles.size() * sizeof(mesh.triangles[0]));
        if (mesh.triangles.empty()) {
            return Error{fmt::format("cannot use `{}`: it has no face", path)};
        }
        if (is_shape && !mesh_closure(mesh).closed) {
            return Error{fmt::format("cannot use `{}` as a shape: it is not closed, so it has no "
                                     "inside",
                                     path)};
        }
        return {};
    }

    Result<void> read_picture(const EnvironmentSurface& surface, EnvironmentPicture& picture) {
        const std::string path = path_to(surface);
        const Result<std::string> bytes = read_bytes(path);
        if (!bytes) {
            return bytes.error();
        }
        const std::uint64_t left = budget_.left - bytes.value().size();
        Result<EnvironmentPicture> read = is_jpeg(bytes.value())
                                              ? read_jpeg_greys(bytes.value(), left)
                                              : read_png_greys(bytes.value(), left);
        if (!read) {
            return Error{fmt::format("cannot use `{}`: {}", path, read.error().message),
                         read.error().kind};
        }
        picture = std::move(read.value());
        budget_.take(picture.values.size() * sizeof(double));
        return {};
    }

    void report(const Error& error, const EnvironmentSurface& surface) {
        const bool is_limit = error.kind == ErrorKind::Limit;
        Diagnostic diagnostic = make_diagnostic(is_limit ? DiagnosticCode::LimitReached
                                                         : DiagnosticCode::EnvironmentFile,
                                                {}, error.message);
        if (surface.site != kNone) {
            const Site& site = grammar_.bytecode.sites[surface.site];
            if (grammar_.is_module_file) {
                const auto file = static_cast<std::size_t>(site.span.file);
                diagnostic.notes.push_back(fmt::format("at {}:{}:{}", grammar_.bytecode.files[file],
                                                       site.line, site.column));
            } else {
                diagnostic.span = site.span;
            }
        }
        diagnostic.help.emplace_back(is_limit ? "raise the limit with `--max-memory`"
                                              : relative_path_help("#sense", folder_, grammar_));
        diagnostics_.add(std::move(diagnostic));
    }

    const std::filesystem::path& folder_;
    const Grammar& grammar_;
    const Project& project_;
    FileBudget& budget_;
    Diagnostics& diagnostics_;
};

} // namespace

std::optional<std::vector<EnvironmentFiles>>
read_environment_files(const std::filesystem::path& folder,
                       const Grammar& grammar,
                       const Project& project,
                       FileBudget& budget,
                       Diagnostics& diagnostics) {
    EnvironmentReader reader(folder, grammar, project, budget, diagnostics);
    std::vector<EnvironmentFiles> files(grammar.bytecode.environments.size());
    bool ok = true;
    for (std::size_t i = 0; i < files.size(); ++i) {
        ok = reader.read(grammar.bytecode.environments[i], files[i]) && ok;
    }
    return ok ? std::optional(std::move(files)) : std::nullopt;
}

} // namespace lsys
