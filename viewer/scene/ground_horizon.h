// SPDX-License-Identifier: MIT
// GroundHorizon: occlusion by the ground. Stores, for directions around the eye, how steeply the
// drawn ground rises up to each distance. Conservative: everything it reports as hidden is
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
    /// Prepares for the eye that `ground` was selected for; discards earlier results.
    void set_viewpoint(const TerrainLod& ground, const glm::vec3& eye);
    /// Whether the ground occludes a whole box, m.
    [[nodiscard]] bool occludes(const glm::vec3& low, const glm::vec3& high);

    /// Directions around the eye, and max distances; also in shaders/culling_horizon*.glsl.
    static constexpr std::uint32_t kDirections = 512;
    static constexpr std::uint32_t kMaxDistances = 256;
    /// Count of distances up to the range of the drawn ground.
    [[nodiscard]] static std::uint32_t distance_count(const TerrainLod& ground);
    /// kMaxDistances distances, m, then sine and cosine of the kDirections + 1 angles that bound
    /// the directions.
    [[nodiscard]] static std::vector<float> rays();

private:
    /// Steepest slope (rise / distance) of the ground between two directions, up to each distance:
    /// the ground occludes everything behind it below that slope.
    struct Sector {
        bool known = false;
        std::vector<float> slopes; // by step
    };

    [[nodiscard]] const std::vector<float>& slopes_of(std::uint32_t sector);
    [[nodiscard]] float min_between(std::uint32_t sector, float distance) const;

    const TerrainLod* ground_ = nullptr; // null: occludes nothing
    glm::vec3 eye_{};
    std::uint32_t steps_ = 0;
    std::array<Sector, kDirections> sectors_;
};

} // namespace lsys::view
