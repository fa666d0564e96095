// SPDX-License-Identifier: MIT
#include "viewer/scene/terrain_lod.h"

#include "runtime/base/workers.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace lsys::view {

namespace {

// Number of cells along a side of a node.
constexpr std::int32_t kNodeCells = 2 * static_cast<std::int32_t>(kPatchCells);
constexpr float kNearestRange = 34.0F; // m, range of level 0
// Fraction of the range of a level at which its vertices begin to morph. Levels have no gaps
// between them: vertices of the finer level end their morph at the range of their level, and
// vertices of the coarser level begin theirs beyond the farthest corner of a node that touches this
// range, because 0.85 * 2 * 34 >= 34 + sqrt(2) * 16.
constexpr float kMorphStart = 0.85F;
// Number of texels by which the height grid is moved when it follows the camera. It moves in large
// steps, so that it is seldom rebuilt.
constexpr std::int64_t kGridStep = 16;
constexpr std::uint64_t kRowsPerPiece = 16; // rows of the grid that a worker fills at a time

std::int64_t floor_to(double value, std::int64_t step) {
    return static_cast<std::int64_t>(std::floor(value / static_cast<double>(step))) * step;
}

} // namespace

float TerrainLod::range(std::uint32_t level) {
    return kNearestRange * static_cast<float>(1U << level);
}

float TerrainLod::morph_start(std::uint32_t level) {
    return kMorphStart * range(level);
}

TerrainLod::TerrainLod(const Terrain& terrain, float view_distance) : terrain_(terrain) {
    while (levels_ < kTerrainLevels && range(levels_ - 1) < view_distance) {
        ++levels_;
    }
}

void TerrainLod::set_origin(const glm::dvec3& origin) {
    const glm::dvec3 moved = origin_ - origin;
    origin_ = origin;
    for (std::uint32_t level = 0; level < kTerrainLevels; ++level) {
        const auto size = static_cast<double>(cell(level));
        grids_[level].origin += glm::ivec2(static_cast<std::int32_t>(moved.x / size),
                                           static_cast<std::int32_t>(moved.z / size));
    }
}

float TerrainLod::height_at(double x, double z) const {
    return terrain_.height(static_cast<float>(x), static_cast<float>(z));
}

void TerrainLod::make_grid(std::uint32_t level, const glm::vec3& eye) {
    const auto size = static_cast<double>(cell(level));
    const auto half = static_cast<std::int64_t>(kHeightTexels) / 2 - kGridStep / 2;
    const glm::ivec2 origin(floor_to(static_cast<double>(eye.x) / size, kGridStep) - half,
                            floor_to(static_cast<double>(eye.z) / size, kGridStep) - half);
    HeightGrid& grid = grids_[level];
    if (grid.is_valid && grid.origin == origin) {
        return;
    }
    // Heights that the previous grid has are copied, so that few heights are computed while the
    // camera moves slowly.
    const HeightGrid before = std::exchange(grid, {});
    const bool has_cover = cover_ && level >= kFirstCoverLevel;
    grid.is_valid = true;
    grid.origin = origin;
    grid.heights.resize(std::size_t{kHeightTexels} * kHeightTexels);
    grid.covers.resize(has_cover ? grid.heights.size() : 0);
    const glm::ivec2 shift = origin - before.origin;
    const auto size_texels = static_cast<std::int32_t>(kHeightTexels);
    const std::int32_t kept_low = before.is_valid ? std::max(-shift.x, 0) : size_texels;
    const std::int32_t kept_high =
        before.is_valid ? std::min(size_texels - shift.x, size_texels) : 0;
    Workers workers(0);
    workers.for_each(kHeightTexels / kRowsPerPiece, [&](std::uint64_t piece) {
        for (std::uint64_t row = piece * kRowsPerPiece; row < (piece + 1) * kRowsPerPiece; ++row) {
            const double z =
                origin_.z + static_cast<double>(origin.y + static_cast<std::int32_t>(row)) * size;
            const std::int32_t row_before = static_cast<std::int32_t>(row) + shift.y;
            const bool is_kept = row_before >= 0 && row_before < size_texels;
            for (std::int32_t column = 0; column < size_texels; ++column) {
                const std::size_t texel = row * kHeightTexels + static_cast<std::size_t>(column);
                if (is_kept && column >= kept_low && column < kept_high) {
                    const std::size_t old = static_cast<std::size_t>(row_before) * kHeightTexels +
                                            static_cast<std::size_t>(column + shift.x);
                    grid.heights[texel] = before.heights[old];
                    if (has_cover) {
                        grid.covers[texel] = before.covers[old];
                    }
                    continue;
                }
                const double x = origin_.x + static_cast<double>(origin.x + column) * size;
                grid.heights[texel] = height_at(x, z);
                if (has_cover) {
                    grid.covers[texel] = cover_(x, z);
                }
            }
        }
    });
    const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
    grid.lowest = *low;
    grid.highest = *high;
    changed_.push_back(level);
}

