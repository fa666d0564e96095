// SPDX-License-Identifier: MIT
// PLY, binary, little endian (Turk, "The PLY polygon file format", 1994). Colours are sRGB; v of
// texture coordinates goes upwards, as readers of `s` and `t` expect.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/text.h"
#include "runtime/meshing/looks.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <map>

namespace lsys {

static_assert(std::endian::native == std::endian::little,
              "arrays are written as they lie in memory");

namespace {

/// Colours of items as bytes.
class ColourBytes {
public:
    explicit ColourBytes(const Looks* looks) : looks_(looks) {}

    const std::array<std::uint8_t, 3>& operator[](ItemColour colour) {
        if (colour != last_) {
            last_ = colour;
            const auto [known, is_new] = bytes_.try_emplace(colour);
            if (is_new) {
                const glm::vec3 c = plain_colour(looks_, colour);
                known->second = {srgb_byte(c.r), srgb_byte(c.g), srgb_byte(c.b)};
            }
            last_bytes_ = known->second;
        }
        return last_bytes_;
    }

private:
    const Looks* looks_;
    std::map<ItemColour, std::array<std::uint8_t, 3>> bytes_;
    ItemColour last_ = ~ItemColour{0}; // the last colour asked for; its bytes are in last_bytes_
    std::array<std::uint8_t, 3> last_bytes_{};
};

template <typename T>
char* put_bytes(char* at, const T& value) {
    std::memcpy(at, &value, sizeof value);
    return at + sizeof value;
}

} // namespace

Outcome<void> write_ply(const ExportJob& job, PieceWriter& out) {
    const Mesh& mesh = job.mesh;
    const bool textured = is_complete(mesh, mesh.texture_coordinates);
    const bool coloured = is_complete(mesh, mesh.colours);
    // `int` if it suffices, because some readers do not support `uint`.
    const bool fits_int = mesh.positions.size() <= std::numeric_limits<std::int32_t>::max();
    out.put(fmt::format("ply\nformat binary_little_endian 1.0\ncomment {}\ncomment {}\n"
                        "comment {}, {}\nelement vertex {}\n"
                        "property float x\nproperty float y\nproperty float z\n"
                        "property float nx\nproperty float ny\nproperty float nz\n{}{}"
                        "element face {}\nproperty list uchar {} vertex_indices\nend_header\n",
                        one_line(job.info.generator), origin_line(job.info),
                        unit_text(job.info.unit), axis_text(job.info.up), mesh.positions.size(),
                        textured ? "property float s\nproperty float t\n" : "",
                        coloured ? "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                 : "",
                        triangle_count(mesh), fits_int ? "int" : "uint"));

    ColourBytes bytes_of(mesh.looks.get());
    constexpr std::size_t kVertexBytes = 2 * sizeof(glm::vec3) + sizeof(glm::vec2) + 3;
    for (std::size_t i = 0; i < mesh.positions.size() && !out.stopped(); ++i) {
        char* at = put_bytes(out.room(kVertexBytes), turned(job.info.up, mesh.positions[i]));
        at = put_bytes(at, turned(job.info.up, mesh.normals[i]));
        if (textured) {
            const glm::vec2& t = mesh.texture_coordinates[i];
            at = put_bytes(at, glm::vec2(t.x, 1.0F - t.y));
        }
        if (coloured) {
            at = put_bytes(at, bytes_of[mesh.colours[i]]);
        }
        out.advance_to(at);
    }
    constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::uint32_t);
    TriangleReader indices(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        std::uint64_t corner = part.first_index;
        for (std::uint64_t i = 0; i < part.index_count / 3 && !out.stopped(); ++i, corner += 3) {
            const std::array corners{indices[corner], indices[corner + 1], indices[corner + 2]};
            char* const at = out.room(kFaceBytes);
            *at = 3;
            out.advance_to(put_bytes(at + 1, corners));
        }
    }
    return finish(out);
}

} // namespace lsys
