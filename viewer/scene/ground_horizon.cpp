// SPDX-License-Identifier: MIT
#include "viewer/scene/ground_horizon.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lsys::view {

namespace {

constexpr float kTurn = 2.0F * std::numbers::pi_v<float>;
constexpr float kFirst = 2.0F;  // m, first distance; nearer ground counts as occluding nothing
constexpr float kRatio = 1.06F; // each distance divided by the distance before it
/// Added to the slope of a box before it is compared with the horizon. Covers the error of
/// replacing the arc between two directions by a straight line between its ends.
constexpr float kMargin = 5e-4F;

/// Number of the step at a distance in m, as a real number.
float steps_to(float distance) {
    return std::log(distance / kFirst) / std::log(kRatio);
}

} // namespace

std::uint32_t GroundHorizon::distance_count(const TerrainLod& ground) {
    return static_cast<std::uint32_t>(steps_to(TerrainLod::range(ground.levels() - 1)));
}

std::vector<float> GroundHorizon::rays() {
    std::vector<float> rays;
    float distance = kFirst;
    for (std::uint32_t i = 0; i < kMaxDistances; ++i, distance *= kRatio) {
        rays.push_back(distance);
    }
    for (std::uint32_t i = 0; i <= kDirections; ++i) {
        const float angle = kTurn / kDirections * static_cast<float>(i);
        rays.push_back(std::sin(angle));
        rays.push_back(std::cos(angle));
    }
    return rays;
}

void GroundHorizon::set_viewpoint(const TerrainLod& ground, const glm::vec3& eye) {
    // For an eye below the ground, the ground is invisible and occludes nothing.
    ground_ = ground.eye_height() > 0.0F ? &ground : nullptr;
    eye_ = eye;
    steps_ = distance_count(ground);
    for (Sector& sector : sectors_) {
        sector.known = false;
    }
}

float GroundHorizon::min_height_between(std::uint32_t sector, float distance) const {
    const float away = std::hypot(distance, ground_->eye_height());
    std::uint32_t level = 0;
    while (away >= TerrainLod::range(level)) {
        if (++level == ground_->levels()) {
            return -std::numeric_limits<float>::infinity(); // no ground is drawn there
        }
    }
    const float cell = TerrainLod::cell(level);
    const auto at = [&](std::uint32_t direction) {
        const float angle = kTurn / kDirections * static_cast<float>(direction);
        return glm::vec2(eye_.x + distance * std::sin(angle), eye_.z + distance * std::cos(angle)) /
               cell;
    };
    const glm::vec2 first = at(sector);
    const glm::vec2 last = at(sector + 1);
    // Takes all grid corners between the two points and one more on each side, because vertices
    // morph towards their neighbours.
    const glm::ivec2 low = glm::ivec2(glm::floor(glm::min(first, last))) - 1;
    const glm::ivec2 high = glm::ivec2(glm::floor(glm::max(first, last))) + 2;
    const HeightGrid& grid = ground_->grid(level);
    float lowest = std::numeric_limits<float>::infinity();
    for (std::int32_t z = low.y; z <= high.y; ++z) {
        for (std::int32_t x = low.x; x <= high.x; ++x) {
            lowest = std::min(lowest, grid.at(x, z));
        }
    }
    return lowest;
}

const std::vector<float>& GroundHorizon::slopes_of(std::uint32_t index) {
    Sector& sector = sectors_[index];
    if (!sector.known) {
        sector.known = true;
        sector.slopes.resize(steps_);
        float steepest = -std::numeric_limits<float>::infinity();
        float distance = kFirst;
        for (std::uint32_t step = 0; step < steps_; ++step, distance *= kRatio) {
            steepest =
                std::max(steepest, (min_height_between(index, distance) - eye_.y) / distance);
            sector.slopes[step] = steepest;
        }
    }
    return sector.slopes;
}

bool GroundHorizon::occludes(const glm::vec3& low, const glm::vec3& high) {
    if (ground_ == nullptr || steps_ == 0) {
        return false;
    }
    const glm::vec2 eye(eye_.x, eye_.z);
    const glm::vec2 near_corner =
        glm::clamp(eye, glm::vec2(low.x, low.z), glm::vec2(high.x, high.z)) - eye;
    const float nearest = glm::length(near_corner);
    if (nearest <= kFirst * kRatio) {
        return false;
    }
    const glm::vec2 middle = 0.5F * glm::vec2(low.x + high.x, low.z + high.z) - eye;
    float left = 0.0F; // angles of the outermost corners, from the middle
    float right = 0.0F;
    float farthest = 0.0F;
    for (const float x : {low.x, high.x}) {
        for (const float z : {low.z, high.z}) {
            const glm::vec2 corner = glm::vec2(x, z) - eye;
            const float angle =
                std::atan2(corner.x * middle.y - corner.y * middle.x, glm::dot(corner, middle));
            left = std::min(left, angle);
            right = std::max(right, angle);
            farthest = std::max(farthest, glm::length(corner));
        }
    }
    const float rise = high.y - eye_.y;
    const float slope = rise / (rise > 0.0F ? nearest : farthest) + kMargin;
    const auto step = static_cast<std::int64_t>(steps_to(nearest)) - 1;
    const std::size_t last =
        static_cast<std::size_t>(std::clamp<std::int64_t>(step, 0, std::int64_t{steps_} - 1));
    const float ahead = std::atan2(middle.x, middle.y);
    const auto sector_at = [&](float angle) {
        return static_cast<std::int64_t>(std::floor((ahead + angle) / kTurn * kDirections));
    };
    constexpr float kSlack = 1e-4F;
    const std::int64_t end = sector_at(right + kSlack);
    for (std::int64_t sector = sector_at(left - kSlack); sector <= end; ++sector) {
        const auto index = static_cast<std::uint32_t>((sector % kDirections + kDirections) %
                                                      std::int64_t{kDirections});
        if (slopes_of(index)[last] <= slope) {
            return false;
        }
    }
    return true;
}

} // namespace lsys::view
