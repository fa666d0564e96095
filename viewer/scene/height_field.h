// HeightField: a ground as a grid of heights, for finding where a ray meets it. Cells are two
// triangles, split from their lowest corner along X and Z to the opposite one. A pyramid of
// greatest heights leaves out what a ray flies over (Tevs, Ihrke and Seidel 2008, "Maximum
// mipmaps"), so that no ridge is missed and the time grows with the logarithm of the grid.
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
    /// Of the terrain's region, with so many cells along X and Z, at least 1 each.
    HeightField(const Terrain& terrain, std::uint32_t columns, std::uint32_t rows);

    [[nodiscard]] std::uint32_t columns() const { return columns_; }
    [[nodiscard]] std::uint32_t rows() const { return rows_; }
    /// columns() + 1 heights for each of rows() + 1 rows, m.
    [[nodiscard]] std::span<const float> heights() const { return heights_; }

    /// Where the ray first is on the ground or below it; nowhere if it only flies over it or beside
    /// it.
    [[nodiscard]] std::optional<glm::dvec3> pick(const Ray& ray) const;

private:
    struct Span { // of the ray, in its direction's lengths
        double begin = 0.0;
        double end = 0.0;
    };

    [[nodiscard]] double height_at(std::uint32_t column, std::uint32_t row) const;
    [[nodiscard]] std::optional<Span>
    clip(const Ray& ray, std::uint32_t level, std::uint32_t column, std::uint32_t row) const;
    [[nodiscard]] std::optional<double>
    pick_in_cell(const Ray& ray, const Span& span, std::uint32_t column, std::uint32_t row) const;

    /// Greatest heights of squares of cells; each level has half the sides of the one before.
    struct Level {
        std::uint32_t columns = 0;
        std::uint32_t rows = 0;
        std::vector<float> greatest;
    };

    Region region_;
    std::uint32_t columns_;
    std::uint32_t rows_;
    double step_x_;
    double step_z_;
    std::vector<float> heights_;
    std::vector<Level> levels_; // from single cells to one square
};

} // namespace lsys::view
