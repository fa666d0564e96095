// SPDX-License-Identifier: MIT
// HeightField: a grid of ground heights for ray casting. A cell consists of two triangles, split
// along the diagonal from the corner of lowest x and z. A pyramid of max heights skips cells that
// lie below the ray (Tevs, Ihrke and Seidel 2008, "Maximum mipmaps"): no ridge is missed, and time
// grows with the logarithm of the size of the grid.
#pragma once

#include "runtime/terrain/region.h"
#include "runtime/terrain/terrain.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace lsys::view {

struct Ray {
    glm::dvec3 origin{};    // m
    glm::dvec3 direction{}; // any length
};

class HeightField {
public:
    /// Samples the terrain's region in `columns` by `rows` cells, at least 1 each.
    HeightField(const Terrain& terrain, std::uint32_t columns, std::uint32_t rows);

    [[nodiscard]] std::uint32_t columns() const { return columns_; }
    [[nodiscard]] std::uint32_t rows() const { return rows_; }
    /// Heights in m, in rows() + 1 rows of columns() + 1 heights.
    [[nodiscard]] std::span<const float> heights() const { return heights_; }

    /// First point of the ray that is on the ground or below it; nullopt if the ray passes over the
    /// ground or beside it.
    [[nodiscard]] std::optional<glm::dvec3> pick(const Ray& ray) const;

private:
    struct Span { // parameters of the ray
        double begin = 0.0;
        double end = 0.0;
    };

    [[nodiscard]] double height_at(std::uint32_t column, std::uint32_t row) const; // of a sample
    /// The range of parameters of the ray over a square; nullopt if it passes beside or above it.
    [[nodiscard]] std::optional<Span>
    clip(const Ray& ray, std::uint32_t level, std::uint32_t column, std::uint32_t row) const;
    [[nodiscard]] std::optional<double>
    pick_in_cell(const Ray& ray, const Span& span, std::uint32_t column, std::uint32_t row) const;

    /// Max heights of squares of cells. Each level has half the columns and half the rows of the
    /// level before it, rounded up.
    struct Level {
        std::uint32_t columns = 0;
        std::uint32_t rows = 0;
        std::vector<float> max_heights;
    };

    Region region_;
    std::uint32_t columns_;
    std::uint32_t rows_;
    double step_x_; // m between samples
    double step_z_;
    std::vector<float> heights_; // m, of samples by row
    std::vector<Level> levels_;  // first one square per cell, at last one square
};

} // namespace lsys::view
