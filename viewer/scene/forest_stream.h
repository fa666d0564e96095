// SPDX-License-Identifier: MIT
// ForestStream: finds the squares of a streamed forest that a camera needs, nearest first, within a
// budget of memory. They depend only on the camera, the size of the picture and the layout of the
// squares, not on earlier cameras.
#pragma once

#include "viewer/scene/camera.h"
#include "viewer/scene/streamed_trees.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace lsys::view {

/// Fraction of the budget for squares that the camera needs. The remaining budget is for squares
/// that it needed before, in case the camera turns back.
inline constexpr double kWantedPart = 0.75;
/// Min height in pixels of the tallest tree in a square that a camera needs.
inline constexpr float kMinStreamedPixels = 3.0F;

struct WantedSquares {
    std::vector<SquareId> squares; // nearest first
    /// Distance from the eye in m up to which all ground is in wanted squares or has no trees.
    float range = 0.0F;
};

class ForestStream {
public:
    /// `expected_trees`: returns an upper estimate of the number of trees in a part of the ground,
    /// which depends on the region alone. `max_bytes`: budget of memory.
    ForestStream(const SquareLayout& layout,
                 float tallest,
                 std::function<double(const Region& region)> expected_trees,
                 std::uint64_t max_bytes);

    /// `ground`: height in m of the ground below the eye. `picture_height`: in pixels.
    [[nodiscard]] WantedSquares
    wanted(const Camera& camera, float ground, std::uint32_t picture_height) const;

    [[nodiscard]] const SquareLayout& layout() const { return layout_; }
    [[nodiscard]] std::uint64_t max_bytes() const { return max_bytes_; }
    /// Expected number of bytes of a square while it is shown.
    [[nodiscard]] double expected_bytes(const SquareId& id) const;

private:
    SquareLayout layout_;
    float tallest_; // m, height of the tallest tree of the forest
    std::function<double(const Region& region)> expected_trees_;
    std::uint64_t max_bytes_;
};

} // namespace lsys::view
