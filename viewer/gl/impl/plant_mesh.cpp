// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/plant_mesh.h"

#include <array>
#include <limits>
#include <span>

namespace lsys::view {

namespace {

struct Attribute {
    GLuint location;
    GLint floats; // number of floats per vertex
};
constexpr std::array<Attribute, 4> kAttributes = {{{0, 3}, {1, 3}, {2, 2}, {3, 4}}};
// Locations of uniforms, and binding points, in mesh.frag.glsl.
constexpr GLint kColourLocation = 0;
constexpr GLint kKindLocation = 1;
constexpr GLint kFirstTriangleLocation = 2; // in pick.frag.glsl
constexpr GLuint kBaseTextureUnit = 1;
constexpr GLuint kNormalTextureUnit = 2;

} // namespace

PlantMesh::PlantMesh(Device& device)
    : array_(make_vertex_array(device)), positions_(device), normals_(device),
      texture_coordinates_(device), tangents_(device), indices_(device) {
    for (const Attribute& attribute : kAttributes) {
        glEnableVertexArrayAttrib(array_.name(), attribute.location);
        glVertexArrayAttribFormat(array_.name(), attribute.location, attribute.floats, GL_FLOAT,
                                  GL_FALSE, 0);
        glVertexArrayAttribBinding(array_.name(), attribute.location, attribute.location);
    }
}

void PlantMesh::upload(const Mesh& mesh, const MaterialTextures& textures) {
    positions_.fill(std::span<const glm::vec3>(mesh.positions));
    normals_.fill(std::span<const glm::vec3>(mesh.normals));
    texture_coordinates_.fill(std::span<const glm::vec2>(mesh.texture_coordinates));
    tangents_.fill(std::span<const glm::vec4>(mesh.tangents));
    indices_.allocate(mesh.indices.size() * sizeof(std::uint32_t));
    for_each_chunk(mesh.indices, [&](std::uint64_t first, std::span<const std::uint32_t> part) {
        indices_.write(part, first * sizeof(std::uint32_t));
    });
    glVertexArrayVertexBuffer(array_.name(), 0, positions_.name(), 0, sizeof(glm::vec3));
    glVertexArrayVertexBuffer(array_.name(), 1, normals_.name(), 0, sizeof(glm::vec3));
    glVertexArrayVertexBuffer(array_.name(), 2, texture_coordinates_.name(), 0, sizeof(glm::vec2));
    glVertexArrayVertexBuffer(array_.name(), 3, tangents_.name(), 0, sizeof(glm::vec4));
    glVertexArrayElementBuffer(array_.name(), indices_.name());
    parts_ = mesh.parts;
    materials_ = mesh.materials;
    pictures_.clear();
    normal_maps_.clear();
    for (Material& material : materials_) {
        TextureObject& normal_map = normal_maps_.emplace_back();
        if (material.normal_map != nullptr) {
            normal_map = textures.make_normals(*material.normal_map);
            material.normal_map.reset(); // frees memory
        }
        TextureObject& picture = pictures_.emplace_back();
        if (material.picture != nullptr) {
            picture = textures.make(*material.picture);
            material.picture.reset(); // frees memory
        }
    }
    triangles_ = mesh.indices.size() / 3;
    bounds_ = {};
    for (const glm::vec3& position : mesh.positions) {
        bounds_.add(position);
    }
}

std::uint64_t PlantMesh::draw(MaterialTextures& textures, Pass pass) const {
    const bool shaded = pass == Pass::Colour;
    glBindVertexArray(array_.name());
    std::uint64_t draws = 0;
    for (const MeshPart& part : parts_) {
        const Material& material = materials_[part.material];
        const TextureObject& normal_map = normal_maps_[part.material];
        const bool bumpy = normal_map || (material.textured && material.kind == MaterialKind::Bark);
        const TextureObject& picture = pictures_[part.material];
        const bool is_thin = material.kind == MaterialKind::Leaf ||
                             material.kind == MaterialKind::Flower ||
                             (picture && material.two_sided);
        const int translucency = translucency_step(material, is_thin);
        if (shaded) {
            glUniform4f(kColourLocation, material.colour.r, material.colour.g, material.colour.b,
                        roughness_of(material));
        }
        glUniform4i(kKindLocation, material.textured ? 1 : 0, bumpy ? 1 : 0,
                    material.cut_out ? 1 : 0, translucency);
        if (material.textured) {
            glBindTextureUnit(kBaseTextureUnit,
                              picture ? picture.name() : textures.base_colour(material.kind));
        }
        if (bumpy && shaded) {
            glBindTextureUnit(kNormalTextureUnit,
                              normal_map ? normal_map.name() : textures.bark_normals());
        }
        (material.two_sided ? glDisable : glEnable)(GL_CULL_FACE);
        // The index count of a draw call has at most 31 bits; each call must draw whole triangles.
        constexpr std::uint64_t kMax = std::numeric_limits<GLsizei>::max() / 3 * std::uint64_t{3};
        for (std::uint64_t first = 0; first < part.index_count; first += kMax) {
            const std::uint64_t count = std::min(part.index_count - first, kMax);
            if (pass == Pass::Pick) {
                glUniform1ui(kFirstTriangleLocation,
                             static_cast<GLuint>((part.first_index + first) / 3));
            }
            const std::uintptr_t offset = (part.first_index + first) * sizeof(std::uint32_t);
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                           reinterpret_cast<const void*>(offset)); // NOLINT: OpenGL's signature
            ++draws;
        }
    }
    return draws;
}

} // namespace lsys::view
