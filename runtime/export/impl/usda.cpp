// USD as text (OpenUSD, "UsdGeomMesh", "UsdPreviewSurface specification",
// https://openusd.org/release/): one mesh, its parts as subsets bound to materials. v of texture
// coordinates goes upwards.
#include "runtime/export/impl/export_outcome.h"
#include "runtime/export/impl/formats.h"
#include "runtime/export/impl/text.h"
#include "runtime/export/impl/usda_parts.h"

#include <fmt/format.h>

#include <array>
#include <vector>

namespace lsys {

namespace {

/// Index of the part that item `i` of all parts belongs to is found by going on from the last.
struct PartCursor {
    const Mesh& mesh;
    TriangleReader indices{mesh.indices};
    std::size_t part = 0;
    std::uint64_t first = 0; // corners of the parts before

    std::uint32_t index(std::uint64_t corner) {
        while (corner - first >= mesh.parts[part].index_count / 3 * 3) {
            first += mesh.parts[part].index_count / 3 * 3;
            ++part;
        }
        return indices[mesh.parts[part].first_index + (corner - first)];
    }
};

void put_header(const ExportInfo& info, PieceWriter& out) {
    // Strings of USDA are escaped as those of JSON, as far as one_line() leaves anything to escape.
    out.put(fmt::format("#usda 1.0\n"
                        "(\n"
                        "    defaultPrim = \"Plant\"\n"
                        "    doc = \"{}: {}\"\n"
                        "    metersPerUnit = 1\n"
                        "    upAxis = \"Y\"\n"
                        "    customLayerData = {{\n"
                        "        string generator = \"{}\"\n"
                        "        string grammar = \"{}\"\n"
                        "        uint64 seed = {}\n"
                        "        uint n = {}\n"
                        "    }}\n"
                        ")\n\n",
                        json_text(one_line(info.generator)), json_text(origin_line(info)),
                        json_text(one_line(info.generator)), json_text(one_line(info.grammar)),
                        info.seed, info.generations));
}

void put_arrays(const Mesh& mesh, PieceWriter& out) {
    const std::uint64_t triangles = triangle_count(mesh);
    put_list(out, "int[] faceVertexCounts", triangles,
             [](std::uint64_t, char* at) { return put_text(at, "3"); });
    PartCursor cursor{mesh};
    out.put("\n");
    put_list(out, "int[] faceVertexIndices", 3 * triangles, [&cursor](std::uint64_t i, char* at) {
        return put_number(at, std::uint64_t{cursor.index(i)});
    });
    out.put("\n");
    const std::size_t vertices = mesh.positions.size();
    put_list(out, "point3f[] points", vertices, [&mesh](std::uint64_t i, char* at) {
        const glm::vec3& p = mesh.positions[i];
        return put_tuple<3>(at, {p.x, p.y, p.z});
    });
    out.put("\n");
    put_list(out, "normal3f[] normals", vertices, [&mesh](std::uint64_t i, char* at) {
        const glm::vec3& n = mesh.normals[i];
        return put_tuple<3>(at, {n.x, n.y, n.z});
    });
    out.put(" (\n            interpolation = \"vertex\"\n        )\n");
    if (is_complete(mesh, mesh.texture_coordinates)) {
        put_list(out, "texCoord2f[] primvars:st", vertices, [&mesh](std::uint64_t i, char* at) {
            const glm::vec2& t = mesh.texture_coordinates[i];
            return put_tuple<2>(at, {t.x, 1.0F - t.y});
        });
        out.put(" (\n            interpolation = \"vertex\"\n        )\n");
    }
    if (is_complete(mesh, mesh.colours)) {
        put_list(out, "color3f[] primvars:displayColor", vertices,
                 [&mesh](std::uint64_t i, char* at) {
                     const glm::vec3 c = palette_colour(mesh.colours[i]);
                     return put_tuple<3>(at, {c.r, c.g, c.b});
                 });
        out.put(" (\n            interpolation = \"vertex\"\n        )\n");
    }
}

void put_mesh(const Mesh& mesh, const std::vector<std::string>& names, PieceWriter& out) {
    Bounds bounds;
    for (const glm::vec3& position : mesh.positions) {
        bounds.add(position);
    }
    bool two_sided = false;
    for (const MeshPart& part : mesh.parts) {
        two_sided = two_sided || mesh.materials[part.material].two_sided;
    }
    out.put(fmt::format("    def Mesh \"Mesh\"\n"
                        "    {{\n"
                        "        uniform token subdivisionScheme = \"none\"\n"
                        "        uniform token orientation = \"rightHanded\"\n"
                        "        uniform bool doubleSided = {}\n"
                        "        float3[] extent = [({}, {}, {}), ({}, {}, {})]\n",
                        two_sided ? 1 : 0, bounds.low.x, bounds.low.y, bounds.low.z, bounds.high.x,
                        bounds.high.y, bounds.high.z));
    put_arrays(mesh, out);
    out.put("        uniform token subsetFamily:materialBind:familyType = \"partition\"\n");
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        const std::uint64_t triangles = mesh.parts[i].index_count / 3;
        out.put(fmt::format("\n        def GeomSubset \"{}\" (\n"
                            "            prepend apiSchemas = [\"MaterialBindingAPI\"]\n"
                            "        )\n"
                            "        {{\n"
                            "        uniform token elementType = \"face\"\n"
                            "        uniform token familyName = \"materialBind\"\n",
                            names[i]));
        put_list(out, "int[] indices", triangles,
                 [first](std::uint64_t face, char* at) { return put_number(at, first + face); });
        out.put(fmt::format("\n        rel material:binding = </Plant/Materials/{}>\n        }}\n",
                            names[i]));
        first += triangles;
    }
    out.put("    }\n");
}

} // namespace

Outcome<Done> write_usda(const ExportJob& job, PieceWriter& out) {
    const Mesh& mesh = job.mesh;
    const std::vector<std::string> names = usda_part_names(mesh);
    put_header(job.info, out);
    out.put("def Xform \"Plant\" (\n    kind = \"component\"\n)\n{\n");
    put_mesh(mesh, names, out);
    put_usda_materials(mesh, names, job.info, "/Plant", out);
    out.put("}\n");
    return finish(out);
}

} // namespace lsys
