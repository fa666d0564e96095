// SPDX-License-Identifier: MIT
// Wavefront OBJ and MTL (Wavefront Advanced Visualizer manual, appendix B1, copied at
// https://paulbourke.net/dataformats/obj/); `Pr` and `norm` belong to its extension for physically
// based rendering (http://exocortex.com/blog/extending_wavefront_mtl_to_support_pbr). v of texture
// coordinates goes upwards.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/pictures.h"
#include "runtime/export/impl/text.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <vector>

namespace lsys {

namespace {

/// Max bytes of a line: keyword, blanks, nine numbers.
constexpr std::size_t kLineBytes = 16 + 9 * (kNumberBytes + 1);

/// A unique name for each material.
std::vector<std::string> material_names(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const Material& material : mesh.materials) {
        names.push_back(unique_name(names, obj_identifier(material.name)));
    }
    return names;
}

template <std::size_t kCount>
void put_line(PieceWriter& out, std::string_view keyword, const std::array<float, kCount>& values) {
    char* at = put_text(out.room(kLineBytes), keyword);
    for (const float value : values) {
        *at++ = ' ';
        at = put_number(at, value);
    }
    *at++ = '\n';
    out.advance_to(at);
}

char* put_corner(char* at, std::uint64_t vertex, std::uint64_t normal, bool textured) {
    *at++ = ' ';
    const char* const digits = at;
    at = put_number(at, vertex);
    const std::string_view number(digits, static_cast<std::size_t>(at - digits));
    *at++ = '/';
    if (textured) {
        at = put_text(at, number);
    }
    *at++ = '/';
    return vertex == normal ? put_text(at, number) : put_number(at, normal);
}

/// Writes faces. Position, texture coordinate and normal of a corner have the same number.
void put_faces(TriangleReader& indices, const MeshPart& part, bool textured, PieceWriter& out) {
    for (std::uint64_t i = 0; i + 2 < part.index_count && !out.stopped(); i += 3) {
        char* at = out.room(kLineBytes);
        *at++ = 'f';
        for (std::uint64_t corner = i; corner < i + 3; ++corner) {
            const std::uint64_t number = std::uint64_t{indices[part.first_index + corner]} + 1;
            at = put_corner(at, number, number, textured);
        }
        *at++ = '\n';
        out.advance_to(at);
    }
}

/// Normals of the backs of two-sided parts.
struct BackNormals {
    std::uint64_t first = 0; // number of the first one in the file
    /// By vertex of the mesh: number among the back normals, from 1; 0: the vertex is in no
    /// two-sided part. Empty: no part is two-sided.
    LargeVector<std::uint32_t> numbers;
};

bool is_two_sided(const Mesh& mesh, const MeshPart& part) {
    return mesh.materials[part.material].two_sided;
}

BackNormals find_back_normals(const Mesh& mesh) {
    BackNormals backs;
    backs.first = std::uint64_t{mesh.positions.size()} + 1;
    TriangleReader indices(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        if (is_two_sided(mesh, part)) {
            // The 0 is needed: resize() of a LargeVector leaves items uninitialised.
            backs.numbers.resize(mesh.positions.size(), 0);
            for (std::uint64_t i = 0; i < part.index_count; ++i) {
                backs.numbers[indices[part.first_index + i]] = 1;
            }
        }
    }
    std::uint32_t count = 0;
    for (std::uint32_t& number : backs.numbers) {
        number = number != 0 ? ++count : 0;
    }
    return backs;
}

/// The triangles of put_faces() with their last two corners swapped.
void put_back_faces(TriangleReader& indices,
                    const MeshPart& part,
                    const BackNormals& backs,
                    bool textured,
                    PieceWriter& out) {
    for (std::uint64_t i = 0; i + 2 < part.index_count && !out.stopped(); i += 3) {
        char* at = out.room(kLineBytes);
        *at++ = 'f';
        for (const std::uint64_t corner : {i, i + 2, i + 1}) {
            const std::uint32_t vertex = indices[part.first_index + corner];
            at = put_corner(at, std::uint64_t{vertex} + 1, backs.first + backs.numbers[vertex] - 1,
                            textured);
        }
        *at++ = '\n';
        out.advance_to(at);
    }
}

} // namespace

