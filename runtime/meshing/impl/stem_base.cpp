// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/stem_base.h"

#include "runtime/meshing/impl/axes.h"
#include "runtime/meshing/impl/grooves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lsys {

namespace {

constexpr float kGroundTolerance = 1e-3F; // max abs(y) of a stem's base, per height of the flare
// Depth of the ridges at the ground, in radii:
constexpr float kRidgeDepthPerFlare = 0.75F; // depth / growth of the radius by the flare
constexpr float kMaxRidgeDepth = 0.6F;       // max depth
constexpr float kMeanRidge = 13.0F / 35.0F;  // mean of ridge()
// Factors of ridge() for the ridges of a flare, by number of the ridge.
constexpr std::array<float, kMaxRoots> kHeights{1.0F,  0.8F, 1.15F, 0.9F, 1.2F,
                                                0.75F, 1.1F, 0.85F, 1.05F};

/// The profile of ridges: 1 at whole x, 0 halfway between; ridges are narrower than valleys.
float ridge(float x) {
    const float rise = 1.0F + groove_depth(x);
    return rise * rise;
}

float ridge_slope(float x) {
    return 2.0F * (1.0F + groove_depth(x)) * groove_slope(x);
}

} // namespace

bool stands_on_ground(const Segment& segment, const Flare& flare) {
    return segment.parent == kNoSegment && !segment.cut &&
           std::abs(segment.base.y) <= kGroundTolerance * flare.height &&
           direction(segment.frame).y > 0.0F;
}

BaseWidening widening_of(const Flare& flare) {
    return {.begin = 0.0F,
            .end = flare.height,
            .factor = flare.factor - 1.0F,
            .radius = 0.0F,
            .parts = kFlareParts};
}

Roots::Roots(const Flare& flare)
    : count_(flare.roots), reach_(flare.height),
      depth_(std::min(kRidgeDepthPerFlare * (flare.factor - 1.0F), kMaxRidgeDepth)), mean_(0.0F) {
    for (std::uint32_t i = 0; i < count_; ++i) {
        mean_ += kHeights[i];
    }
    mean_ *= kMeanRidge / static_cast<float>(count_);
}

NoiseSample Roots::at(float turn, double arc) const {
    const float rest = 1.0F - static_cast<float>(arc) / reach_;
    if (!(rest > 0.0F)) {
        return {};
    }
    const float x = static_cast<float>(count_) * turn;
    const float height = kHeights[static_cast<std::uint32_t>(std::floor(x + 0.5F)) % count_];
    const float value = height * ridge(x) - mean_;
    return {.value = depth_ * rest * rest * value,
            .by_angle = depth_ * rest * rest * height * ridge_slope(x) *
                        static_cast<float>(count_) / (2.0F * std::numbers::pi_v<float>),
            .by_length = -2.0F * depth_ * rest * value / reach_};
}

} // namespace lsys
