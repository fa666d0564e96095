#include "runtime/export/export.h"

#include "runtime/export/impl/formats.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

namespace lsys {

namespace {

struct Extension {
    std::string_view text; // lower case
    ExportFormat format;
};
constexpr std::array<Extension, 9> kExtensions{{
    {".obj", ExportFormat::Obj},
    {".ply", ExportFormat::Ply},
    {".off", ExportFormat::Off},
    {".off+", ExportFormat::OffPlus},
    {".stl", ExportFormat::Stl},
    {".gltf", ExportFormat::Gltf},
    {".glb", ExportFormat::Glb},
    {".svg", ExportFormat::Svg},
    {".usda", ExportFormat::Usda},
}};

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// STL counts triangles in 32 bits; USDA, whose integers are signed, indices of a face.
bool fits(const Mesh& mesh, ExportFormat format) {
    switch (format) {
    case ExportFormat::Stl:
        return triangle_count(mesh) <= std::numeric_limits<std::uint32_t>::max();
    case ExportFormat::Usda:
        return mesh.positions.size() <= std::uint64_t{std::numeric_limits<std::int32_t>::max()} + 1;
    default:
        return true;
    }
}

ExportStatus write(const Mesh& mesh,
                   const Skeleton& skeleton,
                   ExportFormat format,
                   const ExportInfo& info,
                   const ByteSink& sink) {
    if (uses_mesh(format)
            ? triangle_count(mesh) == 0
            : skeleton.segments.empty() && skeleton.objects.empty() && skeleton.polygons.empty()) {
        return ExportStatus::Nothing;
    }
    if (!fits(mesh, format)) {
        return ExportStatus::TooLarge;
    }
    PieceWriter out(sink);
    ExportStatus status = ExportStatus::Ok;
    switch (format) {
    case ExportFormat::Obj:
        write_obj(mesh, info, out);
        break;
    case ExportFormat::Ply:
        write_ply(mesh, info, out);
        break;
    case ExportFormat::Off:
    case ExportFormat::OffPlus:
        write_off(mesh, format == ExportFormat::OffPlus, out);
        break;
    case ExportFormat::Stl:
        write_stl(mesh, info, out);
        break;
    case ExportFormat::Gltf:
    case ExportFormat::Glb:
        status = write_gltf(mesh, skeleton, format == ExportFormat::Glb, info, out);
        break;
    case ExportFormat::Svg:
        write_svg(skeleton, info, out);
        break;
    case ExportFormat::Usda:
        write_usda(mesh, info, out);
        break;
    }
    if (status == ExportStatus::Ok && !out.finish()) {
        return ExportStatus::Stopped;
    }
    return status;
}

} // namespace

std::optional<ExportFormat> format_of_path(std::string_view path) {
    for (const Extension& extension : kExtensions) {
        if (path.size() > extension.text.size() &&
            std::equal(extension.text.begin(), extension.text.end(),
                       path.end() - static_cast<std::ptrdiff_t>(extension.text.size()),
                       [](char a, char b) { return a == lower(b); })) {
            return extension.format;
        }
    }
    return std::nullopt;
}

bool uses_mesh(ExportFormat format) {
    return format != ExportFormat::Svg;
}

std::uint64_t triangle_count(const Mesh& mesh) {
    std::uint64_t count = 0;
    for (const MeshPart& part : mesh.parts) {
        count += part.index_count / 3;
    }
    return count;
}

ExportStatus export_mesh(const Mesh& mesh,
                         const Skeleton& skeleton,
                         ExportFormat format,
                         const ExportInfo& info,
                         const ByteSink& sink) {
    try {
        return write(mesh, skeleton, format, info, sink);
    } catch (const std::bad_alloc&) {
        return ExportStatus::OutOfMemory;
    } catch (const std::length_error&) {
        return ExportStatus::OutOfMemory;
    }
}

} // namespace lsys
