// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tile_boxes.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>

namespace lsys {

namespace {

constexpr std::uint32_t kSamples = 8;   // cells along a side, where the ground is sampled
constexpr double kLeastRadius = 6.33e6; // m, less than any radius of curvature of WGS 84

} // namespace

void TileBox::add(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
}

TileBoxes::TileBoxes(const Terrain& terrain,
                     const GroundFrame& earth,
                     const TileGrid& grid,
                     const TreeReach& reach,
                     const std::vector<double>& skirts)
    : terrain_(terrain), earth_(earth), grid_(grid), reach_(reach), ground_margins_(skirts.size()),
      depths_(skirts) {
    // Begins with the finest level, because the box of a tile contains the boxes of the tiles below
    // it.
    double margin = 0.0;
    double depth = reach.below;
    for (std::size_t level = skirts.size(); level-- > 0;) {
        margin += terrain.mesh_error(grid.side(static_cast<std::uint32_t>(level)) / kSamples);
        ground_margins_[level] = margin;
        depth = std::max(depth, skirts[level]);
        depths_[level] = depth;
    }
}

glm::dmat4 TileBoxes::frame_of(const TileId& tile) const {
    const double side = grid_.side(tile.level);
    return earth_.frame(grid_.square().x + side * (tile.column + 0.5),
                        grid_.square().z + side * (tile.row + 0.5));
}

TileBox TileBoxes::box_of(const TileId& tile) const {
    const Region region = grid_.region_of(tile);
    std::array<float, kSamples + 1> columns{};
    std::array<float, kSamples + 1> rows{};
    for (std::uint32_t i = 0; i <= kSamples; ++i) {
        columns[i] = static_cast<float>(region.x + region.width * i / kSamples);
        rows[i] = static_cast<float>(region.z + region.depth * i / kSamples);
    }
    const std::vector<float> heights = terrain_.heights(columns, rows);
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    auto lowest = static_cast<double>(*low);
    auto highest = static_cast<double>(*high);
    const auto [least, most] = terrain_.altitudes();
    lowest = std::max(lowest - ground_margins_[tile.level], least) - depths_[tile.level];
    highest = std::min(highest + ground_margins_[tile.level], most) + reach_.above;
    const glm::dmat4 to_tile = inverse_of_frame(frame_of(tile));
    TileBox box;
    const auto add = [&](double x, double z) {
        for (const double y : {lowest, highest}) {
            box.add(glm::dvec3(to_tile * glm::dvec4(earth_.place(x, y, z), 1.0)));
        }
    };
    for (const double x : {region.x - reach_.around, region.x + region.width + reach_.around}) {
        for (const double z : {region.z - reach_.around, region.z + region.depth + reach_.around}) {
            add(x, z);
        }
    }
    add(region.x + region.width / 2.0, region.z + region.depth / 2.0);
    if (earth_.is_curved()) {
        // The ground bulges between these points, and the boxes of the tiles below are tilted. Both
        // protrude by at most the squared diagonal of the region / the diameter of the Earth.
        const double width = region.width + 2.0 * reach_.around;
        const double depth = region.depth + 2.0 * reach_.around;
        const glm::dvec3 slack((width * width + depth * depth) / (2.0 * kLeastRadius));
        box.low -= slack;
        box.high += slack;
    }
    return box;
}

} // namespace lsys
