// SPDX-License-Identifier: MIT
// The writers of formats.def. Each writes one whole file and may stop early once the PieceWriter
// has stopped. The mesh has at least one triangle, except for formats that draw the skeleton, and
// at most as many as the format can count; its optional arrays are empty or complete.
#pragma once

#include "runtime/export/impl/piece_writer.h"

#include <glm/vec3.hpp>

#include <string_view>

namespace lsys {

/// Input of a writer.
struct ExportJob {
    const Mesh& mesh;
    const Skeleton& skeleton;
    const ExportInfo& info;
};

// Stops: Cancelled; Failed for a glTF buffer, GLB or USDZ of 4 GiB or more; Limit for a skin of
// more than kMaxJoints joints.
#define LSYS_EXPORT_FORMAT(enumerator, function, ...)                                              \
    Outcome<void> function(const ExportJob& job, PieceWriter& out);
#include "runtime/export/formats.def"
#undef LSYS_EXPORT_FORMAT

/// A point or a direction of the mesh in the axes of the file.
[[nodiscard]] inline glm::vec3 turned(UpAxis up, const glm::vec3& v) {
    return up == UpAxis::Z ? glm::vec3(v.x, 0.0F - v.z, v.y) : v; // 0 - z avoids -0
}
/// "+Y up" or "+Z up".
[[nodiscard]] constexpr std::string_view axis_text(UpAxis up) {
    return up == UpAxis::Z ? "+Z up" : "+Y up";
}

/// Count of the triangles of all parts.
[[nodiscard]] std::uint64_t triangle_count(const Mesh& mesh);
/// Whether an optional array is present and has one item for each vertex.
template <typename Items>
[[nodiscard]] bool is_complete(const Mesh& mesh, const Items& items) {
    return items.size() == mesh.positions.size();
}

} // namespace lsys
