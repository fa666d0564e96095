// SPDX-License-Identifier: MIT
#include "tests/support/meshes.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace lsys::test {

namespace {

void add_vertex(Mesh& mesh,
                const glm::vec3& position,
                const glm::vec3& normal,
                const glm::vec2& texture_coordinate,
                const glm::vec3& tangent,
                std::uint16_t colour) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.texture_coordinates.push_back(texture_coordinate);
    mesh.tangents.push_back(glm::vec4(tangent, 1.0F));
    mesh.colours.push_back(colour);
}

void add_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    for (const std::uint32_t index : {a, b, c, a, c, d}) {
        mesh.indices.push_back(index);
    }
}

void close_part(Mesh& mesh, Material material) {
    const std::uint64_t first =
        mesh.parts.empty() ? 0 : mesh.parts.back().first_index + mesh.parts.back().index_count;
    mesh.parts.push_back(
        {static_cast<std::uint32_t>(mesh.materials.size()), first, mesh.indices.size() - first});
    mesh.materials.push_back(std::move(material));
}

void add_tube(Mesh& mesh,
              const glm::vec3& base,
              std::uint32_t rings,
              std::uint32_t sides,
              std::uint16_t colour) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t ring = 0; ring <= rings; ++ring) {
        const float along = static_cast<float>(ring) / static_cast<float>(rings);
        for (std::uint32_t side = 0; side <= sides; ++side) {
            const float u = static_cast<float>(side) / static_cast<float>(sides);
            const float angle = 2.0F * std::numbers::pi_v<float> * u;
            // `angle` turns from +X towards -Z, so that u runs to the right, seen from outside.
            const glm::vec3 out(std::cos(angle), 0.0F, -std::sin(angle));
            const glm::vec3 around(-std::sin(angle), 0.0F, -std::cos(angle));
            add_vertex(mesh, base + 0.1F * out + glm::vec3(0.0F, 2.0F * along, 0.0F), out,
                       {u, 2.0F - 2.0F * along}, around, colour);
        }
    }
    for (std::uint32_t ring = 0; ring < rings; ++ring) {
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t a = first + ring * (sides + 1) + side;
            add_quad(mesh, a, a + 1, a + sides + 2, a + sides + 1);
        }
    }
}

Material bark() {
    return {.name = "bark",
            .kind = MaterialKind::Bark,
            .colour = glm::vec4(palette_colour(0), 1.0F),
            .textured = true};
}

} // namespace

Mesh triangle_mesh() {
    Mesh mesh;
    mesh.positions = {{0.0F, 0.0F, 0.0F}, {2.0F, 0.0F, 0.0F}, {0.0F, 0.5F, 0.0F}};
    mesh.normals.assign(3, glm::vec3(0.0F, 0.0F, 1.0F));
    mesh.indices = {0, 1, 2};
    close_part(mesh, {.name = "plain red", .colour = {1.0F, 0.0F, 0.0F, 1.0F}});
    return mesh;
}

Mesh cube_mesh() {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (int sign = -1; sign <= 1; sign += 2) {
            glm::vec3 normal(0.0F);
            glm::vec3 right(0.0F);
            normal[axis] = static_cast<float>(sign);
            right[(axis + 1) % 3] = 1.0F;
            const glm::vec3 up = glm::cross(normal, right);
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const auto& [x, y] :
                 {std::array{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
                mesh.positions.push_back(0.5F * (normal + x * right + y * up) +
                                         glm::vec3(0.0F, 0.5F, 0.0F));
                mesh.normals.push_back(normal);
                mesh.texture_coordinates.emplace_back(0.5F + 0.5F * x, 0.5F - 0.5F * y);
            }
            add_quad(mesh, first, first + 1, first + 2, first + 3);
        }
    }
    close_part(mesh, {.name = "colour 7", .colour = glm::vec4(palette_colour(7), 1.0F)});
    return mesh;
}

Mesh tube_mesh(std::uint32_t rings, std::uint32_t sides) {
    Mesh mesh;
    add_tube(mesh, glm::vec3(0.0F), rings, sides, 0);
    close_part(mesh, bark());
    return mesh;
}

Mesh plant_mesh() {
    Mesh mesh = tube_mesh(6, 8);
    for (int leaf = 0; leaf < 5; ++leaf) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const glm::vec3 base(0.1F, 0.3F * static_cast<float>(leaf), 0.0F);
        const glm::vec3 normal(0.0F, 0.0F, 1.0F);
        const glm::vec3 along(1.0F, 0.0F, 0.0F);
        const std::array<glm::vec2, 4> corners{
            {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}};
        for (const glm::vec2& corner : corners) {
            add_vertex(mesh, base + glm::vec3(0.2F * corner.x, 0.1F * corner.y, 0.0F), normal,
                       {corner.x, 1.0F - corner.y}, along, 1);
        }
        add_quad(mesh, first, first + 1, first + 2, first + 3);
    }
    close_part(mesh, {.name = "leaf",
                      .kind = MaterialKind::Leaf,
                      .colour = glm::vec4(palette_colour(1), 1.0F),
                      .two_sided = true,
                      .cut_out = true,
                      .textured = true});
    add_tube(mesh, glm::vec3(0.0F, 2.0F, 0.0F), 1, 5, 2);
    add_tube(mesh, glm::vec3(0.0F, 4.0F, 0.0F), 1, 5, 3);
    close_part(mesh, {.name = "colour \"2\"", .colour = glm::vec4(palette_colour(2), 1.0F)});
    return mesh;
}

Mesh large_mesh(std::uint64_t vertices) {
    constexpr std::uint32_t kRings = 24;
    constexpr std::uint32_t kSides = 8;
    Mesh mesh;
    const std::uint64_t tubes = vertices / ((kRings + 1) * (kSides + 1)) + 1;
    for (std::uint64_t i = 0; i < tubes; ++i) {
        add_tube(mesh,
                 {0.3F * static_cast<float>(i % 1000), 0.0F, 0.3F * static_cast<float>(i / 1000)},
                 kRings, kSides, 0);
    }
    close_part(mesh, bark());
    return mesh;
}

} // namespace lsys::test
