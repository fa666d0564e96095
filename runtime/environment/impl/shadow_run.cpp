// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/shadow_run.h"

#include <algorithm>
#include <limits>

namespace lsys {

namespace {

constexpr std::int64_t kMaxTablePlaces = std::int64_t{1} << 29; // required by count_by_tables()
constexpr std::int64_t kNoRow = std::numeric_limits<std::int64_t>::max();

/// For the three voxels at -1, 0 and +1 along an axis: 1 if the square of one layer around the
/// voxel contains a place at `distance` voxels from the middle voxel, else 0.
struct Covered {
    std::int64_t middle = 0;
    std::int64_t sides = 0;      // value at +1 plus value at -1
    std::int64_t difference = 0; // value at +1 minus value at -1

    Covered(std::int64_t distance, std::int64_t layer) {
        const auto covers = [&](std::int64_t neighbour) -> std::int64_t {
            return std::abs(distance - neighbour) <= layer ? 1 : 0;
        };
        middle = covers(0);
        sides = covers(1) + covers(-1);
        difference = covers(1) - covers(-1);
    }
};

/// Adds a place to the counts of a layer, seen from the neighbours at `rise` (-1, 0, 1) along y.
void add_pair(LayerCounts& counts,
              const Covered& x,
              const Covered& z,
              std::int64_t rise,
              std::int64_t places) {
    auto& [along_x, along_y, along_z] = counts.differences;
    if (rise == 0) {
        counts.own += places * x.middle * z.middle;
        along_x[0] += places * x.difference * z.middle;
        along_x[1] += places * x.difference * z.sides;
        along_z[0] += places * x.middle * z.difference;
        along_z[1] += places * x.sides * z.difference;
        return;
    }
    along_x[1] += places * x.difference * z.middle;
    along_x[2] += places * x.difference * z.sides;
    along_z[1] += places * x.middle * z.difference;
    along_z[2] += places * x.sides * z.difference;
    along_y[0] += rise * places * x.middle * z.middle;
    along_y[1] += rise * places * (x.sides * z.middle + x.middle * z.sides);
    along_y[2] += rise * places * x.sides * z.sides;
}

} // namespace

std::uint32_t shadow_tile_bits(std::uint32_t levels) {
    std::uint32_t bits = 5;
    while ((std::uint32_t{1} << bits) < levels + 1) {
        ++bits;
    }
    return bits;
}

std::uint64_t shadow_table_bytes(std::uint32_t levels) {
    const std::uint64_t edge = (std::uint64_t{1} << shadow_tile_bits(levels)) + 2 * (levels + 1);
    return 4 * sizeof(std::uint32_t) * SummedAreaTable::cells(edge, edge);
}

std::span<const ShadowSum>
ShadowRun::evaluate(std::size_t tile, std::size_t begin, std::size_t end) {
    find_targets(begin, end);
    find_neighbours(tile);
    read_sources();
    sums_.assign(targets_.size(), ShadowSum{});
    if (prefers_tables()) {
        count_with_tables();
    } else {
        count_pairs();
    }
    return sums_;
}

void ShadowRun::find_targets(std::size_t begin, std::size_t end) {
    targets_.clear();
    std::int32_t low_x = edge_;
    std::int32_t high_x = 0;
    std::int32_t low_z = edge_;
    std::int32_t high_z = 0;
    for (std::size_t voxel = begin; voxel < end; ++voxel) {
        const TileVoxel target = tiles_.voxel(voxel);
        targets_.push_back(target);
        low_x = std::min(low_x, target.x);
        high_x = std::max(high_x, target.x);
        low_z = std::min(low_z, target.z);
        high_z = std::max(high_z, target.z);
    }
    corner_x_ = low_x - reach_;
    corner_z_ = low_z - reach_;
    width_ = high_x - low_x + 1 + 2 * reach_;
    depth_ = high_z - low_z + 1 + 2 * reach_;
    for (TileVoxel& target : targets_) {
        target.x -= corner_x_;
        target.z -= corner_z_;
    }
}

void ShadowRun::find_neighbours(std::size_t tile) {
    neighbours_.clear();
    const std::uint64_t own = tiles_.key(tile);
    const std::array<std::uint64_t, 3> middles{own - tiles_.key_step(), own,
                                               own + tiles_.key_step()};
    for (std::size_t i = 0; i < 3; ++i) {
        std::size_t& cursor = tile_cursors_[i];
        if (!has_cursors_) {
            cursor = tiles_.lower_tile(middles[i] - 1);
        }
        while (cursor < tiles_.tile_count() && tiles_.key(cursor) + 1 < middles[i]) {
            ++cursor;
        }
        for (std::size_t at = cursor; at < tiles_.tile_count() && tiles_.key(at) <= middles[i] + 1;
             ++at) {
            const auto step = static_cast<std::int32_t>(tiles_.key(at) + 1 - middles[i]) - 1;
            add_neighbour(at, edge_ * (static_cast<std::int32_t>(i) - 1) - corner_x_,
                          edge_ * step - corner_z_);
        }
    }
    has_cursors_ = true;
}

/// `x`, `z`: added to coordinates of the tile to get coordinates of the tables, in voxels.
void ShadowRun::add_neighbour(std::size_t tile, std::int32_t x, std::int32_t z) {
    if (x + edge_ <= 0 || x >= width_ || z + edge_ <= 0 || z >= depth_) {
        return;
    }
    Neighbour neighbour{tiles_.first_voxel(tile), tiles_.first_voxel(tile + 1), 0, x, z};
    // The first voxel of the tile that is not below the rows of the run.
    const std::int64_t low_y = targets_.front().y - 1;
    std::size_t end = neighbour.end;
    while (neighbour.next < end) {
        const std::size_t middle = neighbour.next + (end - neighbour.next) / 2;
        if (tiles_.voxel(middle).y < low_y) {
            neighbour.next = middle + 1;
        } else {
            end = middle;
        }
    }
    if (neighbour.next < neighbour.end) {
        neighbour.y = tiles_.voxel(neighbour.next).y;
        neighbours_.push_back(neighbour);
    }
}

void ShadowRun::read_sources() {
    sources_.clear();
    rows_.clear();
    place_count_ = 0;
    const auto width = static_cast<std::uint32_t>(width_); // negative x, as unsigned, is above it
    const auto depth = static_cast<std::uint32_t>(depth_);
    const std::int64_t high_y = targets_.back().y + reach_;
    for (;;) {
        std::int64_t y = kNoRow;
        for (const Neighbour& neighbour : neighbours_) {
            y = std::min(y, neighbour.y);
        }
        const std::size_t first = sources_.size();
        if (y > high_y) {
            rows_.push_back({kNoRow, first});
            return;
        }
        for (Neighbour& neighbour : neighbours_) {
            while (neighbour.y == y) {
                const TileVoxel voxel = tiles_.voxel(neighbour.next);
                const std::int32_t x = voxel.x + neighbour.x;
                const std::int32_t z = voxel.z + neighbour.z;
                // `&`, not `&&`: one branch instead of two that are hard to predict.
                if ((static_cast<std::uint32_t>(x) < width) &
                    (static_cast<std::uint32_t>(z) < depth)) {
                    const auto count =
                        static_cast<std::int64_t>(tiles_.place_count(neighbour.next));
                    sources_.push_back({x, z, count});
                    place_count_ += count;
                }
                ++neighbour.next;
                neighbour.y =
                    neighbour.next < neighbour.end ? tiles_.voxel(neighbour.next).y : kNoRow;
            }
        }
        if (sources_.size() > first) {
            rows_.push_back({y, first});
        }
    }
}

bool ShadowRun::prefers_tables() const {
    constexpr std::uint64_t kCyclesPerCell = 2;
    constexpr std::uint64_t kCyclesPerLayer = 80;
    constexpr std::uint64_t kCyclesPerPair = 30;
    if (place_count_ >= kMaxTablePlaces) {
        return false;
    }
    std::uint64_t pairs = 0;
    std::size_t first_row = 0;
    std::size_t end_row = 0;
    for (const TileVoxel& target : targets_) {
        while (rows_[first_row].y < target.y - 1) {
            ++first_row;
        }
        while (rows_[end_row].y <= target.y + reach_) {
            ++end_row;
        }
        pairs += rows_[end_row].first - rows_[first_row].first;
    }
    const auto cells = static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(depth_);
    const std::uint64_t tables =
        (rows_.size() - 1) * cells * kCyclesPerCell +
        targets_.size() * static_cast<std::uint64_t>(reach_) * kCyclesPerLayer;
    return tables < pairs * kCyclesPerPair;
}

void ShadowRun::count_with_tables() {
    const auto width = static_cast<std::size_t>(width_);
    const auto depth = static_cast<std::size_t>(depth_);
    empty_table_.build(width, depth, {});
    std::size_t row = 0;     // index in rows_ of the first row at y - 1 or above
    std::size_t built = 0;   // index in rows_: the tables of all rows before it are built
    std::size_t active = 0;  // index of the first target that places at y may shade
    std::size_t not_yet = 0; // index of the first target above y
    std::int64_t y = targets_.front().y;
    while (active < targets_.size()) {
        while (not_yet < targets_.size() && targets_[not_yet].y <= y) {
            ++not_yet;
        }
        while (active < not_yet && targets_[active].y < y - layers_.last()) {
            ++active;
        }
        while (rows_[row].y < y - 1) {
            ++row;
        }
        if (active == not_yet) {
            if (active == targets_.size()) {
                return;
            }
            y = targets_[active].y;
            continue;
        }
        if (rows_[row].y == kNoRow) { // no row shades the other targets
            return;
        }
        if (rows_[row].y > y + 1) {
            y = rows_[row].y - 1;
            continue;
        }
        std::array<const SummedAreaTable*, 3> tables{&empty_table_, &empty_table_, &empty_table_};
        built = std::max(built, row);
        for (std::size_t i = row; rows_[i].y <= y + 1; ++i) {
            SummedAreaTable& table = tables_[i % 3];
            if (i >= built) {
                table.build(width, depth, sources_of(i));
                built = i + 1;
            }
            tables[static_cast<std::size_t>(rows_[i].y - y + 1)] = &table;
        }
        for (std::size_t i = active; i < not_yet; ++i) {
            const TileVoxel& target = targets_[i];
            const std::int64_t layer = y - target.y;
            layers_.add(sums_[i], layer, count_by_tables(tables, target.x, target.z, layer));
        }
        ++y;
    }
}

void ShadowRun::count_pairs() {
    std::size_t first_row = 0;
    std::size_t end_row = 0;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
        while (rows_[first_row].y < targets_[i].y - 1) {
            ++first_row;
        }
        while (rows_[end_row].y <= targets_[i].y + reach_) {
            ++end_row;
        }
        count_pairs_of(i, first_row, end_row);
    }
}

