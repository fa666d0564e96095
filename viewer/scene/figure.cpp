// SPDX-License-Identifier: MIT
#include "viewer/scene/figure.h"

#include <algorithm>

namespace lsys::view {

glm::vec3 figure_beside(const Bounds& plant) {
    constexpr float kGap = 0.2F; // m, between plant and person
    return {plant.high.x + kFigureHalfWidth + kGap, std::min(plant.low.y, 0.0F),
            0.5F * (plant.low.z + plant.high.z)};
}

Bounds with_figure(const Bounds& plant) {
    Bounds both = plant;
    const glm::vec3 feet = figure_beside(plant);
    both.add(feet - glm::vec3(kFigureHalfWidth, 0.0F, kFigureHalfWidth));
    both.add(feet + glm::vec3(kFigureHalfWidth, kFigureHeight, kFigureHalfWidth));
    return both;
}

} // namespace lsys::view