void TerrainLod::select(const Frustum& frustum) {
    patches_.clear();
    changed_.clear();
    eye_ = frustum.eye;
    eye_height_ = std::max(eye_.y - height_at(origin_.x + static_cast<double>(eye_.x),
                                              origin_.z + static_cast<double>(eye_.z)),
                           0.0F);
    for (std::uint32_t level = 0; level < levels_; ++level) {
        if (range(level) > eye_height_ || level + 1 == levels_) {
            make_grid(level, eye_);
        }
    }
    const std::uint32_t top = levels_ - 1;
    const double node_size = static_cast<double>(cell(top)) * kNodeCells;
    const auto view_distance = static_cast<double>(range(top));
    const auto index = [&](double at) {
        return static_cast<std::int64_t>(std::floor(at / node_size));
    };
    for (std::int64_t z = index(static_cast<double>(eye_.z) - view_distance);
         z <= index(static_cast<double>(eye_.z) + view_distance); ++z) {
        for (std::int64_t x = index(static_cast<double>(eye_.x) - view_distance);
             x <= index(static_cast<double>(eye_.x) + view_distance); ++x) {
            visit({x, z, top}, frustum);
        }
    }
    std::stable_sort(
        patches_.begin(), patches_.end(),
        [](const TerrainPatch& a, const TerrainPatch& b) { return a.level < b.level; });
}

float TerrainLod::distance_to(const Node& node) const {
    const float size = cell(node.level) * static_cast<float>(kNodeCells);
    const glm::vec2 low(static_cast<float>(node.x) * size, static_cast<float>(node.z) * size);
    const glm::vec2 eye(eye_.x, eye_.z);
    const glm::vec2 away = eye - glm::clamp(eye, low, low + size);
    return glm::length(glm::vec3(away, eye_height_));
}

bool TerrainLod::is_visible(const TerrainPatch& at,
                            std::int32_t cells,
                            const Frustum& frustum) const {
    const HeightGrid& grid = grids_[at.level];
    const float size = cell(at.level);
    const glm::vec3 low(static_cast<float>(at.x) * size, grid.lowest,
                        static_cast<float>(at.z) * size);
    const glm::vec3 high(static_cast<float>(at.x + cells) * size, grid.highest,
                         static_cast<float>(at.z + cells) * size);
    return std::all_of(frustum.planes.begin(), frustum.planes.end(), [&](const glm::vec4& plane) {
        // The corner of the box that lies farthest inside of the plane.
        const glm::vec3 corner(plane.x > 0.0F ? high.x : low.x, plane.y > 0.0F ? high.y : low.y,
                               plane.z > 0.0F ? high.z : low.z);
        return glm::dot(glm::vec3(plane), corner) + plane.w >= 0.0F;
    });
}

bool TerrainLod::visit(const Node& node, const Frustum& frustum) {
    if (distance_to(node) >= range(node.level)) {
        return false;
    }
    const TerrainPatch all{static_cast<std::int32_t>(node.x) * kNodeCells,
                           static_cast<std::int32_t>(node.z) * kNodeCells, node.level};
    if (!is_visible(all, kNodeCells, frustum)) {
        return true;
    }
    for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
        const bool finer = node.level != 0 && visit({2 * node.x + (quarter & 1U),
                                                     2 * node.z + (quarter >> 1U), node.level - 1},
                                                    frustum);
        constexpr auto kCells = static_cast<std::int32_t>(kPatchCells);
        const TerrainPatch patch{all.x + static_cast<std::int32_t>(quarter & 1U) * kCells,
                                 all.z + static_cast<std::int32_t>(quarter >> 1U) * kCells,
                                 node.level};
        if (!finer && is_visible(patch, kCells, frustum)) {
            patches_.push_back(patch);
        }
    }
    return true;
}

} // namespace lsys::view
