// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/canopy.h"

#include <algorithm>

namespace lsys {

namespace {

/// `base` to the power of `exponent`. std::pow differs between machines.
double power(double base, std::uint64_t exponent) {
    double result = 1.0;
    for (; exponent != 0; exponent /= 2) {
        result *= exponent % 2 != 0 ? base : 1.0;
        base *= base;
    }
    return result;
}

} // namespace

Canopy::Canopy(std::uint32_t side, double cell)
    : side_(side), cell_(cell), cells_(std::size_t{side} * side) {}

void Canopy::add(std::uint32_t column, std::uint32_t row, const Crown& crown, double scale) {
    Cell& cell = cells_[std::size_t{row} * side_ + column];
    const double area = crown.area * scale * scale;
    ++cell.trees;
    cell.area += static_cast<float>(area);
    cell.volume += static_cast<float>(area * crown.height * scale);
    cell.colour += glm::vec3(area * crown.colour);
}

Canopy Canopy::coarser() const {
    Canopy sums(side_ / 2, 2.0 * cell_);
    for (std::uint32_t row = 0; row < side_; ++row) {
        for (std::uint32_t column = 0; column < side_; ++column) {
            const Cell& from = cells_[std::size_t{row} * side_ + column];
            Cell& to = sums.cells_[std::size_t{row / 2} * sums.side_ + column / 2];
            to.trees += from.trees;
            to.area += from.area;
            to.volume += from.volume;
            to.colour += from.colour;
        }
    }
    return sums;
}

CanopyPoint Canopy::at_corner(std::int64_t column, std::int64_t row) const {
    std::uint64_t trees = 0;
    double area = 0.0;
    double volume = 0.0;
    glm::dvec3 colour(0.0);
    std::uint32_t count = 0;
    for (std::int64_t z = std::max<std::int64_t>(row - 1, 0); z <= row && z < side_; ++z) {
        for (std::int64_t x = std::max<std::int64_t>(column - 1, 0); x <= column && x < side_;
             ++x) {
            const Cell& cell =
                cells_[static_cast<std::size_t>(z) * side_ + static_cast<std::size_t>(x)];
            trees += cell.trees;
            area += static_cast<double>(cell.area);
            volume += static_cast<double>(cell.volume);
            colour += glm::dvec3(cell.colour);
            ++count;
        }
    }
    CanopyPoint point;
    if (area > 0.0) {
        // Expected cover if each tree stands anywhere in the cells, independently of the others. Its
        // mean is the same for cells of any size: 1 - exp(-area of crowns / area of ground) for a
        // Poisson process.
        const double cover_of_tree = area / static_cast<double>(trees) / (count * cell_ * cell_);
        point.cover = 1.0 - power(std::max(0.0, 1.0 - cover_of_tree), trees);
        point.height = point.cover * volume / area;
        point.colour = colour / area;
    }
    return point;
}

} // namespace lsys
