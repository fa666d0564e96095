// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/ground_patch.h"

#include <glm/geometric.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace lsys {

std::vector<double> patch_places(double first, double length, std::uint32_t cells) {
    std::vector<double> places;
    for (std::uint32_t i = 0; i < cells + 3; ++i) {
        places.push_back(first + length / cells * (i - 1.0));
    }
    return places;
}

Mesh make_patch(const PatchPlan& plan) {
    const std::uint32_t cells = plan.cells;
    const std::uint32_t side = cells + 1;
    Mesh mesh;
    const auto place = [&plan](double x, double y, double z) {
        return y_up(plan.frame.place(x, y, z));
    };
    const double step_x = plan.region.width / cells;
    const double step_z = plan.region.depth / cells;
    const std::uint32_t wide = side + 2; // vertices along a side, with a border of one cell
    const std::vector<double>& heights = plan.heights;
    const std::size_t first_low = std::size_t{side} * side; // first lower end of a skirt
    const std::size_t vertices = first_low + std::size_t{4} * cells;
    mesh.positions.resize(vertices);
    mesh.normals.resize(vertices);
    mesh.texture_coordinates.resize(vertices);
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const double x = plan.region.x + step_x * column;
            const double z = plan.region.z + step_z * row;
            const std::size_t at = std::size_t{row + 1} * wide + column + 1;
            const std::size_t vertex = std::size_t{row} * side + column;
            mesh.positions[vertex] = glm::vec3(place(x, heights[at], z));
            const glm::dvec3 normal((heights[at - 1] - heights[at + 1]) / (2.0 * step_x), 1.0,
                                    (heights[at - wide] - heights[at + wide]) / (2.0 * step_z));
            mesh.normals[vertex] = glm::vec3(glm::normalize(normal));
            mesh.texture_coordinates[vertex] = plan.texture(column, row, x, z);
        }
    }
    // Triangles are counter-clockwise seen from above. Diagonals alternate in direction, as in
    // make_terrain_mesh().
    LargeVector<std::uint32_t> indices;
    indices.resize(std::size_t{6} * cells * cells + std::size_t{24} * cells);
    std::uint32_t* next_index = indices.data();
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        *next_index++ = a;
        *next_index++ = b;
        *next_index++ = c;
    };
    for (std::uint32_t row = 0; row < cells; ++row) {
        for (std::uint32_t column = 0; column < cells; ++column) {
            const std::uint32_t corner = row * side + column;
            const std::uint32_t below = corner + side;
            if (((row + column) & 1U) == 0) {
                add(corner, below, below + 1);
                add(corner, below + 1, corner + 1);
            } else {
                add(corner, below, corner + 1);
                add(corner + 1, below, below + 1);
            }
        }
    }
    // The vertices of the border, counter-clockwise seen from above: south, east, north and west
    // side.
    std::vector<std::uint32_t> border(std::size_t{4} * cells);
    for (std::uint32_t i = 0; i < cells; ++i) {
        border[i] = cells * side + i;
        border[cells + i] = (cells - i) * side + cells;
        border[2 * cells + i] = cells - i;
        border[3 * cells + i] = i * side;
    }
    for (std::uint32_t i = 0; i < border.size(); ++i) {
        const std::uint32_t vertex = border[i];
        glm::vec3 low = mesh.positions[vertex];
        low.y -= static_cast<float>(plan.skirt);
        mesh.positions[first_low + i] = low;
        mesh.normals[first_low + i] = mesh.normals[vertex];
        mesh.texture_coordinates[first_low + i] = mesh.texture_coordinates[vertex];
    }
    const auto low_of = [first_low](std::uint32_t i) {
        return static_cast<std::uint32_t>(first_low + i);
    };
    for (std::uint32_t i = 0; i < border.size(); ++i) {
        const auto next = static_cast<std::uint32_t>((i + 1) % border.size());
        add(border[i], low_of(i), border[next]);
        add(border[next], low_of(i), low_of(next));
    }
    mesh.indices = TriangleList(std::move(indices));
    mesh.materials.push_back(plan.material);
    mesh.parts.push_back({0, 0, mesh.indices.size()});
    return mesh;
}

Mesh make_level_patch(std::uint32_t cells) {
    const GroundFrame earth(std::nullopt);
    const double side = cells;
    const Region region{0.0, 0.0, side, side};
    const TileFrame frame(earth, glm::dmat4(1.0), region);
    PatchPlan plan{cells, region, frame, 1.0, Material(), {}, {}};
    const std::size_t places = patch_places(0.0, side, cells).size();
    plan.heights.assign(places * places, 0.0);
    plan.texture = [](std::uint32_t, std::uint32_t, double, double) { return glm::vec2(0.0F); };
    return make_patch(plan);
}

} // namespace lsys
