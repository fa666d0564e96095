// SPDX-License-Identifier: MIT
// Frame: a coordinate system whose origin is the middle of a set of points and whose unit is about
// their extent, so that binary32 is exact enough for bounds of distances.
#pragma once

#include "runtime/environment/impl/vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lsys {

/// A box around points.
struct PointBox {
    Vector3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Vector3 high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    void add(const Vector3& point) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], point[axis]);
            high[axis] = std::max(high[axis], point[axis]);
        }
    }
};

/// A place in a frame, in binary32.
struct FramedPlace {
    std::array<float, 3> at{};
    double margin = 0.0;     // more than the max error of a distance computed from `at` in binary32
    bool is_bounded = false; // false: bounds are not used, because binary32 could overflow
};

class Frame {
public:
    Frame() = default;
    /// Scales the coordinates of the box, and `length` (m), to at most 1/2. Precondition: the box
    /// has an extent, or `length` is not 0. Near the limits of binary64 the scale is 0; is_bounded
    /// is then false for all places.
    explicit Frame(const PointBox& box, double length = 0.0) {
        double extent = length; // becomes the max of `length` and half of the box's longest edge
        for (std::size_t axis = 0; axis < 3; ++axis) {
            origin_[axis] = 0.5 * box.low[axis] + 0.5 * box.high[axis];
            extent = std::max(extent, 0.5 * box.high[axis] - 0.5 * box.low[axis]);
        }
        scale_ = std::ldexp(1.0, -std::ilogb(extent) - 2);
    }

    /// Units per metre, a power of two.
    [[nodiscard]] double scale() const { return scale_; }
    [[nodiscard]] Vector3 framed(const Vector3& point) const {
        return times(minus(point, origin_), scale_);
    }
    /// With u = 2^-24 and s = 1 + the largest coordinate of the place, the vector from a rounded
    /// point of the box to the rounded place has an error of 3.5 u s. Its component along an axis
    /// has an error of 12 u s, its distance from the axis one of 29 u s, and rounding the axis,
    /// which changes its length, adds 12 u s. Together a distance is wrong by 46 u s at most; the
    /// margin is 64 u s.
    [[nodiscard]] FramedPlace framed_place(const Vector3& place) const {
        constexpr double kLargest = 0x1p50; // its square is far below the max of binary32
        const Vector3 at = framed(place);
        const double size = 1.0 + std::max({std::abs(at[0]), std::abs(at[1]), std::abs(at[2])});
        FramedPlace result;
        result.is_bounded = is_finite(at) && size < kLargest && scale_ > 0.0;
        if (result.is_bounded) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                result.at[axis] = static_cast<float>(at[axis]);
            }
            result.margin = 0x1p-18 * size;
        }
        return result;
    }

private:
    Vector3 origin_{}; // m
    double scale_ = 1.0;
};

} // namespace lsys
