// SPDX-License-Identifier: MIT
#include "runtime/export/impl/usda_parts.h"

#include "runtime/export/impl/pictures.h"
#include "runtime/meshing/looks.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace lsys {

namespace {

/// An asset path between `@`, or between `@@@` if the name has an `@`.
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
    const bool normal_map = picture.kind == PictureKind::NormalMap;
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
                        shader, asset_path(picture.name), normal_map ? "raw" : "sRGB", wrap, path,
                        normal_map ? "                float4 inputs:scale = (2, 2, 2, 1)\n"
                                     "                float4 inputs:bias = (-1, -1, -1, 0)\n"
                                   : ""));
}

void put_material(const Material& material,
                  const MaterialPictures& shown,
                  const std::vector<Picture>& pictures,
                  std::string_view root,
                  const std::string& name,
                  PieceWriter& out) {
    const std::string path = fmt::format("{}/Materials/{}", root, name);
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
    if (shown.normal_map) {
        out.put(fmt::format(
            "                normal3f inputs:normal.connect = <{}/Relief.outputs:rgb>\n", path));
    }
    constexpr double kUsualRoughness = 0.9;
    out.put(fmt::format("                float inputs:roughness = {}\n"
                        "                token outputs:surface\n"
                        "            }}\n",
                        material.roughness ? roughness(material) : kUsualRoughness));
    if (shown.colour || shown.normal_map) {
        out.put("\n            def Shader \"Place\"\n"
                "            {\n"
                "                uniform token info:id = \"UsdPrimvarReader_float2\"\n"
                "                string inputs:varname = \"st\"\n"
                "                float2 outputs:result\n"
                "            }\n");
        put_picture(pictures[*shown.colour], "Picture", path, out);
    }
    if (shown.normal_map) {
        put_picture(pictures[*shown.normal_map], "Relief", path, out);
    }
    out.put("        }\n");
}

} // namespace

std::string usda_place(UpAxis up, LengthUnit unit, const glm::vec3& pivot) {
    // USD applies the last operation of `xformOpOrder` first.
    std::vector<std::string_view> order;
    std::string text;
    if (up == UpAxis::Z) {
        text += "    double xformOp:rotateX = 90\n";
        order.emplace_back("\"xformOp:rotateX\"");
    }
    if (unit != LengthUnit::Metres) {
        text += fmt::format("    double3 xformOp:scale = ({0}, {0}, {0})\n", units_per_metre(unit));
        order.emplace_back("\"xformOp:scale\"");
    }
    if (pivot != glm::vec3(0.0F)) {
        text += fmt::format("    double3 xformOp:translate = ({}, {}, {})\n", 0.0F - pivot.x,
                            0.0F - pivot.y, 0.0F - pivot.z);
        order.emplace_back("\"xformOp:translate\"");
    }
    if (!order.empty()) {
        text += fmt::format("    uniform token[] xformOpOrder = [{}]\n\n", fmt::join(order, ", "));
    }
    return text;
}

std::vector<std::string> usda_part_names(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const MeshPart& part : mesh.parts) {
        names.push_back(unique_name(names, identifier(mesh.materials[part.material].name)));
    }
    return names;
}

void put_usda_surface_head(PieceWriter& out, const UsdaSurface& surface, const Bounds& bounds) {
    const bool two_sided =
        std::any_of(surface.parts.begin(), surface.parts.end(), [&](const MeshPart& part) {
            return surface.mesh.materials[part.material].two_sided;
        });
    out.put(fmt::format("    def Mesh \"{}\"{}\n"
                        "    {{\n"
                        "        uniform token subdivisionScheme = \"none\"\n"
                        "        uniform token orientation = \"rightHanded\"\n"
                        "        uniform bool doubleSided = {}\n",
                        surface.name,
                        surface.put_skin ? " (\n        prepend apiSchemas = "
                                           "[\"SkelBindingAPI\"]\n    )"
                                         : "",
                        two_sided ? 1 : 0));
    const std::optional<int> digits =
        surface.digits ? std::optional<int>(surface.digits->points) : std::nullopt;
    put_list(out, "float3[] extent", 2, [&](std::uint64_t i, char* at) {
        const glm::vec3& corner = i == 0 ? bounds.low : bounds.high;
        return put_tuple<3>(at, {corner.x, corner.y, corner.z}, digits);
    });
    out.put("\n");
}

int place_digits(float size) {
    constexpr double kPart = 1e-5;
    constexpr int kMaxDigits = 9;
    int digits = 0;
    for (double step = 1.0; step > kPart * static_cast<double>(size) && digits < kMaxDigits;
         step /= 10) {
        ++digits;
    }
    return digits;
}

void put_usda_colours(PieceWriter& out,
                      const Looks* looks,
                      std::uint64_t vertices,
                      const std::function<ItemColour(std::uint64_t)>& colour_of) {
    std::vector<ItemColour> palette;            // in the order of their first vertices
    std::map<ItemColour, std::uint32_t> places; // of each colour in `palette`
    ItemColour last = ~ItemColour{0};
    for (std::uint64_t i = 0; i < vertices; ++i) {
        const ItemColour colour = colour_of(i);
        if (colour != std::exchange(last, colour) &&
            places.try_emplace(colour, static_cast<std::uint32_t>(palette.size())).second) {
            palette.push_back(colour);
        }
    }
    put_list(out, "color3f[] primvars:displayColor", palette.size(),
             [&](std::uint64_t i, char* at) {
                 const glm::vec3 c = plain_colour(looks, palette[i]);
                 return put_tuple<3>(at, {c.r, c.g, c.b});
             });
    out.put(fmt::format(" (\n            interpolation = \"{}\"\n        )\n",
                        palette.size() == 1 ? "constant" : "vertex"));
    if (palette.size() > 1) {
        put_list(out, "int[] primvars:displayColor:indices", vertices,
                 [&](std::uint64_t i, char* at) {
                     return put_number(at, std::uint64_t{places.at(colour_of(i))});
                 });
        out.put("\n");
    }
}

void put_usda_subsets(PieceWriter& out, const UsdaSurface& surface) {
    out.put("        uniform token subsetFamily:materialBind:familyType = \"partition\"\n");
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < surface.parts.size(); ++i) {
        const std::uint64_t triangles = surface.parts[i].index_count / 3;
        out.put(fmt::format("\n        def GeomSubset \"{}\" (\n"
                            "            prepend apiSchemas = [\"MaterialBindingAPI\"]\n"
                            "        )\n"
                            "        {{\n"
                            "        uniform token elementType = \"face\"\n"
                            "        uniform token familyName = \"materialBind\"\n",
                            surface.materials[i]));
        put_list(out, "int[] indices", triangles,
                 [first](std::uint64_t face, char* at) { return put_number(at, first + face); });
        out.put(fmt::format("\n        rel material:binding = <{}/Materials/{}>\n        }}\n",
                            surface.root, surface.materials[i]));
        first += triangles;
    }
}

void put_usda_materials(const Mesh& mesh,
                        const std::vector<std::string>& names,
                        const ExportInfo& info,
                        std::string_view root,
                        PieceWriter& out) {
    const Pictures pictures = find_pictures(mesh, ExportPictures::FilesWithNormalMaps, info);
    out.put("\n    def Scope \"Materials\"\n    {\n");
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        const std::uint32_t material = mesh.parts[i].material;
        put_material(mesh.materials[material], pictures.of_materials[material], pictures.list, root,
                     names[i], out);
    }
    out.put("    }\n");
}

} // namespace lsys
