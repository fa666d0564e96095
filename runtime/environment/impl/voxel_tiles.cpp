// SPDX-License-Identifier: MIT
#include "runtime/environment/impl/voxel_tiles.h"

#include "runtime/environment/impl/input_checks.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace lsys {

namespace {

constexpr std::size_t kPiece = 1U << 14; // places in one piece of work
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// The range of voxels that one piece of work has found.
struct PieceRange {
    VoxelIndex low{};
    VoxelIndex high{};
    std::size_t beyond = kNone; // the first place with an index beyond the limit
};

std::int64_t signed_of(std::uint64_t bits) {
    return std::bit_cast<std::int64_t>(bits);
}

std::uint64_t bits_of(double whole) {
    return std::bit_cast<std::uint64_t>(static_cast<std::int64_t>(whole));
}

VoxelIndex index_of(const SortRecord& record) {
    return {signed_of(record.high), signed_of(record.low), signed_of(record.item)};
}

bool is_within(double index) { // false for NaN
    return std::abs(index) <= kMaxVoxelIndex;
}

std::size_t piece_count(std::size_t count) {
    return (count + kPiece - 1) / kPiece;
}

} // namespace

std::uint64_t VoxelTiles::bytes_for(std::uint64_t places) {
    // Bytes of records_ and scratch_, and of first_record_ and first_voxel_ if each place has a
    // tile of its own.
    return places * (2 * sizeof(SortRecord) + 2 * sizeof(std::size_t)) + 2 * sizeof(std::size_t);
}

std::optional<EnvironmentFailure>
VoxelTiles::build(std::size_t count, const std::function<Vector3(std::size_t)>& index) {
    if (auto failure = find_indexes(count, index)) {
        return failure;
    }
    make_keys();
    if (!sort_records(records_, scratch_, workers_, cancelled_)) {
        return stopped(Stop::Cancelled);
    }
    find_voxels();
    return std::nullopt;
}

/// Writes the indexes of the voxel of each place to its record: x to `high`, y `low`, z `item`.
std::optional<EnvironmentFailure>
VoxelTiles::find_indexes(std::size_t count, const std::function<Vector3(std::size_t)>& index) {
    records_.resize(count);
    std::vector<PieceRange> ranges(piece_count(count));
    workers_.for_each(ranges.size(), [&](std::uint64_t piece) {
        const std::size_t begin = piece * kPiece;
        const std::size_t end = std::min(count, begin + kPiece);
        PieceRange range;
        range.low.fill(std::numeric_limits<std::int64_t>::max());
        range.high.fill(std::numeric_limits<std::int64_t>::min());
        for (std::size_t i = begin; i < end; ++i) {
            const Vector3 at = index(i);
            if (!is_within(at[0]) || !is_within(at[1]) || !is_within(at[2])) {
                range.beyond = i;
                break;
            }
            records_[i] = {bits_of(at[0]), bits_of(at[1]), bits_of(at[2])};
            const VoxelIndex voxel = index_of(records_[i]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                range.low[axis] = std::min(range.low[axis], voxel[axis]);
                range.high[axis] = std::max(range.high[axis], voxel[axis]);
            }
        }
        ranges[piece] = range;
    });
    low_ = ranges.front().low;
    high_ = ranges.front().high;
    for (const PieceRange& range : ranges) {
        if (range.beyond != kNone) {
            EnvironmentFailure failure;
            failure.failed_place = range.beyond;
            return failure;
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low_[axis] = std::min(low_[axis], range.low[axis]);
            high_[axis] = std::max(high_[axis], range.high[axis]);
        }
    }
    return std::nullopt;
}

void VoxelTiles::make_keys() {
    const auto extent = [&](std::size_t axis) {
        return static_cast<std::uint64_t>(high_[axis] - low_[axis]);
    };
    const std::uint64_t mask = (std::uint64_t{1} << edge_bits_) - 1;
    // Add one tile on each side, so that the neighbours of tiles at the border have keys of their
    // own.
    key_step_ = (extent(2) >> edge_bits_) + 3;
    workers_.for_each(piece_count(records_.size()), [&](std::uint64_t piece) {
        const std::size_t end = std::min<std::size_t>(records_.size(), (piece + 1) * kPiece);
        for (std::size_t i = piece * kPiece; i < end; ++i) {
            const VoxelIndex voxel = index_of(records_[i]);
            const auto x = static_cast<std::uint64_t>(voxel[0] - low_[0]);
            const auto y = static_cast<std::uint64_t>(voxel[1] - low_[1]);
            const auto z = static_cast<std::uint64_t>(voxel[2] - low_[2]);
            records_[i] = {((x >> edge_bits_) + 1) * key_step_ + (z >> edge_bits_) + 1,
                           (y << (2 * edge_bits_)) | ((x & mask) << edge_bits_) | (z & mask), i};
        }
    });
}

void VoxelTiles::find_voxels() {
    first_record_.clear();
    first_voxel_.clear();
    // bytes_for() assumes that the vectors are allocated once.
    first_record_.reserve(records_.size() + 1);
    first_voxel_.reserve(records_.size() + 1);
    for (std::size_t i = 0; i < records_.size(); ++i) {
        const bool is_new_tile = i == 0 || records_[i].high != records_[i - 1].high;
        if (is_new_tile) {
            first_voxel_.push_back(first_record_.size());
        }
        if (is_new_tile || records_[i].low != records_[i - 1].low) {
            first_record_.push_back(i);
        }
    }
    first_voxel_.push_back(first_record_.size());
    first_record_.push_back(records_.size());
}

std::size_t VoxelTiles::tile_of(std::size_t voxel) const {
    const auto after = std::upper_bound(first_voxel_.begin(), first_voxel_.end(), voxel);
    return static_cast<std::size_t>(after - first_voxel_.begin()) - 1;
}

std::size_t VoxelTiles::lower_tile(std::uint64_t key_wanted) const {
    std::size_t begin = 0;
    std::size_t end = tile_count();
    while (begin < end) {
        const std::size_t middle = begin + (end - begin) / 2;
        if (key(middle) < key_wanted) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin;
}

} // namespace lsys
