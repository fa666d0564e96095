// SPDX-License-Identifier: MIT
#include "runtime/tiles/impl/tile_ground.h"

#include "runtime/meshing/texture.h"
#include "runtime/tiles/impl/ground_patch.h"

#include <glm/common.hpp>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace lsys {

namespace {

constexpr std::uint32_t kSide = kCanopyCells + 1; // number of points along a side of a canopy
constexpr std::int64_t kWide = kSide + 2;         // kSide with a border of one cell, for normals

/// Heights in m of the bare ground at the places of a patch.
std::vector<double> ground_heights(const Terrain& terrain, const PatchPlan& plan) {
    const auto places = [&plan](double first, double length) {
        const std::vector<double> exact = patch_places(first, length, plan.cells);
        return std::vector<float>(exact.begin(), exact.end());
    };
    const std::vector<float> heights = terrain.heights(places(plan.region.x, plan.region.width),
                                                       places(plan.region.z, plan.region.depth));
    return {heights.begin(), heights.end()};
}

/// Makes the ground with its repeated picture, or in one colour.
Mesh make_bare_ground(const TileGround& ground, PatchPlan& plan) {
    const GroundPictures& pictures = ground.pictures;
    const Region& region = plan.region;
    const bool is_tiled = pictures.colour != nullptr;
    plan.material.textured = is_tiled;
    plan.material.picture = pictures.colour;
    plan.material.colour = glm::vec4(is_tiled ? glm::vec3(1.0F) : glm::vec3(ground.colour), 1.0F);
    const double width = is_tiled ? pictures.width : region.width;
    const double depth = is_tiled ? pictures.depth : region.depth;
    const double first_u = std::floor((region.x - pictures.origin_x) / width);
    const double first_v = std::floor((region.z - pictures.origin_z) / depth);
    plan.heights = ground_heights(ground.terrain, plan);
    plan.texture = [&, width, depth, first_u, first_v](std::uint32_t, std::uint32_t, double x,
                                                       double z) {
        return glm::vec2((x - pictures.origin_x) / width - first_u,
                         (z - pictures.origin_z) / depth - first_v);
    };
    return make_patch(plan);
}

/// Makes ground and crowns as one surface, with a picture of its colours: one texel for each
/// vertex.
Mesh make_canopy(const TileGround& ground, PatchPlan& plan) {
    const TileId& tile = ground.tile;
    const double cell = ground.grid.side(tile.level) / kCanopyCells;
    const std::int64_t first_column = std::int64_t{tile.column} * kCanopyCells - 1;
    const std::int64_t first_row = std::int64_t{tile.row} * kCanopyCells - 1;
    std::vector<CanopyPoint> points;
    for (std::int64_t i = 0; i < kWide * kWide; ++i) {
        points.push_back(
            ground.canopy_at(tile.level, first_column + i % kWide, first_row + i / kWide));
    }
    const auto canopy_at = [&](double x, double z) -> const CanopyPoint& {
        const std::int64_t column = std::llround((x - ground.grid.square().x) / cell);
        const std::int64_t row = std::llround((z - ground.grid.square().z) / cell);
        return points[static_cast<std::size_t>((row - first_row) * kWide + column - first_column)];
    };
    Texture colours{kSide, kSide, std::vector<std::uint8_t>(std::size_t{4} * kSide * kSide)};
    plan.material.textured = true;
    plan.material.roughness = 1.0F;
    plan.heights = ground_heights(ground.terrain, plan);
    auto height = plan.heights.begin();
    for (const double z : patch_places(plan.region.z, plan.region.depth, plan.cells)) {
        for (const double x : patch_places(plan.region.x, plan.region.width, plan.cells)) {
            *height++ += canopy_at(x, z).height;
        }
    }
    plan.texture = [&](std::uint32_t column, std::uint32_t row, double x, double z) {
        const CanopyPoint& crowns = canopy_at(x, z);
        const glm::dvec3 colour = glm::mix(ground.colour, crowns.colour, crowns.cover);
        std::uint8_t* const texel = &colours.texels[4 * (std::size_t{row} * kSide + column)];
        for (int i = 0; i < 3; ++i) {
            texel[i] = nearest_srgb_byte(static_cast<float>(colour[i]));
        }
        texel[3] = 255;
        const auto texel_centre = [](std::uint32_t at) {
            return (static_cast<float>(at) + 0.5F) / static_cast<float>(kSide);
        };
        return glm::vec2(texel_centre(column), texel_centre(row));
    };
    Mesh mesh = make_patch(plan);
    mesh.materials.front().picture = std::make_shared<const Texture>(std::move(colours));
    return mesh;
}

} // namespace

Mesh make_tile_ground(const TileGround& ground) {
    Material material;
    material.name = "ground";
    PatchPlan plan{ground.cells,
                   ground.grid.region_of(ground.tile),
                   ground.frame,
                   ground.skirt,
                   material,
                   {},
                   {}};
    return ground.canopy_at ? make_canopy(ground, plan) : make_bare_ground(ground, plan);
}

} // namespace lsys
