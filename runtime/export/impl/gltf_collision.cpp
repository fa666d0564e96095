// SPDX-License-Identifier: MIT
#include "runtime/export/impl/gltf_collision.h"

#include "runtime/export/impl/gltf_items.h"

#include <array>
#include <span>

namespace lsys {

std::uint64_t GltfCollision::position_bytes() const {
    std::uint64_t vertices = 0;
    for (const CollisionShape& shape : shapes) {
        vertices += shape.vertices.size();
    }
    return vertices * sizeof(glm::vec3);
}

std::uint64_t GltfCollision::index_bytes() const {
    std::uint64_t triangles = 0;
    for (const CollisionShape& shape : shapes) {
        triangles += shape.triangles.size();
    }
    return triangles * 3 * sizeof(std::uint16_t);
}

std::uint64_t GltfCollision::byte_count() const {
    return position_bytes() + (index_bytes() + 3) / 4 * 4;
}

void put_collision_nodes(JsonWriter& json, const GltfCollision& collision, std::size_t first_mesh) {
    for (std::size_t i = 0; i < collision.shapes.size(); ++i) {
        json.object().member("name", collision.shapes[i].name).member("mesh", first_mesh + i).end();
    }
}

void put_collision_meshes(JsonWriter& json,
                          const GltfCollision& collision,
                          std::size_t first_accessor) {
    for (std::size_t i = 0; i < collision.shapes.size(); ++i) {
        json.object().member("name", collision.shapes[i].name).array("primitives").object();
        json.object("attributes").member("POSITION", first_accessor + 2 * i).end();
        json.member("indices", first_accessor + 2 * i + 1).end().end().end();
    }
}

void put_collision_accessors(JsonWriter& json,
                             const GltfCollision& collision,
                             std::size_t first_view) {
    std::uint64_t positions = 0;
    std::uint64_t indices = 0;
    for (const CollisionShape& shape : collision.shapes) {
        Bounds bounds;
        for (const glm::vec3& vertex : shape.vertices) {
            bounds.add(vertex);
        }
        const glm::dvec3 low(bounds.low);
        const glm::dvec3 high(bounds.high);
        begin_accessor(json, {first_view, positions, kGltfFloat, shape.vertices.size(), "VEC3"})
            .member("min", {low.x, low.y, low.z})
            .member("max", {high.x, high.y, high.z})
            .end();
        const std::uint64_t corners = 3 * shape.triangles.size();
        begin_accessor(json, {first_view + 1, indices, kGltfUnsignedShort, corners, "SCALAR"})
            .end();
        positions += shape.vertices.size() * sizeof(glm::vec3);
        indices += corners * sizeof(std::uint16_t);
    }
}

void put_collision_views(JsonWriter& json, const GltfCollision& collision, std::uint64_t offset) {
    if (collision.shapes.empty()) {
        return;
    }
    constexpr int kArrayBuffer = 34962;
    constexpr int kElementArrayBuffer = 34963;
    const std::uint64_t bytes = collision.position_bytes();
    json.object().member("buffer", 0).member("byteOffset", offset).member("byteLength", bytes);
    // Required where several accessors share a view of vertices.
    json.member("byteStride", sizeof(glm::vec3)).member("target", kArrayBuffer).end();
    json.object().member("buffer", 0).member("byteOffset", offset + bytes);
    json.member("byteLength", collision.index_bytes()).member("target", kElementArrayBuffer).end();
}

void write_collision(const GltfCollision& collision, const GltfSink& write) {
    for (const CollisionShape& shape : collision.shapes) {
        write(std::as_bytes(std::span(shape.vertices)));
    }
    std::vector<std::uint16_t> indices;
    for (const CollisionShape& shape : collision.shapes) {
        for (const auto& triangle : shape.triangles) {
            for (const std::uint32_t vertex : triangle) {
                indices.push_back(static_cast<std::uint16_t>(vertex));
            }
        }
    }
    indices.resize((indices.size() + 1) / 2 * 2, 0);
    write(std::as_bytes(std::span<const std::uint16_t>(indices)));
}

} // namespace lsys
