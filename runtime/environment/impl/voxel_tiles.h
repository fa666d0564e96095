// SPDX-License-Identifier: MIT
// VoxelTiles: the occupied voxels of many places, by tiles. A tile is a column of voxels: `edge`
// voxels along x and z, and as high as the plant. Memory grows with the number of places and not
// with the volume between them.
#pragma once

#include "runtime/environment/environment.h"
#include "runtime/environment/impl/sorted_records.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace lsys {

/// Index of a voxel along x, y, z.
using VoxelIndex = std::array<std::int64_t, 3>;

inline constexpr double kMaxVoxelIndex = 2147483648.0; // 2^31

/// A voxel within its tile.
struct TileVoxel {
    std::int64_t y = 0; // counted from the lowest occupied voxel
    std::int32_t x = 0; // 0 to edge - 1
    std::int32_t z = 0;
};

class VoxelTiles {
public:
    /// Tiles are 2^edge_bits voxels wide along x and z.
    VoxelTiles(std::uint32_t edge_bits, Workers& workers, const std::atomic<bool>& cancelled)
        : edge_bits_(edge_bits), workers_(workers), cancelled_(cancelled) {}

    /// Bytes that build() allocates for this number of places.
    [[nodiscard]] static std::uint64_t bytes_for(std::uint64_t places);
    /// Groups `count` places, at least one. `index(i)` are the indexes of the voxel of place i, as
    /// whole numbers in binary64. A failure has stop Diagnosed and the first place with an index
    /// beyond 2^31, or stop Cancelled.
    [[nodiscard]] std::optional<EnvironmentFailure>
    build(std::size_t count, const std::function<Vector3(std::size_t)>& index);

    [[nodiscard]] std::size_t voxel_count() const { return first_record_.size() - 1; }
    [[nodiscard]] std::size_t tile_count() const { return first_voxel_.size() - 1; }
    [[nodiscard]] std::size_t first_voxel(std::size_t tile) const { return first_voxel_[tile]; }
    /// The tile that contains voxel number `voxel`.
    [[nodiscard]] std::size_t tile_of(std::size_t voxel) const;
    /// Position of voxel number `voxel` within its tile. Voxels of a tile are sorted by y.
    [[nodiscard]] TileVoxel voxel(std::size_t voxel) const {
        const std::uint64_t low = records_[first_record_[voxel]].low;
        const std::uint64_t mask = (std::uint64_t{1} << edge_bits_) - 1;
        return {static_cast<std::int64_t>(low >> (2 * edge_bits_)),
                static_cast<std::int32_t>((low >> edge_bits_) & mask),
                static_cast<std::int32_t>(low & mask)};
    }
    /// Number of places in a voxel.
    [[nodiscard]] std::size_t place_count(std::size_t voxel) const {
        return first_record_[voxel + 1] - first_record_[voxel];
    }
    /// Index of a place in a voxel; `number` is below place_count().
    [[nodiscard]] std::size_t place(std::size_t voxel, std::size_t number) const {
        return records_[first_record_[voxel] + number].item;
    }
    /// Tiles have ascending keys; a step of one tile along x adds key_step(), one along z adds 1.
    [[nodiscard]] std::uint64_t key(std::size_t tile) const {
        return records_[first_record_[first_voxel_[tile]]].high;
    }
    [[nodiscard]] std::uint64_t key_step() const { return key_step_; }
    /// The first tile whose key is not below `key`.
    [[nodiscard]] std::size_t lower_tile(std::uint64_t key) const;

private:
    /// Sets the voxel of each place, and low_ and high_.
    [[nodiscard]] std::optional<EnvironmentFailure>
    find_indexes(std::size_t count, const std::function<Vector3(std::size_t)>& index);
    /// Turns the voxels in records_ into keys of tile and voxel.
    void make_keys();
    /// Sets first_record_ and first_voxel_ from the sorted records.
    void find_voxels();

    std::uint32_t edge_bits_;
    Workers& workers_;
    const std::atomic<bool>& cancelled_;
    SortRecords records_;        // sorted by tile, y, x, z
    SortRecords scratch_;        // memory for sort_records()
    VoxelIndex low_{};           // least index along each axis
    VoxelIndex high_{};          // greatest index along each axis
    std::uint64_t key_step_ = 0; // see key()
    /// By voxel: its first record; last: the number of records.
    LargeVector<std::size_t> first_record_;
    LargeVector<std::size_t> first_voxel_; // by tile: its first voxel; last: the number of voxels
};

} // namespace lsys
