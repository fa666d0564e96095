// The writers of the formats. Each writes one whole file and may stop early once the writer has
// stopped. The mesh has at least one triangle, its optional arrays are empty or complete.
#pragma once

#include "runtime/export/impl/piece_writer.h"

namespace lsys {

void write_obj(const Mesh& mesh, const ExportInfo& info, PieceWriter& out);
void write_ply(const Mesh& mesh, const ExportInfo& info, PieceWriter& out);
/// `plus`: with texture coordinates, and a flag at each face that says whether it is of a leaf.
void write_off(const Mesh& mesh, bool plus, PieceWriter& out);
void write_stl(const Mesh& mesh, const ExportInfo& info, PieceWriter& out);
void write_usda(const Mesh& mesh, const ExportInfo& info, PieceWriter& out);
/// TooLarge where a buffer of glTF would be 4 GiB or more, TooManyJoints; else Ok, stopped or not.
[[nodiscard]] ExportStatus write_gltf(const Mesh& mesh,
                                      const Skeleton& skeleton,
                                      bool binary,
                                      const ExportInfo& info,
                                      PieceWriter& out);
void write_svg(const Skeleton& skeleton, const ExportInfo& info, PieceWriter& out);

/// Triangles of all parts.
[[nodiscard]] std::uint64_t triangle_count(const Mesh& mesh);
/// An optional array that can be used: one item for each vertex.
template <typename Items>
[[nodiscard]] bool is_complete(const Mesh& mesh, const Items& items) {
    return items.size() == mesh.positions.size();
}

} // namespace lsys
