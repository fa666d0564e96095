#include "runtime/export/impl/gltf_primitives.h"

#include "runtime/export/impl/gltf_data.h"

#include <glm/common.hpp>

#include <algorithm>

namespace lsys {

namespace {

constexpr std::uint32_t kUnused = ~std::uint32_t{0};

/// Whether two materials are the same but for name, red, green and blue.
bool differ_in_colour_only(const Material& a, const Material& b) {
    return a.kind == b.kind && a.colour.a == b.colour.a && a.two_sided == b.two_sided &&
           a.cut_out == b.cut_out && a.textured == b.textured && a.picture == b.picture &&
           a.relief == b.relief;
}

bool is_in_range(const glm::vec4& colour) {
    return colour == glm::clamp(colour, 0.0F, 1.0F);
}

/// Gives the primitive a colour for which its materials' colours are fractions.
void merge_colours(const Mesh& mesh, GltfPrimitive& primitive) {
    glm::vec3 most(0.0F);
    for (const GltfPart& part : primitive.parts) {
        most = glm::max(most, glm::vec3(mesh.materials[mesh.parts[part.part].material].colour));
    }
    primitive.colours = GltfColours::Material;
    for (int channel = 0; channel < 3; ++channel) {
        primitive.colour[channel] = most[channel] > 0.0F ? most[channel] : 1.0F;
    }
}

/// Primitives with their parts and colours, without vertices.
std::vector<GltfPrimitive> group_parts(const Mesh& mesh) {
    std::vector<std::vector<GltfPart>> groups;
    std::vector<bool> coloured;
    for (std::uint32_t i = 0; i < mesh.parts.size(); ++i) {
        if (mesh.parts[i].index_count < 3) {
            continue;
        }
        const Material& material = mesh.materials[mesh.parts[i].material];
        const bool own = has_vertex_colours(mesh, mesh.parts[i]);
        std::size_t group = groups.size();
        if (!own && is_in_range(material.colour)) {
            for (group = 0; group < groups.size(); ++group) {
                const MeshPart& first = mesh.parts[groups[group].front().part];
                const Material& other = mesh.materials[first.material];
                if (!coloured[group] && is_in_range(other.colour) &&
                    differ_in_colour_only(material, other)) {
                    break;
                }
            }
        }
        if (group == groups.size()) {
            groups.emplace_back();
            coloured.push_back(own);
        }
        groups[group].push_back({i});
    }
    std::vector<GltfPrimitive> list;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].size() >= kMinMergedMaterials) {
            list.emplace_back().parts = groups[g];
            merge_colours(mesh, list.back());
            continue;
        }
        for (const GltfPart& part : groups[g]) {
            GltfPrimitive& primitive = list.emplace_back();
            primitive.parts = {part};
            if (coloured[g]) {
                primitive.colours = GltfColours::Palette;
            } else {
                primitive.colour = mesh.materials[mesh.parts[part.part].material].colour;
            }
        }
    }
    const auto first_part = [](const GltfPrimitive& a, const GltfPrimitive& b) {
        return a.parts.front().part < b.parts.front().part;
    };
    std::sort(list.begin(), list.end(), first_part);
    return list;
}

} // namespace

Bounds GltfPrimitives::bounds() const {
    Bounds all;
    for (const GltfPrimitive& primitive : list) {
        all.add(primitive.bounds.low);
        all.add(primitive.bounds.high);
    }
    return all;
}

const Material& material_of(const Mesh& mesh, const GltfPrimitive& primitive) {
    return mesh.materials[mesh.parts[primitive.parts.front().part].material];
}

GltfPrimitives plan_gltf_primitives(const Mesh& mesh) {
    GltfPrimitives primitives;
    primitives.list = group_parts(mesh);
    primitives.vertices.reserve(mesh.positions.size());
    // Number of the part that used a vertex last.
    LargeVector<std::uint32_t> users(mesh.positions.size());
    std::fill(users.begin(), users.end(), kUnused);
    TriangleReader indices(mesh.indices);
    for (GltfPrimitive& primitive : primitives.list) {
        primitive.first_vertex = primitives.vertices.size();
        for (GltfPart& part : primitive.parts) {
            part.first_vertex = primitives.vertices.size();
            const MeshPart& triangles = mesh.parts[part.part];
            const std::uint64_t count = triangles.index_count / 3 * 3;
            for (std::uint64_t i = 0; i < count; ++i) {
                const std::uint32_t vertex = indices[triangles.first_index + i];
                if (users[vertex] != part.part) {
                    users[vertex] = part.part;
                    primitives.vertices.push_back(vertex);
                    primitive.bounds.add(mesh.positions[vertex]);
                }
            }
            part.vertex_count = primitives.vertices.size() - part.first_vertex;
            primitive.index_count += count;
        }
        primitive.vertex_count = primitives.vertices.size() - primitive.first_vertex;
    }
    return primitives;
}

} // namespace lsys
