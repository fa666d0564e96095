// SPDX-License-Identifier: MIT
// ShadowRun: computes the shadow at some voxels, the targets, of one tile, from the occupied voxels
// that can shade them, the sources. Where places are dense, places in squares are counted by
// summed-area tables; where they are sparse, pair by pair. Both counts are exact.
#pragma once

#include "runtime/environment/impl/shadow_boxes.h"
#include "runtime/environment/impl/voxel_tiles.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// Width of a tile as a power of two, in voxels: at least the distance over which a pyramid shades
/// a voxel or its neighbours, so that a tile and the eight tiles around it contain all places that
/// shade voxels of the tile.
[[nodiscard]] std::uint32_t shadow_tile_bits(std::uint32_t levels);
/// Memory of a run for tables, bytes.
[[nodiscard]] std::uint64_t shadow_table_bytes(std::uint32_t levels);

/// Evaluates run after run with the same memory.
class ShadowRun {
public:
    ShadowRun(const VoxelTiles& tiles, std::uint32_t tile_bits, const ShadowLayers& layers)
        : tiles_(tiles), layers_(layers), edge_(std::int32_t{1} << tile_bits),
          reach_(static_cast<std::int32_t>(layers.last()) + 1) {}

    /// Voxels `begin` ... `end` - 1 belong to `tile`. Call it for ascending tiles and voxels.
    /// The result is valid until the next run.
    [[nodiscard]] std::span<const ShadowSum>
    evaluate(std::size_t tile, std::size_t begin, std::size_t end);

private:
    /// A row: the sources of one slice, which have the same y.
    struct Row {
        std::int64_t y = 0;
        std::size_t first = 0; // index in sources_
    };
    /// A neighbouring tile; its voxels from `next` to `end` are not read yet.
    struct Neighbour {
        std::size_t next = 0;
        std::size_t end = 0;
        std::int64_t y = 0; // y of voxel `next`
        std::int32_t x = 0; // x, z: of the tile's corner, from the corner of the tables
        std::int32_t z = 0;
    };

    /// Sets targets_ and the place and size of the tables.
    void find_targets(std::size_t begin, std::size_t end);
    /// Sets neighbours_: the tile itself and the tiles around it.
    void find_neighbours(std::size_t tile);
    /// Adds a tile whose corner is at (x, z), counted from the corner of the tables, if the tile
    /// overlaps the tables.
    void add_neighbour(std::size_t tile, std::int32_t x, std::int32_t z);
    /// Sets sources_ and rows_: the voxels of neighbours_ that may shade a target.
    void read_sources();
    [[nodiscard]] std::span<const ShadowSource> sources_of(std::size_t row) const {
        return std::span(sources_).subspan(rows_[row].first,
                                           rows_[row + 1].first - rows_[row].first);
    }
    /// Whether counting by tables takes less time than counting pairs, by costs in cycles measured
    /// on one processor.
    [[nodiscard]] bool prefers_tables() const;
    /// Sets the sums of all targets by the tables.
    void count_with_tables();
    /// Sets the sums of all targets by comparing each with each source near it.
    void count_pairs();
    void count_pairs_of(std::size_t target, std::size_t first_row, std::size_t end_row);

    const VoxelTiles& tiles_;
    const ShadowLayers& layers_;
    std::int32_t edge_; // width of a tile, in voxels
    /// Voxels along an axis from a target to the farthest source that shades the target or one of
    /// its 26 neighbours.
    std::int32_t reach_;

    std::vector<TileVoxel> targets_; // sorted by y; x and z count from the corner of the tables
    std::int32_t corner_x_ = 0;      // corner of the tables in coordinates of the tile
    std::int32_t corner_z_ = 0;
    std::int32_t width_ = 0;            // extent of the tables along x, in voxels
    std::int32_t depth_ = 0;            // extent of the tables along z, in voxels
    std::int64_t place_count_ = 0;      // number of places in sources_
    std::vector<ShadowSource> sources_; // in rows of ascending y
    /// Rows of sources_, and one row more, whose `first` is sources_.size().
    std::vector<Row> rows_;
    std::vector<Neighbour> neighbours_;
    /// Tiles at which find_neighbours() begins to search the tiles at x - 1, x and x + 1.
    std::array<std::size_t, 3> tile_cursors_{};
    bool has_cursors_ = false;              // find_neighbours() has set tile_cursors_
    std::array<SummedAreaTable, 3> tables_; // of three rows, by index in rows_ modulo 3
    SummedAreaTable empty_table_;           // for rows without sources
    std::vector<LayerCounts> pair_counts_;  // counts by layer
    std::vector<ShadowSum> sums_;           // by target
};

} // namespace lsys
