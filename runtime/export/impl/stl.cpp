// SPDX-License-Identifier: MIT
// STL, binary (3D Systems, "StereoLithography interface specification", 1988): 80 bytes of text,
// the number of triangles, and 50 bytes per triangle, with its normal: 0 for a triangle without
// area.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>
#include <cstring>

namespace lsys {

namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kTriangleBytes = 4 * sizeof(glm::vec3) + 2;

} // namespace

Outcome<void> write_stl(const ExportJob& job, PieceWriter& out) {
    const Mesh& mesh = job.mesh;
    // The header must not begin with `solid`, by which readers recognise text files.
    std::string header =
        fmt::format("STL in {}, {}. {}: {}", unit_text(job.info.unit), axis_text(job.info.up),
                    one_line(job.info.generator), origin_line(job.info));
    header.resize(kHeaderBytes, ' ');
    out.put(header);
    const auto count = static_cast<std::uint32_t>(triangle_count(mesh));
    out.put_array(std::span(&count, 1));
    TriangleReader indices(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        std::uint64_t corner = part.first_index;
        for (std::uint64_t i = 0; i < part.index_count / 3 && !out.stopped(); ++i, corner += 3) {
            const glm::vec3 a = turned(job.info.up, mesh.positions[indices[corner]]);
            const glm::vec3 b = turned(job.info.up, mesh.positions[indices[corner + 1]]);
            const glm::vec3 c = turned(job.info.up, mesh.positions[indices[corner + 2]]);
            const glm::vec3 across = glm::cross(b - a, c - a);
            const float length = glm::length(across);
            const glm::vec3 normal = length > 0.0F ? across / length : glm::vec3(0.0F);
            const std::array<glm::vec3, 4> vectors{normal, a, b, c};
            char* const at = out.room(kTriangleBytes);
            std::memcpy(at, vectors.data(), sizeof vectors);
            at[kTriangleBytes - 2] = 0;
            at[kTriangleBytes - 1] = 0;
            out.advance_to(at + kTriangleBytes);
        }
    }
    return finish(out);
}

} // namespace lsys
