// SPDX-License-Identifier: MIT
#include "runtime/export/impl/gltf_data.h"

#include "runtime/export/impl/formats.h"
#include "runtime/meshing/looks.h"

#include <glm/geometric.hpp>

namespace lsys {

namespace {

glm::vec3 unit(const glm::vec3& v, const glm::vec3& otherwise) {
    const glm::vec3 u = v / glm::length(v);
    return is_unit(u) ? u : otherwise;
}

} // namespace

bool has_vertex_colours(const Mesh& mesh, const MeshPart& part) {
    if (!is_complete(mesh, mesh.colours) || mesh.materials[part.material].picture != nullptr) {
        return false;
    }
    const glm::vec3 material_colour(mesh.materials[part.material].colour);
    std::uint32_t last_colour = ~std::uint32_t{0}; // last index found to have this colour
    TriangleReader indices(mesh.indices);
    for (std::uint64_t i = 0; i < part.index_count; ++i) {
        const ItemColour colour = mesh.colours[indices[part.first_index + i]];
        if (colour != last_colour) {
            if (plain_colour(mesh.looks.get(), colour) != material_colour) {
                return true;
            }
            last_colour = colour;
        }
    }
    return false;
}

glm::vec3 unit_normal(const glm::vec3& normal) {
    return unit(normal, glm::vec3(0.0F, 1.0F, 0.0F));
}

glm::vec4 unit_tangent(const glm::vec4& tangent) {
    const glm::vec3 along = unit(glm::vec3(tangent), glm::vec3(1.0F, 0.0F, 0.0F));
    return glm::vec4(along, tangent.w < 0.0F ? -1.0F : 1.0F);
}

} // namespace lsys
