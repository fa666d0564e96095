// SPDX-License-Identifier: MIT
// GroundHorizon: occlusion by the ground. Stores, for each direction from the eye, how steeply the
// drawn ground rises up to each distance. Conservative: all that it reports as occluded is
// invisible. No OpenGL.
#pragma once

#include "viewer/scene/frustum.h"
#include "viewer/scene/terrain_lod.h"

#include <array>
#include <cstdint>
#include <vector>

namespace lsys::view {

class GroundHorizon {
public:
    /// Prepares for the eye for which `ground` was selected; discards the results for earlier eyes.
    void set_viewpoint(const TerrainLod& ground, const glm::vec3& eye);
    /// Whether the ground occludes a whole box. `low`, `high`: m.
    [[nodiscard]] bool occludes(const glm::vec3& low, const glm::vec3& high);

    /// Number of directions around the eye, and max number of distances; also in
    /// shaders/culling_horizon*.glsl.
    static constexpr std::uint32_t kDirections = 512;
    static constexpr std::uint32_t kMaxDistances = 256;
    /// Number of distances up to the range of the drawn ground.
    [[nodiscard]] static std::uint32_t distance_count(const TerrainLod& ground);
    /// The kMaxDistances distances in m, then sine and cosine of the kDirections + 1 angles that
    /// bound the directions.
    [[nodiscard]] static std::vector<float> rays();

private:
    /// Steepest slope (rise / distance) of the ground between two directions, up to each distance.
    /// The ground occludes all that lies behind it and below this slope.
    struct Sector {
        bool known = false;        // the slopes have been computed for the eye
        std::vector<float> slopes; // by index of the distance in rays()
    };

    /// Computed on first use.
    [[nodiscard]] const std::vector<float>& slopes_of(std::uint32_t sector);
    /// Lowest height in m of the ground between the two directions of a sector, at a distance.
    [[nodiscard]] float min_height_between(std::uint32_t sector, float distance) const;

    const TerrainLod* ground_ = nullptr; // null: occludes nothing
    glm::vec3 eye_{};
    std::uint32_t steps_ = 0; // distance_count() of ground_
    std::array<Sector, kDirections> sectors_;
};

} // namespace lsys::view
