// SPDX-License-Identifier: MIT
// Counts of places in squares of a horizontal slice of voxels, those with the same y, by a
// summed-area table (Crow 1984).
#pragma once

#include "runtime/environment/impl/shadow_layers.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace lsys {

/// An occupied voxel of a slice; x and z count from the corner of the tables.
struct ShadowSource {
    std::int32_t x = 0;
    std::int32_t z = 0;
    std::int64_t count = 0; // number of places in the voxel
};

/// Element (x, z) is the number of places with smaller x and smaller z, modulo 2^32: four reads
/// give the number in a rectangle, if that is below 2^32.
class SummedAreaTable {
public:
    static constexpr std::size_t kLanes = 4;
    using Lanes = std::uint32_t __attribute__((vector_size(4 * kLanes)));

    [[nodiscard]] static std::uint64_t cells(std::uint64_t width, std::uint64_t depth) {
        return (width + 1) * (depth + kLanes); // a read of four lanes may pass the end of a line
    }
    void build(std::size_t width, std::size_t depth, std::span<const ShadowSource> sources) {
        stride_ = depth + kLanes;
        sums_.assign(cells(width, depth), 0);
        used_.assign(width + 1, 0);
        for (const ShadowSource& source : sources) {
            const auto line = static_cast<std::size_t>(source.x) + 1;
            sums_[line * stride_ + static_cast<std::size_t>(source.z) + 1] +=
                static_cast<std::uint32_t>(source.count);
            used_[line] = 1;
        }
        for (std::size_t line = 1; line <= width; ++line) {
            std::uint32_t* const own = sums_.data() + line * stride_;
            const std::uint32_t* const previous = own - stride_;
            if (used_[line] == 0) {
                std::copy_n(previous, stride_, own);
                continue;
            }
            std::uint32_t running = 0;
            for (std::size_t z = 1; z < stride_; ++z) {
                running += own[z];
                own[z] = running + previous[z];
            }
        }
    }
    /// Numbers of places in the squares around (x, z - 1), (x, z), (x, z + 1), in the first three
    /// lanes. A square has edges of 2 `layer` + 1 voxels.
    [[nodiscard]] Lanes squares(std::int64_t x, std::int64_t z, std::int64_t layer) const {
        return line(x + layer + 1, z, layer) - line(x - layer, z, layer);
    }

private:
    /// Numbers of places with smaller x, for the ranges of z of the three squares of squares().
    [[nodiscard]] Lanes line(std::int64_t x, std::int64_t z, std::int64_t layer) const {
        const std::uint32_t* const at = sums_.data() + static_cast<std::size_t>(x) * stride_ +
                                        static_cast<std::size_t>(z - layer - 1);
        return read(at + 2 * layer + 1) - read(at);
    }
    [[nodiscard]] static Lanes read(const std::uint32_t* at) {
        Lanes lanes;
        std::memcpy(&lanes, at, sizeof lanes);
        return lanes;
    }

    std::size_t stride_ = 0; // elements per line, all elements with one x
    std::vector<std::uint32_t> sums_;
    std::vector<std::uint8_t> used_; // lines with sources
};

/// Counts of `layer` for the voxel at (x, z), from three tables: of the slice whose places shade
/// the voxel with this layer, preceded by the slice below it and followed by the slice above it.
/// The places of the tables are fewer than 2^29.
[[nodiscard]] LayerCounts count_by_tables(const std::array<const SummedAreaTable*, 3>& tables,
                                          std::int64_t x,
                                          std::int64_t z,
                                          std::int64_t layer);

} // namespace lsys
