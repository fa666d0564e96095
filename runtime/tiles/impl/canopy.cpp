// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/canopy.h"

#include <algorithm>

namespace lsys {

namespace {

/// `base` to the power of `exponent`, interpolated linearly between whole exponents, because
/// std::pow differs between machines.
double power(double base, double exponent) {
    auto whole = static_cast<std::uint64_t>(exponent);
    const double rest = exponent - static_cast<double>(whole);
    double result = 1.0 + rest * (base - 1.0);
    for (; whole != 0; whole /= 2) {
        result *= whole % 2 != 0 ? base : 1.0;
        base *= base;
    }
    return result;
}

} // namespace

void CrownSums::add(const CrownSums& other, double weight) {
    trees += weight * other.trees;
    area += weight * other.area;
    volume += weight * other.volume;
    colour += weight * other.colour;
}

CrownSums sums_of(const Crown& crown, double scale) {
    const double area = crown.area * scale * scale;
    return {1.0, area, area * crown.height * scale, area * crown.colour};
}

CanopyPoint canopy_point(const CrownSums& sums, double ground) {
    CanopyPoint point;
    if (sums.area > 0.0) {
        const double cover_of_tree = sums.area / sums.trees / ground;
        point.cover = 1.0 - power(std::max(0.0, 1.0 - cover_of_tree), sums.trees);
        point.height = point.cover * sums.volume / sums.area;
        point.colour = sums.colour / sums.area;
    }
    return point;
}

Canopy::Canopy(std::uint32_t side, double cell)
    : side_(side), cell_(cell), cells_(std::size_t{side} * side) {}

void Canopy::add(std::uint32_t column, std::uint32_t row, const Crown& crown, double scale) {
    Cell& cell = cells_[std::size_t{row} * side_ + column];
    const CrownSums tree = sums_of(crown, scale);
    ++cell.trees;
    cell.area += static_cast<float>(tree.area);
    cell.volume += static_cast<float>(tree.volume);
    cell.colour += glm::vec3(tree.colour);
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
    CrownSums sums;
    std::uint32_t count = 0;
    for (std::int64_t z = std::max<std::int64_t>(row - 1, 0); z <= row && z < side_; ++z) {
        for (std::int64_t x = std::max<std::int64_t>(column - 1, 0); x <= column && x < side_;
             ++x) {
            const Cell& cell =
                cells_[static_cast<std::size_t>(z) * side_ + static_cast<std::size_t>(x)];
            sums.add({static_cast<double>(cell.trees), static_cast<double>(cell.area),
                      static_cast<double>(cell.volume), glm::dvec3(cell.colour)},
                     1.0);
            ++count;
        }
    }
    return canopy_point(sums, count * cell_ * cell_);
}

} // namespace lsys
