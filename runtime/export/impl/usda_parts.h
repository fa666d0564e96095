// SPDX-License-Identifier: MIT
// Parts of USDA that the writers of plants and of forests share.
#pragma once

#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/piece_writer.h"
#include "runtime/export/impl/text.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lsys {

inline constexpr std::size_t kUsdaItemsPerLine = 8;
/// Max bytes of an item of put_list() with the separator before it.
inline constexpr std::size_t kUsdaItemBytes = 16 + 3 * (kNumberBytes + 2);

/// The value of `upAxis`.
[[nodiscard]] constexpr std::string_view usda_axis(UpAxis up) {
    return up == UpAxis::Z ? "Z" : "Y";
}
/// Properties of the root prim that turn +Y of its children to the axis of the file.
[[nodiscard]] constexpr std::string_view usda_turn(UpAxis up) {
    return up == UpAxis::Z ? "    double xformOp:rotateX = 90\n"
                             "    uniform token[] xformOpOrder = [\"xformOp:rotateX\"]\n\n"
                           : "";
}
/// The transform of a root prim whose `pivot` in metres is the origin of a file in `unit`.
[[nodiscard]] std::string usda_place(UpAxis up, LengthUnit unit, const glm::vec3& pivot);

/// A unique name for each part.
[[nodiscard]] std::vector<std::string> usda_part_names(const Mesh& mesh);

/// Writes `name = [...]`; put(i, at) writes item i and returns its end.
template <typename Put>
void put_list(PieceWriter& out, std::string_view name, std::uint64_t count, const Put& put) {
    out.put(fmt::format("        {} = [", name));
    for (std::uint64_t i = 0; i < count && !out.stopped(); ++i) {
        char* at = out.room(kUsdaItemBytes);
        at = put_text(at, i == 0 ? "" : i % kUsdaItemsPerLine == 0 ? ",\n            " : ", ");
        out.advance_to(put(i, at));
    }
    out.put("]");
}

template <std::size_t kCount>
[[nodiscard]] char* put_tuple(char* at, const std::array<float, kCount>& values) {
    for (std::size_t i = 0; i < kCount; ++i) {
        at = put_text(at, i == 0 ? "(" : ", ");
        at = put_number(at, values[i]);
    }
    return put_text(at, ")");
}

/// A tuple of numbers with `decimals` decimal places; exact numbers if `decimals` is empty.
template <std::size_t kCount>
[[nodiscard]] char*
put_tuple(char* at, const std::array<float, kCount>& values, const std::optional<int>& decimals) {
    if (!decimals) {
        return put_tuple<kCount>(at, values);
    }
    for (std::size_t i = 0; i < kCount; ++i) {
        at = put_text(at, i == 0 ? "(" : ", ");
        at = put_rounded(at, values[i], *decimals);
    }
    return put_text(at, ")");
}

/// Decimal places of the numbers of a mesh prim.
struct UsdaDigits {
    int points = 9;
    int normals = 4;             // off by at most 0.005 degrees
    int texture_coordinates = 5; // 1/100 of a texel in a picture 1024 texels wide
};
/// Decimal places needed to write positions of a surface to 1/100,000 of `size`, its largest extent
/// in m.
[[nodiscard]] int place_digits(float size);

/// A mesh prim.
struct UsdaSurface {
    const Mesh& mesh; // may have vertices that no triangle of the prim uses
    std::string name;
    std::uint64_t vertices = 0; // count of vertices
    std::span<const MeshPart> parts;
    const std::vector<std::string>& materials; // names of the materials, by part
    std::string_view root;                     // path of the prim of put_usda_materials()
    std::function<void()> put_skin;            // writes properties of a skin; empty: none
    std::optional<UsdaDigits> digits = {};     // empty: exact numbers
};
void put_usda_surface_head(PieceWriter& out, const UsdaSurface& surface, const Bounds& bounds);
void put_usda_subsets(PieceWriter& out, const UsdaSurface& surface);
/// Writes the colours of vertices. `colour_of(i)`: the colour of vertex i.
void put_usda_colours(PieceWriter& out,
                      const Looks* looks,
                      std::uint64_t vertices,
                      const std::function<ItemColour(std::uint64_t)>& colour_of);
/// Writes a mesh prim. `vertex(i)`: the number in the mesh of vertex i of the prim. `turn(v,
/// is_point)`: a vector of the mesh in the coordinates of the prim. `corner(i)`: the vertex of the
/// prim at corner i of the triangles of all parts, called with rising i.
template <typename Vertex, typename Turn, typename Corner>
void put_usda_surface(PieceWriter& out,
                      const UsdaSurface& surface,
                      const Vertex& vertex,
                      const Turn& turn,
                      const Corner& corner) {
    constexpr std::string_view kVertexInterpolation =
        " (\n            interpolation = \"vertex\"\n        )\n";
    const Mesh& mesh = surface.mesh;
    const std::uint64_t vertices = surface.vertices;
    std::uint64_t triangles = 0;
    for (const MeshPart& part : surface.parts) {
        triangles += part.index_count / 3;
    }
    Bounds bounds;
    for (std::uint64_t i = 0; i < vertices; ++i) {
        bounds.add(turn(mesh.positions[vertex(i)], true));
    }
    const auto digits_of = [&surface](int UsdaDigits::*of) {
        return surface.digits ? std::optional<int>((*surface.digits).*of) : std::nullopt;
    };
    put_usda_surface_head(out, surface, bounds);
    put_list(out, "int[] faceVertexCounts", triangles,
             [](std::uint64_t, char* at) { return put_text(at, "3"); });
    out.put("\n");
    put_list(out, "int[] faceVertexIndices", 3 * triangles,
             [&](std::uint64_t i, char* at) { return put_number(at, std::uint64_t{corner(i)}); });
    out.put("\n");
    const auto put_vectors = [&](std::string_view name, const LargeVector<glm::vec3>& from,
                                 bool are_points) {
        const std::optional<int> digits =
            digits_of(are_points ? &UsdaDigits::points : &UsdaDigits::normals);
        put_list(out, name, vertices, [&](std::uint64_t i, char* at) {
            const glm::vec3 v = turn(from[vertex(i)], are_points);
            return put_tuple<3>(at, {v.x, v.y, v.z}, digits);
        });
    };
    put_vectors("point3f[] points", mesh.positions, true);
    out.put("\n");
    put_vectors("normal3f[] normals", mesh.normals, false);
    out.put(kVertexInterpolation);
    if (is_complete(mesh, mesh.texture_coordinates)) {
        put_list(out, "texCoord2f[] primvars:st", vertices, [&](std::uint64_t i, char* at) {
            const glm::vec2& t = mesh.texture_coordinates[vertex(i)];
            return put_tuple<2>(at, {t.x, 1.0F - t.y}, digits_of(&UsdaDigits::texture_coordinates));
        });
        out.put(kVertexInterpolation);
    }
    if (is_complete(mesh, mesh.colours)) {
        put_usda_colours(out, mesh.looks.get(), vertices,
                         [&](std::uint64_t i) { return mesh.colours[vertex(i)]; });
    }
    if (surface.put_skin) {
        surface.put_skin();
    }
    put_usda_subsets(out, surface);
    out.put("    }\n");
}

/// Writes a scope `Materials` within the prim at path `root`: a material for each part of the mesh.
void put_usda_materials(const Mesh& mesh,
                        const std::vector<std::string>& names,
                        const ExportInfo& info,
                        std::string_view root,
                        PieceWriter& out);

} // namespace lsys
