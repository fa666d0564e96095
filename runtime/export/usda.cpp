// USD as text (OpenUSD, "UsdGeomMesh", "UsdPreviewSurface specification",
// https://openusd.org/release/): one mesh, its parts as subsets bound to materials. v of texture
// coordinates goes upwards.
#include "runtime/export/formats.h"
#include "runtime/export/pictures.h"
#include "runtime/export/text.h"

#include <fmt/format.h>

#include <array>
#include <vector>

namespace lsys {

namespace {

constexpr std::size_t kItemsOfLine = 8;
constexpr std::size_t kItemBytes = 16 + 3 * (kNumberBytes + 2);

/// Names of the parts, no two alike.
std::vector<std::string> part_names(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const MeshPart& part : mesh.parts) {
        names.push_back(unlike(names, identifier(mesh.materials[part.material].name)));
    }
    return names;
}

/// `name = [...]` with `put(i, at)` for each item.
template <typename Put>
void put_list(PieceWriter& out, std::string_view name, std::uint64_t count, const Put& put) {
    out.put(fmt::format("        {} = [", name));
    for (std::uint64_t i = 0; i < count && !out.stopped(); ++i) {
        char* at = out.room(kItemBytes);
        at = put_text(at, i == 0 ? "" : i % kItemsOfLine == 0 ? ",\n            " : ", ");
        out.used(put(i, at));
    }
    out.put("]");
}

template <std::size_t kCount>
char* put_tuple(char* at, const std::array<float, kCount>& values) {
    for (std::size_t i = 0; i < kCount; ++i) {
        at = put_text(at, i == 0 ? "(" : ", ");
        at = put_number(at, values[i]);
    }
    return put_text(at, ")");
}

/// Index of the part that item `i` of all parts belongs to is found by going on from the last.
struct PartCursor {
    const Mesh& mesh;
    std::size_t part = 0;
    std::uint64_t first = 0; // corners of the parts before

    std::uint32_t index(std::uint64_t corner) {
        while (corner - first >= mesh.parts[part].index_count / 3 * 3) {
            first += mesh.parts[part].index_count / 3 * 3;
            ++part;
        }
        return mesh.indices[mesh.parts[part].first_index + (corner - first)];
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

/// Between signs of an asset path, of which a name with such a sign needs three.
std::string asset_path(const std::string& name) {
    if (name.find('@') == std::string::npos) {
        return fmt::format("@./{}@", name);
    }
    std::string path = name;
    for (std::size_t at = 0; (at = path.find("@@@", at)) != std::string::npos; at += 4) {
        path.insert(at, 1, '\\');
    }
    return fmt::format("@@@./{}@@@", path);
}

/// A shader that reads a picture at the texture coordinates.
void put_picture(const Picture& picture,
                 std::string_view shader,
                 const std::string& path,
                 PieceWriter& out) {
    const bool relief = picture.kind == PictureKind::Relief;
    const char* const wrap = picture.material == MaterialKind::Leaf ? "clamp" : "repeat";
    out.put(fmt::format("\n            def Shader \"{0}\"\n"
                        "            {{\n"
                        "                uniform token info:id = \"UsdUVTexture\"\n"
                        "                asset inputs:file = {1}\n"
                        "                token inputs:sourceColorSpace = \"{2}\"\n"
                        "                token inputs:wrapS = \"{3}\"\n"
                        "                token inputs:wrapT = \"{3}\"\n"
                        "                float2 inputs:st.connect = <{4}/Place.outputs:result>\n"
                        "{5}"
                        "                float3 outputs:rgb\n"
                        "                float outputs:a\n"
                        "            }}\n",
                        shader, asset_path(picture.name), relief ? "raw" : "sRGB", wrap, path,
                        relief ? "                float4 inputs:scale = (2, 2, 2, 1)\n"
                                 "                float4 inputs:bias = (-1, -1, -1, 0)\n"
                               : ""));
}

void put_material(const Material& material,
                  const MaterialPictures& shown,
                  const std::vector<Picture>& pictures,
                  const std::string& name,
                  PieceWriter& out) {
    const std::string path = "/Plant/Materials/" + name;
    const glm::vec4& colour = material.colour;
    out.put(fmt::format("        def Material \"{0}\"\n"
                        "        {{\n"
                        "            token outputs:surface.connect = "
                        "<{1}/Surface.outputs:surface>\n\n"
                        "            def Shader \"Surface\"\n"
                        "            {{\n"
                        "                uniform token info:id = \"UsdPreviewSurface\"\n",
                        name, path));
    if (shown.colour) {
        out.put(fmt::format(
            "                color3f inputs:diffuseColor.connect = <{}/Picture.outputs:rgb>\n",
            path));
    } else {
        out.put(fmt::format("                color3f inputs:diffuseColor = ({}, {}, {})\n",
                            colour.r, colour.g, colour.b));
    }
    if (shown.colour && material.cut_out) {
        out.put(fmt::format("                float inputs:opacity.connect = "
                            "<{}/Picture.outputs:a>\n"
                            "                float inputs:opacityThreshold = 0.5\n",
                            path));
    } else {
        out.put(fmt::format("                float inputs:opacity = {}\n", colour.a));
    }
    if (shown.relief) {
        out.put(fmt::format(
            "                normal3f inputs:normal.connect = <{}/Relief.outputs:rgb>\n", path));
    }
    out.put("                float inputs:roughness = 0.9\n"
            "                token outputs:surface\n"
            "            }\n");
    if (shown.colour) {
        out.put("\n            def Shader \"Place\"\n"
                "            {\n"
                "                uniform token info:id = \"UsdPrimvarReader_float2\"\n"
                "                string inputs:varname = \"st\"\n"
                "                float2 outputs:result\n"
                "            }\n");
        put_picture(pictures[*shown.colour], "Picture", path, out);
    }
    if (shown.relief) {
        put_picture(pictures[*shown.relief], "Relief", path, out);
    }
    out.put("        }\n");
}

void put_materials(const Mesh& mesh,
                   const std::vector<std::string>& names,
                   const ExportInfo& info,
                   PieceWriter& out) {
    const Pictures pictures = find_pictures(mesh, ExportFormat::Usda, info);
    out.put("\n    def Scope \"Materials\"\n    {\n");
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        const std::uint32_t material = mesh.parts[i].material;
        put_material(mesh.materials[material], pictures.of_materials[material], pictures.list,
                     names[i], out);
    }
    out.put("    }\n");
}

} // namespace

void write_usda(const Mesh& mesh, const ExportInfo& info, PieceWriter& out) {
    const std::vector<std::string> names = part_names(mesh);
    put_header(info, out);
    out.put("def Xform \"Plant\" (\n    kind = \"component\"\n)\n{\n");
    put_mesh(mesh, names, out);
    put_materials(mesh, names, info, out);
    out.put("}\n");
}

} // namespace lsys
