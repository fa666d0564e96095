// SPDX-License-Identifier: MIT
// OFF (Geomview's object file format, http://www.geomview.org/docs/html/OFF.html) and OFF+, which
// L3D reads and writes: `x y z u v` for a vertex, and at the end of each face 1 for leaves, else 0.
// Neither format states units or axes. v goes upwards.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/text.h"

#include <fmt/format.h>

namespace lsys {

namespace {

constexpr std::size_t kLineBytes = 8 + 6 * (kNumberBytes + 1);

Outcome<void> write(const Mesh& mesh, UpAxis up, bool plus, PieceWriter& out) {
    out.put(fmt::format("OFF\n{} {} 0\n", mesh.positions.size(), triangle_count(mesh)));
    const bool textured = is_complete(mesh, mesh.texture_coordinates);
    for (std::size_t i = 0; i < mesh.positions.size() && !out.stopped(); ++i) {
        const glm::vec3 p = turned(up, mesh.positions[i]);
        char* at = put_number(out.room(kLineBytes), p.x);
        *at++ = ' ';
        at = put_number(at, p.y);
        *at++ = ' ';
        at = put_number(at, p.z);
        if (plus) {
            const glm::vec2 t = textured ? mesh.texture_coordinates[i] : glm::vec2(0.0F, 1.0F);
            *at++ = ' ';
            at = put_number(at, t.x);
            *at++ = ' ';
            at = put_number(at, 1.0F - t.y);
        }
        *at++ = '\n';
        out.advance_to(at);
    }
    TriangleReader indices(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        const bool leaf = mesh.materials[part.material].kind == MaterialKind::Leaf;
        for (std::uint64_t i = 0; i + 2 < part.index_count && !out.stopped(); i += 3) {
            char* at = out.room(kLineBytes);
            *at++ = '3';
            for (std::uint64_t corner = i; corner < i + 3; ++corner) {
                *at++ = ' ';
                at = put_number(at, std::uint64_t{indices[part.first_index + corner]});
            }
            if (plus) {
                at = put_text(at, leaf ? " 1" : " 0");
            }
            *at++ = '\n';
            out.advance_to(at);
        }
    }
    return finish(out);
}

} // namespace

Outcome<void> write_off(const ExportJob& job, PieceWriter& out) {
    return write(job.mesh, job.info.up, false, out);
}

Outcome<void> write_off_plus(const ExportJob& job, PieceWriter& out) {
    return write(job.mesh, job.info.up, true, out);
}

} // namespace lsys
