// SPDX-License-Identifier: MIT
// TerrainLod: patches of the ground, and their level of detail for a camera (CDLOD, Strugar 2010,
// "Continuous Distance-Dependent Level of Detail for Rendering Heightmaps"). The ground is an
// unbounded quadtree. Each level has a height grid around the camera, twice as coarse as that of
// the level before it. The heights in grids are those of the terrain, so every drawn vertex lies on
// the terrain. No OpenGL.
#pragma once

#include "runtime/terrain/terrain.h"
#include "viewer/scene/frustum.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace lsys::view {

inline constexpr std::uint32_t kPatchCells = 8;     // along a side of a patch
inline constexpr std::uint32_t kHeightTexels = 256; // along a side of the height grid of a level
inline constexpr std::uint32_t kTerrainLevels = 14; // enough for ground up to 278 km away
inline constexpr float kFinestCell = 0.5F;          // m, side of a cell of level 0

/// A quarter of a node, with kPatchCells cells along a side.
struct TerrainPatch {
    std::int32_t x = 0; // lowest corner, in cells of its level
    std::int32_t z = 0;
    std::uint32_t level = 0;

    friend bool operator==(const TerrainPatch&, const TerrainPatch&) = default;
};

/// Heights of a level in a square around the camera.
struct HeightGrid {
    glm::ivec2 origin{};   // first texel, in cells of the level from the origin
    bool is_valid = false; // the grid has heights
    float lowest = 0.0F;   // m
    float highest = 0.0F;
    std::vector<float> heights; // m, in rows along X
    /// Fraction of the ground that crowns hide, stored like `heights`; empty without GroundCover.
    std::vector<float> covers;

    /// Height at a texel. `x`, `z`: in cells of the level.
    [[nodiscard]] float at(std::int32_t x, std::int32_t z) const {
        return heights[static_cast<std::size_t>(z - origin.y) * kHeightTexels +
                       static_cast<std::size_t>(x - origin.x)];
    }
};

/// Returns the fraction, 0 to 1, of the ground at a place of the world (x, z in m) that crowns
/// hide. Called from several threads.
using GroundCover = std::function<float(double x, double z)>;

class TerrainLod {
public:
    /// `terrain` must outlive this object. `view_distance`: distance in m up to which ground is
    /// drawn.
    TerrainLod(const Terrain& terrain, float view_distance);

    /// Sets the place of the world, in m, to which eyes, grids and patches are relative. It must be
    /// a multiple of kOriginStep along X and Z.
    void set_origin(const glm::dvec3& origin);
    /// Sets the cover, which grids have from the level kFirstCoverLevel on. Call it before the
    /// first select().
    void set_cover(GroundCover cover) { cover_ = std::move(cover); }
    static constexpr std::uint32_t kFirstCoverLevel = 3; // range 272 m

    /// Updates the height grids for a camera, and lists the visible patches, those of finer levels
    /// first.
    void select(const Frustum& frustum);
    [[nodiscard]] const std::vector<TerrainPatch>& patches() const { return patches_; }
    [[nodiscard]] const HeightGrid& grid(std::uint32_t level) const { return grids_[level]; }
    /// Levels whose grid was updated by the last select().
    [[nodiscard]] const std::vector<std::uint32_t>& changed() const { return changed_; }
    [[nodiscard]] std::uint32_t levels() const { return levels_; }

    /// Max distance in m from the eye at which a level is drawn.
    [[nodiscard]] static float range(std::uint32_t level);
    /// Distance in m from the eye at which vertices begin to morph to the next level; the morph
    /// ends at range().
    [[nodiscard]] static float morph_start(std::uint32_t level);
    /// Side of a cell of a level in m.
    [[nodiscard]] static float cell(std::uint32_t level) {
        return kFinestCell * static_cast<float>(1U << level);
    }
    /// Height in m of the eye above the ground below it, from which all distances from the eye to
    /// the ground are computed.
    [[nodiscard]] float eye_height() const { return eye_height_; }

private:
    struct Node {
        std::int64_t x = 0; // in nodes of its level
        std::int64_t z = 0;
        std::uint32_t level = 0;
    };
    void make_grid(std::uint32_t level, const glm::vec3& eye); // unless the grid is up to date
    /// Height in m of the terrain at a place of the world.
    [[nodiscard]] float height_at(double x, double z) const;
    /// Draws a node, or its children. Returns whether it was drawn.
    bool visit(const Node& node, const Frustum& frustum);
    [[nodiscard]] float distance_to(const Node& node) const; // from the eye
    /// Whether the square of `cells` by `cells` cells from the lowest corner of `at` is visible.
    [[nodiscard]] bool
    is_visible(const TerrainPatch& at, std::int32_t cells, const Frustum& frustum) const;

    const Terrain& terrain_;
    GroundCover cover_;
    glm::dvec3 origin_{};
    std::uint32_t levels_ = 1; // number of levels
    std::array<HeightGrid, kTerrainLevels> grids_;
    std::vector<TerrainPatch> patches_;
    std::vector<std::uint32_t> changed_; // changed()
    glm::vec3 eye_{};
    float eye_height_ = 0.0F;
};

} // namespace lsys::view
