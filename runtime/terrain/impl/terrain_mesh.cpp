// SPDX-License-Identifier: MIT
// A regular grid over the ground. Diagonals alternate, so that no direction is favoured.
#include "runtime/base/workers.h"
#include "runtime/terrain/terrain.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace lsys {

namespace {

float coordinate(double lowest, double side, std::uint32_t index, std::uint32_t cells) {
    return static_cast<float>(lowest + side * (static_cast<double>(index) / cells));
}

/// Distance of `place` from the begin of the tile that contains it, as a fraction of the side of a
/// tile.
double part_of_tile(double place, double origin, double side) {
    const double tiles = (place - origin) / side;
    return tiles - std::floor(tiles);
}

/// Unit tangent of a surface in the direction of +X.
glm::vec3 tangent_of(const glm::vec3& normal) {
    // normal.y is above 0: the ground is a function of X and Z.
    return glm::normalize(glm::vec3(normal.y, -normal.x, 0.0F));
}

} // namespace

Result<Mesh> make_terrain_mesh(const Terrain& terrain, const TerrainMeshOptions& options) {
    const std::uint64_t columns = options.columns;
    const std::uint64_t rows = options.rows;
    if (columns == 0 || rows == 0) {
        return Error{fmt::format("a mesh of the ground of {} by {} cells; it takes at least 1 by 1",
                                 columns, rows)};
    }
    if (columns * rows > kMaxTerrainCells) {
        return Error{fmt::format("a mesh of the ground of {} by {} cells; the most is {}", columns,
                                 rows, kMaxTerrainCells)};
    }
    if (!std::isfinite(options.texture_size) || options.texture_size < 0.0) {
        return Error{fmt::format("a texture of the ground of {} m; it must be 0 or more",
                                 options.texture_size)};
    }
    const GroundPictures& pictures = options.pictures;
    if (pictures.colour != nullptr && !(pictures.width > 0.0 && pictures.depth > 0.0)) {
        return Error{fmt::format("tiles of the ground of {} by {} m; they must be above 0",
                                 pictures.width, pictures.depth)};
    }
    const Region& region = terrain.region();
    const bool tiled = pictures.colour != nullptr;
    const double texture_width = tiled                        ? pictures.width
                                 : options.texture_size > 0.0 ? options.texture_size
                                                              : region.width;
    const double texture_depth = tiled                        ? pictures.depth
                                 : options.texture_size > 0.0 ? options.texture_size
                                                              : region.depth;
    // Whole tiles are subtracted first, because floats represent small texture coordinates more
    // exactly.
    const double first_u = tiled ? part_of_tile(region.x, pictures.origin_x, pictures.width) : 0.0;
    const double first_v = tiled ? part_of_tile(region.z, pictures.origin_z, pictures.depth) : 0.0;

    Mesh mesh;
    const std::uint64_t vertices = (columns + 1) * (rows + 1);
    mesh.positions.resize(vertices);
    mesh.normals.resize(vertices);
    mesh.texture_coordinates.resize(vertices);
    mesh.tangents.resize(options.tangents ? vertices : 0);
    LargeVector<std::uint32_t> indices;
    indices.resize(6 * columns * rows);

    Workers workers(options.threads);
    workers.for_each(rows + 1, [&](std::uint64_t row) {
        const double part_z = static_cast<double>(row) / static_cast<double>(rows);
        const float z =
            coordinate(region.z, region.depth, static_cast<std::uint32_t>(row), options.rows);
        for (std::uint32_t column = 0; column <= options.columns; ++column) {
            const std::uint64_t vertex = row * (columns + 1) + column;
            const float x = coordinate(region.x, region.width, column, options.columns);
            const double part_x = static_cast<double>(column) / options.columns;
            mesh.positions[vertex] = {x, terrain.height(x, z), z};
            mesh.normals[vertex] = terrain.normal(x, z);
            mesh.texture_coordinates[vertex] = {
                static_cast<float>(first_u + part_x * region.width / texture_width),
                static_cast<float>(first_v + part_z * region.depth / texture_depth)};
            if (options.tangents) {
                mesh.tangents[vertex] = glm::vec4(tangent_of(mesh.normals[vertex]), 1.0F);
            }
        }
        if (row == rows) {
            return;
        }
        for (std::uint32_t column = 0; column < options.columns; ++column) {
            const auto corner = static_cast<std::uint32_t>(row * (columns + 1) + column);
            const std::uint32_t below = corner + options.columns + 1; // the next row, greater z
            std::uint32_t* const to = indices.data() + 6 * (row * columns + column);
            // Triangles are counter-clockwise seen from above, so an edge along Z precedes an edge
            // along X.
            const bool diagonal_at_corner = ((row + column) & 1U) == 0;
            const std::array<std::uint32_t, 6> cell =
                diagonal_at_corner ? std::array<std::uint32_t, 6>{corner, below,     below + 1,
                                                                  corner, below + 1, corner + 1}
                                   : std::array<std::uint32_t, 6>{corner,     below, corner + 1,
                                                                  corner + 1, below, below + 1};
            for (std::size_t i = 0; i < cell.size(); ++i) {
                to[i] = cell[i];
            }
        }
    });
    mesh.indices = std::move(indices);
    Material ground;
    ground.name = "ground";
    // Without a picture, the mean colour of the viewer's default ground, grass with bare patches.
    ground.colour = tiled ? glm::vec4(1.0F) : glm::vec4(0.055F, 0.07F, 0.025F, 1.0F);
    ground.textured = tiled;
    ground.picture = pictures.colour;
    ground.normal_map = tiled ? pictures.normals : nullptr;
    mesh.materials.push_back(ground);
    mesh.parts.push_back({0, 0, mesh.indices.size()});
    return mesh;
}

} // namespace lsys
