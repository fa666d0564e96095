// SPDX-License-Identifier: MIT
// Checks of what must hold for all meshes, and sizes of meshes for comparison.
#pragma once

#include "runtime/meshing/mesh.h"

#include <catch2/catch.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace lsys::test {

inline glm::dvec3 twice_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
}

/// The number of triangles for which the mean of the vertex normals points to their back.
inline std::size_t triangles_turned_over(const Mesh& mesh) {
    std::size_t turned = 0;
    const LargeVector<std::uint32_t> indices = mesh.indices.expanded();
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const std::uint32_t* const corner = &indices[i];
        const glm::dvec3 front = twice_area(mesh.positions[corner[0]], mesh.positions[corner[1]],
                                            mesh.positions[corner[2]]);
        const glm::vec3 normal =
            mesh.normals[corner[0]] + mesh.normals[corner[1]] + mesh.normals[corner[2]];
        turned += glm::dot(front, glm::dvec3(normal)) > 0.0 ? 0U : 1U;
    }
    return turned;
}

/// Checks that arrays have equal lengths, indices are in range, normals are unit vectors, tangents
/// are unit vectors orthogonal to the normals, every triangle has an area, and parts cover all
/// indices.
inline void check_mesh(const Mesh& mesh, const MeshOptions& options) {
    const std::size_t count = mesh.positions.size();
    REQUIRE(mesh.normals.size() == count);
    REQUIRE(mesh.texture_coordinates.size() == (options.texture_coordinates ? count : 0));
    REQUIRE(mesh.tangents.size() == (options.tangents ? count : 0));
    REQUIRE(mesh.colours.size() == (options.colours ? count : 0));
    REQUIRE(mesh.segments.size() == (options.segments ? count : 0));
    REQUIRE(mesh.indices.size() % 3 == 0);
    std::uint64_t covered = 0;
    for (const MeshPart& part : mesh.parts) {
        REQUIRE(part.first_index == covered);
        REQUIRE(part.material < mesh.materials.size());
        covered += part.index_count;
    }
    REQUIRE(covered == mesh.indices.size());
    std::size_t wrong = 0;
    for (const glm::vec3& normal : mesh.normals) {
        wrong += std::abs(glm::length(normal) - 1.0F) < 1e-4F ? 0U : 1U;
    }
    for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
        const glm::vec3 tangent(mesh.tangents[i]);
        wrong += std::abs(glm::length(tangent) - 1.0F) < 1e-4F &&
                         std::abs(glm::dot(tangent, mesh.normals[i])) < 1e-3F &&
                         std::abs(mesh.tangents[i].w) == 1.0F
                     ? 0U
                     : 1U;
    }
    for (const glm::vec2& place : mesh.texture_coordinates) {
        wrong += std::isfinite(place.x) && std::isfinite(place.y) ? 0U : 1U;
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        for (std::size_t j = 0; j < 3; ++j) {
            REQUIRE(mesh.indices[i + j] < count);
        }
        const glm::dvec3 area =
            twice_area(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                       mesh.positions[mesh.indices[i + 2]]);
        wrong += glm::dot(area, area) > 0.0 ? 0U : 1U;
    }
    CHECK(wrong == 0);
}

/// The number of corners of triangles whose vertex normal points to the back of the triangle.
inline std::size_t corners_turned_over(const Mesh& mesh) {
    std::size_t turned = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 area =
            twice_area(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                       mesh.positions[mesh.indices[i + 2]]);
        for (std::size_t j = 0; j < 3; ++j) {
            turned += glm::dot(area, glm::dvec3(mesh.normals[mesh.indices[i + j]])) > 0.0 ? 0U : 1U;
        }
    }
    return turned;
}

inline Bounds bounds_of(const Mesh& mesh) {
    Bounds bounds;
    for (const std::uint32_t index : mesh.indices.expanded()) {
        bounds.add(mesh.positions[index]);
    }
    return bounds;
}

inline double area_of(const Mesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 area =
            twice_area(mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                       mesh.positions[mesh.indices[i + 2]]);
        sum += 0.5 * std::sqrt(glm::dot(area, area));
    }
    return sum;
}

/// The volume that a closed mesh encloses.
inline double volume_of(const Mesh& mesh) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::dvec3 a(mesh.positions[mesh.indices[i]]);
        const glm::dvec3 b(mesh.positions[mesh.indices[i + 1]]);
        const glm::dvec3 c(mesh.positions[mesh.indices[i + 2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return sum;
}

struct Topology {
    std::size_t vertices = 0;
    std::size_t edges = 0;
    std::size_t triangles = 0;
    std::size_t open_edges = 0;       // edges that do not occur exactly once in each direction
    std::size_t unbalanced_edges = 0; // edges that do not occur equally often in both directions

    [[nodiscard]] std::int64_t euler() const {
        return static_cast<std::int64_t>(vertices + triangles) - static_cast<std::int64_t>(edges);
    }
};

/// Counts vertices, edges and triangles. `place`: returns the number of the vertex for an index.
template <typename Place>
Topology count_edges(const Mesh& mesh, const Place& place) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> edges;
    std::set<std::uint32_t> vertices;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        for (std::size_t j = 0; j < 3; ++j) {
            const std::uint32_t a = place(mesh.indices[i + j]);
            const std::uint32_t b = place(mesh.indices[i + (j + 1) % 3]);
            ++edges[std::minmax(a, b)][a < b ? 0 : 1];
            vertices.insert(a);
        }
    }
    Topology topology;
    topology.vertices = vertices.size();
    topology.edges = edges.size();
    topology.triangles = mesh.indices.size() / 3;
    for (const auto& [edge, uses] : edges) {
        topology.open_edges += uses == std::array{1, 1} ? 0U : 1U;
        topology.unbalanced_edges += uses[0] == uses[1] ? 0U : 1U;
    }
    return topology;
}

/// The topology of a mesh in which vertices at equal positions count as one.
inline Topology topology_of(const Mesh& mesh) {
    std::map<std::array<float, 3>, std::uint32_t> places;
    return count_edges(mesh, [&](std::uint32_t index) {
        const glm::vec3 p = mesh.positions[index] + 0.0F; // turns -0 into 0
        return places.emplace(std::array{p.x, p.y, p.z}, static_cast<std::uint32_t>(places.size()))
            .first->second;
    });
}

inline Topology topology_by_index(const Mesh& mesh) {
    return count_edges(mesh, [](std::uint32_t index) { return index; });
}

} // namespace lsys::test
