// SPDX-License-Identifier: MIT
// A grid for circles of very different sizes. Each plant is listed in every square that the
// bounding box of its circle touches, so overlapping circles share a square. The area of a square
// is the mean area of ground per plant or the mean area of a bounding box, whichever is larger:
// there are at most about as many squares as plants, and on average a few entries per plant.
#include "runtime/placement/impl/crowding.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace lsys {

namespace {

constexpr std::uint64_t kPiece = 2048; // plants

/// A range of squares, both ends included: columns `left` to `right`, rows `top` to `bottom`.
struct SquareRange {
    std::uint32_t left = 0;
    std::uint32_t right = 0;
    std::uint32_t top = 0;
    std::uint32_t bottom = 0;
};

class CrowdGrid {
public:
    CrowdGrid(const Region& region, std::span<const ForestPlant> plants);

    [[nodiscard]] bool is_dominated(std::uint32_t plant) const;

private:
    [[nodiscard]] SquareRange squares_of(const ForestPlant& plant) const;
    [[nodiscard]] std::size_t square(std::uint32_t column, std::uint32_t row) const {
        return std::size_t{row} * columns_ + column;
    }

    const Region& region_;
    std::span<const ForestPlant> plants_;
    double side_ = 1.0; // m, of a square
    std::uint32_t columns_ = 1;
    std::uint32_t rows_ = 1;
    LargeVector<std::uint64_t> starts_;  // first entry of each square; one more at the end
    LargeVector<std::uint32_t> entries_; // indices of plants, square by square
};

CrowdGrid::CrowdGrid(const Region& region, std::span<const ForestPlant> plants)
    : region_(region), plants_(plants) {
    double box_area = 0.0; // m^2, sum over the bounding squares of all plants
    for (const ForestPlant& plant : plants) {
        const auto radius = static_cast<double>(plant.radius);
        box_area += 4.0 * radius * radius;
    }
    const double square_area =
        std::max(region.area(), box_area) / std::max(1.0, static_cast<double>(plants.size()));
    // There are about as many squares as plants, on long, narrow ground too: neither columns nor
    // rows are more than `count` + 1.
    const double count = static_cast<double>(plants.size()) + 1.0;
    side_ = std::max({std::sqrt(square_area), region.width / count, region.depth / count});
    columns_ = static_cast<std::uint32_t>(region.width / side_) + 1;
    rows_ = static_cast<std::uint32_t>(region.depth / side_) + 1;

    const auto for_squares = [this](const ForestPlant& plant, const auto& visit) {
        const SquareRange range = squares_of(plant);
        for (std::uint32_t row = range.top; row <= range.bottom; ++row) {
            for (std::uint32_t column = range.left; column <= range.right; ++column) {
                visit(square(column, row));
            }
        }
    };
    starts_.assign(std::size_t{columns_} * rows_ + 1, 0);
    for (const ForestPlant& plant : plants) {
        for_squares(plant, [this](std::size_t at) { ++starts_[at]; });
    }
    std::uint64_t sum = 0;
    for (std::uint64_t& start : starts_) {
        sum += start;
        start = sum; // end of the entries of the square, which are filled in backwards
    }
    entries_.resize(sum);
    for (std::size_t i = 0; i < plants.size(); ++i) {
        for_squares(plants[i], [this, i](std::size_t at) {
            entries_[--starts_[at]] = static_cast<std::uint32_t>(i);
        });
    }
}

SquareRange CrowdGrid::squares_of(const ForestPlant& plant) const {
    const auto index = [this](double distance, std::uint32_t count) {
        const double last = static_cast<double>(count - 1);
        return static_cast<std::uint32_t>(std::clamp(distance / side_, 0.0, last));
    };
    const auto radius = static_cast<double>(plant.radius);
    const double x = static_cast<double>(plant.place.x) - region_.x;
    const double z = static_cast<double>(plant.place.y) - region_.z;
    return {index(x - radius, columns_), index(x + radius, columns_), index(z - radius, rows_),
            index(z + radius, rows_)};
}

bool CrowdGrid::is_dominated(std::uint32_t number) const {
    const ForestPlant& plant = plants_[number];
    const SquareRange range = squares_of(plant);
    for (std::uint32_t row = range.top; row <= range.bottom; ++row) {
        for (std::uint32_t column = range.left; column <= range.right; ++column) {
            const std::size_t at = square(column, row);
            for (std::uint64_t i = starts_[at]; i < starts_[at + 1]; ++i) {
                const ForestPlant& other = plants_[entries_[i]];
                if (entries_[i] != number && is_stronger(other, plant) &&
                    circles_overlap(other, plant)) {
                    return true;
                }
            }
        }
    }
    return false;
}

} // namespace

void find_dominated(const Region& region, std::span<ForestPlant> plants, Workers& workers) {
    const CrowdGrid grid(region, plants);
    LargeVector<std::uint8_t> dominated(plants.size());
    const std::uint64_t pieces = (plants.size() + kPiece - 1) / kPiece;
    workers.for_each(pieces, [&](std::uint64_t piece) {
        const std::uint64_t end = std::min<std::uint64_t>(plants.size(), (piece + 1) * kPiece);
        for (std::uint64_t i = piece * kPiece; i < end; ++i) {
            dominated[i] = grid.is_dominated(static_cast<std::uint32_t>(i)) ? 1 : 0;
        }
    });
    for (std::size_t i = 0; i < plants.size(); ++i) {
        plants[i].dominated = dominated[i] != 0;
    }
}

} // namespace lsys
