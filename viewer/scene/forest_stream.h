// SPDX-License-Identifier: MIT
// ForestStream: the squares of a streamed forest that a camera needs, nearest first, within a
// budget of memory. They depend only on the camera, the size of the picture and the layout, not on
// earlier cameras.
#pragma once

#include "viewer/scene/camera.h"
#include "viewer/scene/streamed_trees.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace lsys::view {

/// Part of the budget for squares that the camera needs. The rest is for squares that it needed
/// before, in case it turns back.
inline constexpr double kWantedPart = 0.75;
/// Min height in pixels of the tallest tree of a wanted square.
inline constexpr float kMinStreamedPixels = 3.0F;

struct WantedSquares {
    std::vector<SquareId> squares; // nearest first
    /// Distance from the eye, m, within which all ground is in wanted squares or has no trees.
    float range = 0.0F;
};

class ForestStream {
public:
    /// `expected_trees`: upper estimate of the number of trees in a part of the ground; a function of
    /// the region alone. `max_bytes`: budget.
    ForestStream(const SquareLayout& layout,
                 float tallest,
                 std::function<double(const Region& region)> expected_trees,
                 std::uint64_t max_bytes);

    /// `ground`: height of the ground below the eye, m. `picture_height`: pixels.
    [[nodiscard]] WantedSquares
    wanted(const Camera& camera, float ground, std::uint32_t picture_height) const;

    [[nodiscard]] const SquareLayout& layout() const { return layout_; }
    [[nodiscard]] std::uint64_t max_bytes() const { return max_bytes_; }
    /// Expected bytes of a square when it is shown.
    [[nodiscard]] double expected_bytes(const SquareId& id) const;

private:
    SquareLayout layout_;
    float tallest_; // m, height of the tallest tree of the forest
    std::function<double(const Region& region)> expected_trees_;
    std::uint64_t max_bytes_;
};

} // namespace lsys::view
