// SPDX-License-Identifier: MIT
#include "runtime/export/export.h"

#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/forest_formats.h"
#include "runtime/export/impl/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lsys {

namespace {

constexpr std::array kFormats{
#define LSYS_EXPORT_FORMAT(enumerator, ...) ExportFormat::enumerator,
#include "runtime/export/formats.def"
#undef LSYS_EXPORT_FORMAT
};

/// Indexed by ExportFormat.
constexpr std::array<FormatTraits, kFormats.size()> kTraits{{
#define LSYS_EXPORT_FORMAT(enumerator, function, ...) {__VA_ARGS__, .write = function},
#include "runtime/export/formats.def"
#undef LSYS_EXPORT_FORMAT
}};

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

} // namespace

const FormatTraits& traits_of(ExportFormat format) {
    return kTraits[static_cast<std::size_t>(format)];
}

std::span<const ExportFormat> export_formats() {
    return kFormats;
}

std::optional<ExportFormat> format_of_path(std::string_view path) {
    std::string ending(path);
    std::transform(ending.begin(), ending.end(), ending.begin(), lower);
    for (const ExportFormat format : kFormats) {
        const std::string extension = fmt::format(".{}", traits_of(format).name);
        if (ending.size() > extension.size() && ending.ends_with(extension)) {
            return format;
        }
    }
    return std::nullopt;
}

std::string format_names(std::string_view conjunction,
                         const std::function<bool(const FormatTraits&)>& is_listed) {
    std::vector<std::string_view> names;
    for (const FormatTraits& format : kTraits) {
        if (is_listed(format)) {
            names.push_back(format.name);
        }
    }
    std::sort(names.begin(), names.end());
    const auto before_last = names.empty() ? names.end() : names.end() - 1;
    std::string text = fmt::format("{}", fmt::join(names.begin(), before_last, ", "));
    for (auto last = before_last; last != names.end(); ++last) {
        text += names.size() > 1 ? fmt::format(" {} {}", conjunction, *last) : std::string(*last);
    }
    return text;
}

float units_per_metre(LengthUnit unit) {
    switch (unit) {
    case LengthUnit::Centimetres:
        return 100.0F;
    case LengthUnit::Millimetres:
        return 1000.0F;
    case LengthUnit::Metres:
        break;
    }
    return 1.0F;
}

std::uint64_t triangle_count(const Mesh& mesh) {
    std::uint64_t count = 0;
    for (const MeshPart& part : mesh.parts) {
        count += part.index_count / 3;
    }
    return count;
}

Outcome<void> export_mesh(const Mesh& mesh,
                          const Skeleton& skeleton,
                          ExportFormat format,
                          const ExportInfo& info,
                          const ByteSink& sink) {
    return run_within_memory("the file", [&] {
        const FormatTraits& traits = traits_of(format);
        const std::uint64_t triangles = triangle_count(mesh);
        if (traits.uses_mesh ? triangles == 0
                             : skeleton.segments.empty() && skeleton.objects.empty() &&
                                   skeleton.polygons.empty()) {
            return nothing_to_draw(info.subject);
        }
        if (triangles > traits.max_triangles || mesh.positions.size() > traits.max_vertices) {
            return too_large_for_format(info.subject);
        }
        for (std::size_t i = 0; info.variants != nullptr && i < info.variants->others.size(); ++i) {
            const Mesh& other = info.variants->others[i];
            if (triangle_count(other) == 0) {
                return nothing_to_draw(info.subject);
            }
            if (other.positions.size() > traits.max_vertices) {
                return too_large_for_format(info.subject);
            }
        }
        PieceWriter out(sink);
        return traits.write({mesh, skeleton, info}, out);
    });
}

Outcome<void> write_picture_file(const PictureFile& picture, const ByteSink& sink) {
    PieceWriter out(sink);
    out.put(picture.bytes);
    return finish(out);
}

} // namespace lsys
