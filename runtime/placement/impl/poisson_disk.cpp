// SPDX-License-Identifier: MIT
// PoissonDisk: "Fast Poisson disk sampling in arbitrary dimensions" (Bridson 2007). Around a random
// point of a list of active points, about 30 points are tried in the ring from r to 2r. The first
// point that is at least r away from all other points is added to the list; if none is, the active
// point is removed from the list. Cells of side r / sqrt(2) have at most one point each. The
// algorithm is serial; only species and heights are computed by all threads.
#include "runtime/placement/impl/draws.h"
#include "runtime/placement/impl/methods.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace lsys {

namespace {

/// Number of blocks of draws per active point; each has two attempts. Attempts are points of the
/// square around the ring, which needs no sines. A fraction of 0.589 of them is in the ring: on
/// average 30.6 of 52 attempts; the paper has k = 30.
constexpr std::uint32_t kBlocks = 26;
constexpr std::int64_t kReach = 2; // distance in cells within which points may be too close
constexpr std::uint32_t kNoPoint = 0xFFFFFFFFu;
constexpr std::uint64_t kPiece = 1024; // points

struct Offset {
    std::int64_t cells = 0;   // difference of cell indexes
    std::int64_t squared = 0; // squared distance in cells
};

class DiskSampler {
public:
    explicit DiskSampler(const PlacementOptions& options)
        : options_(options), spacing_(options.spacing),
          side_(options.spacing / std::sqrt(2.0) * (1.0 - 0x1p-10)), // with room for rounding
          columns_(static_cast<std::int64_t>(options.region.width / side_) + 1 + 2 * kReach),
          rows_(static_cast<std::int64_t>(options.region.depth / side_) + 1 + 2 * kReach),
          points_at_(static_cast<std::size_t>(columns_ * rows_), kNoPoint) {
        for (std::int64_t row = -kReach; row <= kReach; ++row) {
            for (std::int64_t column = -kReach; column <= kReach; ++column) {
                neighbourhood_.push_back({row * columns_ + column, row * row + column * column});
            }
        }
        // Nearest cells first: they reject most points.
        std::sort(neighbourhood_.begin(), neighbourhood_.end(),
                  [](const Offset& a, const Offset& b) {
                      return std::pair(a.squared, a.cells) < std::pair(b.squared, b.cells);
                  });
    }

    LargeVector<glm::vec2> sample();

private:
    void add(glm::vec2 point);
    [[nodiscard]] std::optional<glm::vec2> find_around(glm::vec2 centre, std::uint64_t step) const;
    [[nodiscard]] bool is_free(glm::vec2 point) const;
    [[nodiscard]] std::int64_t cell_of(glm::vec2 point) const {
        const auto index = [this](float at, double lowest) {
            return static_cast<std::int64_t>((static_cast<double>(at) - lowest) / side_) + kReach;
        };
        return index(point.y, options_.region.z) * columns_ + index(point.x, options_.region.x);
    }

    const PlacementOptions& options_;
    double spacing_;
    double side_; // m, of a cell
    std::int64_t columns_;
    std::int64_t rows_;
    LargeVector<std::uint32_t> points_at_; // by cell, with a margin of kReach empty cells
    std::vector<Offset> neighbourhood_;    // offsets of a cell's neighbours and of the cell itself
    LargeVector<glm::vec2> points_;
    LargeVector<std::uint32_t> active_; // indices in points_ of the active points
};

void DiskSampler::add(glm::vec2 point) {
    const auto number = static_cast<std::uint32_t>(points_.size());
    points_at_[static_cast<std::size_t>(cell_of(point))] = number;
    points_.push_back(point);
    active_.push_back(number);
}

bool DiskSampler::is_free(glm::vec2 point) const {
    const std::int64_t cell = cell_of(point);
    for (const Offset& offset : neighbourhood_) {
        const std::uint32_t other = points_at_[static_cast<std::size_t>(cell + offset.cells)];
        if (other == kNoPoint) {
            continue;
        }
        const double dx = static_cast<double>(points_[other].x) - static_cast<double>(point.x);
        const double dz = static_cast<double>(points_[other].y) - static_cast<double>(point.y);
        if (dx * dx + dz * dz < spacing_ * spacing_) {
            return false;
        }
    }
    return true;
}

std::optional<glm::vec2> DiskSampler::find_around(glm::vec2 centre, std::uint64_t step) const {
    for (std::uint32_t block = 0; block < kBlocks; ++block) {
        const PhiloxBlock words = placement_draws(options_.key, step, kStepBlock + 1 + block);
        for (std::uint32_t i = 0; i < 4; i += 2) {
            const double dx = (4.0 * unit(words[i]) - 2.0) * spacing_;
            const double dz = (4.0 * unit(words[i + 1]) - 2.0) * spacing_;
            const double squared = dx * dx + dz * dz;
            if (squared < spacing_ * spacing_ || squared > 4.0 * spacing_ * spacing_) {
                continue;
            }
            const glm::vec2 point{static_cast<float>(static_cast<double>(centre.x) + dx),
                                  static_cast<float>(static_cast<double>(centre.y) + dz)};
            if (options_.region.contains(point.x, point.y) && is_free(point)) {
                return point;
            }
        }
    }
    return std::nullopt;
}

LargeVector<glm::vec2> DiskSampler::sample() {
    const Region& region = options_.region;
    const PhiloxBlock first = placement_draws(options_.key, 0, kPlaceBlock);
    add({coordinate_within(region.x, region.width, first[0]),
         coordinate_within(region.z, region.depth, first[1])});
    for (std::uint64_t step = 0; !active_.empty(); ++step) {
        const std::uint32_t chosen =
            number_below(placement_draws(options_.key, step, kStepBlock)[0],
                         static_cast<std::uint32_t>(active_.size()));
        if (const auto point = find_around(points_[active_[chosen]], step)) {
            add(*point);
        } else {
            active_[chosen] = active_.back();
            active_.pop_back();
        }
    }
    return std::move(points_);
}

} // namespace

void place_poisson_disk(const PlacementJob& job, Placement& placement) {
    const LargeVector<glm::vec2> points = DiskSampler(job.options).sample();
    const std::uint64_t pieces = (points.size() + kPiece - 1) / kPiece;
    const auto piece = [&](std::uint64_t index, TreeChunk& chunk) {
        const std::uint64_t end = std::min<std::uint64_t>(points.size(), (index + 1) * kPiece);
        for (std::uint64_t i = index * kPiece; i < end; ++i) {
            job.maker.make(static_cast<std::uint32_t>(i), points[i].x, points[i].y, chunk);
        }
    };
    collect_trees(job.workers, pieces, piece, placement);
}

} // namespace lsys