/// Compares the target with the sources of these rows, which include the target itself.
void ShadowRun::count_pairs_of(std::size_t index, std::size_t first_row, std::size_t end_row) {
    const TileVoxel& target = targets_[index];
    const std::int64_t last = layers_.last();
    const std::int64_t low_layer = std::max<std::int64_t>(0, rows_[first_row].y - target.y - 1);
    const std::int64_t high_layer = std::min(last, rows_[end_row - 1].y - target.y + 1);
    pair_counts_.resize(static_cast<std::size_t>(last) + 1);
    for (std::int64_t layer = low_layer; layer <= high_layer; ++layer) {
        pair_counts_[static_cast<std::size_t>(layer)] = LayerCounts{};
    }
    for (std::size_t row = first_row; row < end_row; ++row) {
        const std::int64_t height = rows_[row].y - target.y;
        for (const ShadowSource& source : sources_of(row)) {
            const std::int64_t x = source.x - target.x;
            const std::int64_t z = source.z - target.z;
            const std::int64_t distance = std::max(std::abs(x), std::abs(z));
            if (distance > height + 2) { // farther than the widest layer of the neighbours
                continue;
            }
            for (std::int64_t rise = -1; rise <= 1; ++rise) {
                const std::int64_t layer = height - rise;
                if (layer >= 0 && layer <= last && distance <= layer + 1) {
                    add_pair(pair_counts_[static_cast<std::size_t>(layer)], Covered(x, layer),
                             Covered(z, layer), rise, source.count);
                }
            }
        }
    }
    for (std::int64_t layer = low_layer; layer <= high_layer; ++layer) {
        layers_.add(sums_[index], layer, pair_counts_[static_cast<std::size_t>(layer)]);
    }
}

} // namespace lsys