Outcome<void> write_obj(const ExportJob& job, PieceWriter& out) {
    const Mesh& mesh = job.mesh;
    out.put(fmt::format("# {}\n# {}\n# {}, {}\n", one_line(job.info.generator),
                        origin_line(job.info), unit_text(job.info.unit), axis_text(job.info.up)));
    if (!job.info.mtl_name.empty()) {
        // Readers take the rest of the line as the name, blanks included.
        out.put(fmt::format("mtllib {}\n", one_line(job.info.mtl_name)));
    }
    out.put(fmt::format("o {}\n", obj_identifier(plant_name(job.info))));
    for (std::size_t i = 0; i < mesh.positions.size() && !out.stopped(); ++i) {
        const glm::vec3 p = turned(job.info.up, mesh.positions[i]);
        put_line<3>(out, "v", {p.x, p.y, p.z});
    }
    const bool textured = is_complete(mesh, mesh.texture_coordinates);
    for (std::size_t i = 0; textured && i < mesh.positions.size() && !out.stopped(); ++i) {
        const glm::vec2& t = mesh.texture_coordinates[i];
        put_line<2>(out, "vt", {t.x, 1.0F - t.y});
    }
    for (std::size_t i = 0; i < mesh.positions.size() && !out.stopped(); ++i) {
        const glm::vec3 n = turned(job.info.up, mesh.normals[i]);
        put_line<3>(out, "vn", {n.x, n.y, n.z});
    }
    const BackNormals backs = job.info.both_sides ? find_back_normals(mesh) : BackNormals{};
    for (std::size_t i = 0; i < backs.numbers.size() && !out.stopped(); ++i) {
        if (backs.numbers[i] != 0) {
            const glm::vec3 n = turned(job.info.up, glm::vec3(0.0F) - mesh.normals[i]);
            put_line<3>(out, "vn", {n.x, n.y, n.z});
        }
    }
    const std::vector<std::string> names = material_names(mesh);
    TriangleReader indices(mesh.indices);
    for (const MeshPart& part : mesh.parts) {
        out.put(fmt::format("usemtl {}\n", names[part.material]));
        put_faces(indices, part, textured, out);
        if (job.info.both_sides && is_two_sided(mesh, part)) {
            put_back_faces(indices, part, backs, textured, out);
        }
    }
    return finish(out);
}

Outcome<void> write_mtl(const Mesh& mesh, const ExportInfo& info, const ByteSink& sink) {
    if (triangle_count(mesh) == 0) {
        return nothing_to_draw(info.subject);
    }
    return run_within_memory("the file", [&] {
        PieceWriter out(sink);
        out.put(fmt::format("# {}\n# {}\n", one_line(info.generator), origin_line(info)));
        const std::vector<std::string> names = material_names(mesh);
        const Pictures pictures = find_pictures(mesh, ExportPictures::FilesWithOpacity, info);
        const auto put_map = [&](const char* keyword, const std::optional<std::size_t>& number) {
            if (number) { // as with mtllib, blanks are part of the name
                out.put(fmt::format("{} {}\n", keyword, pictures.list[*number].name));
            }
        };
        for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
            const MaterialPictures& shown = pictures.of_materials[i];
            // White beside a picture: the picture contains the colour, and readers multiply the
            // two.
            const glm::vec4 colour = shown.colour
                                         ? glm::vec4(1.0F, 1.0F, 1.0F, mesh.materials[i].colour.a)
                                         : mesh.materials[i].colour;
            out.put(fmt::format("\nnewmtl {}\nKa 0 0 0\nKd {:.4f} {:.4f} {:.4f}\nKs 0 0 0\n"
                                "d {}\nillum 1\nPr {}\n",
                                names[i], srgb(colour.r), srgb(colour.g), srgb(colour.b), colour.a,
                                roughness(mesh.materials[i])));
            put_map("map_Kd", shown.colour);
            put_map("map_d", shown.opacity);
            // Readers differ: three.js and assimp take normals from `norm`, which hides the heights
            // of `map_Bump`; Blender and Babylon take normals from `map_Bump` and skip `norm`.
            put_map("norm", shown.normal_map);
            put_map("map_Bump", shown.normal_map);
        }
        return finish(out);
    });
}

} // namespace lsys
