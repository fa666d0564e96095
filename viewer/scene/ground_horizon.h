// GroundHorizon: what the ground hides. In each direction from the eye it knows how high the ground
// that is drawn rises as far as a distance, and errs to the lower side: what it hides cannot be
// seen. No OpenGL.
#pragma once

#include "viewer/scene/frustum.h"
#include "viewer/scene/terrain_lod.h"

#include <array>
#include <cstdint>
#include <vector>

namespace lsys::view {

class GroundHorizon {
public:
    /// For the eye that `ground` was selected for. What is found goes with the next call.
    void set_viewpoint(const TerrainLod& ground, const glm::vec3& eye);
    /// Whether the ground hides all of a box, m.
    [[nodiscard]] bool hides(const glm::vec3& low, const glm::vec3& high);

private:
    static constexpr std::uint32_t kDirections = 512;

    /// The steepest view, in rise a metre, that ground between two directions hides as far as each
    /// distance.
    struct Sector {
        bool known = false;
        std::vector<float> slopes; // by step
    };

    [[nodiscard]] const std::vector<float>& slopes_of(std::uint32_t sector);
    [[nodiscard]] float lowest_between(std::uint32_t sector, float distance) const;

    const TerrainLod* ground_ = nullptr; // none: hides nothing
    glm::vec3 eye_{};
    std::uint32_t steps_ = 0;
    std::array<Sector, kDirections> sectors_;
};

} // namespace lsys::view
