// SPDX-License-Identifier: MIT
// The nearest point of a triangle, with the arithmetic that defines its bits (environments of kind
// Solid).
#pragma once

#include "runtime/environment/impl/vectors.h"

#include <algorithm>
#include <limits>

namespace lsys {

struct Triangle {
    Vector3 a{};
    Vector3 b{};
    Vector3 c{};
};

struct NearestPoint {
    Vector3 away{};                                           // vector from the place to the point
    double squared = std::numeric_limits<double>::infinity(); // length of `away`, squared
};

/// (b - a) x (c - a); 0 0 0 for a triangle without area.
[[nodiscard]] inline Vector3 area_vector(const Triangle& triangle) {
    return cross(minus(triangle.b, triangle.a), minus(triangle.c, triangle.a));
}

/// Up to four candidates, of which the first with the least squared distance is the nearest point:
///   1. the foot of the place on the plane. With u = b - a, v = c - a, w = p - a, n = u x v,
///      s = n . n, beta = ((w x v) . n) / s and gamma = ((u x w) . n) / s, it is a candidate if
///      s > 0, beta >= 0, gamma >= 0 and beta + gamma <= 1: a + u beta + v gamma, added in this
///      order;
///   2. to 4. of each side from e to f, in the order a b, b c, c a, the point e + (f - e) t, with
///      t = ((p - e) . (f - e)) / ((f - e) . (f - e)), moved into 0 to 1; 0 for a side of length 0.
/// Each candidate q is moved into the box of the three corners, component by component; its squared
/// distance is (dx^2 + dy^2) + dz^2 of d = q - p. Products, sums and quotients are rounded one by
/// one in binary64, in the order of vectors.h. The sides make the result right also for slivers,
/// whose foot is inexact. Because q is in the box, the distance to a box around the triangle,
/// computed by the same operations, is never greater, so a bounding volume hierarchy never skips
/// the nearest triangle. Beyond the squared distance `limit` the result is at infinity.
[[nodiscard]] inline NearestPoint
nearest_point(const Triangle& triangle, const Vector3& place, double limit) {
    // Two numbers at once: the sides a b and b c in `first`, the side c a and the foot in `second`.
    using Pair = double __attribute__((vector_size(16)));
    const auto less = [](Pair x, Pair y) { return x < y ? x : y; }; // y for NaN
    const auto more = [](Pair x, Pair y) { return x > y ? x : y; };
    const auto& [a, b, c] = triangle;
    const Vector3 u = minus(b, a);
    const Vector3 v = minus(c, a);
    const Vector3 normal = cross(u, v);
    const double area_squared = squared_length(normal);
    const Vector3 w = minus(place, a);
    // beta and gamma; NaN or infinite without an area
    const Pair shares = Pair{dot(cross(w, v), normal), dot(cross(u, w), normal)} / area_squared;
    const auto [beta, gamma] = std::array<double, 2>{shares[0], shares[1]};
    const bool has_foot =
        (area_squared > 0.0) & (beta >= 0.0) & (gamma >= 0.0) & (beta + gamma <= 1.0);
    const Vector3 foot = plus(plus(a, times(u, beta)), times(v, gamma));

    std::array<Pair, 3> first_side;
    std::array<Pair, 3> second_side;
    std::array<Pair, 3> first_way; // vector from the start of the side to the place
    std::array<Pair, 3> second_way;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first_side[axis] = Pair{b[axis], c[axis]} - Pair{a[axis], b[axis]};
        second_side[axis] = Pair{a[axis], a[axis]} - Pair{c[axis], a[axis]};
        first_way[axis] = place[axis] - Pair{a[axis], b[axis]};
        second_way[axis] = place[axis] - Pair{c[axis], a[axis]};
    }
    const auto dots = [](const std::array<Pair, 3>& x, const std::array<Pair, 3>& y) {
        return (x[0] * y[0] + x[1] * y[1]) + x[2] * y[2];
    };
    const auto along = [&](const std::array<Pair, 3>& side, const std::array<Pair, 3>& way) {
        const Pair length_squared = dots(side, side);
        const Pair part = dots(way, side) / length_squared;
        return less(Pair{1.0, 1.0}, more(Pair{}, length_squared > 0.0 ? part : Pair{}));
    };
    const Pair first_along = along(first_side, first_way);
    const Pair second_along = along(second_side, second_way);
    std::array<Pair, 3> first_away;
    std::array<Pair, 3> second_away;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = std::min(std::min(a[axis], b[axis]), c[axis]);
        const double high = std::max(std::max(a[axis], b[axis]), c[axis]);
        const Pair first = Pair{a[axis], b[axis]} + first_side[axis] * first_along;
        const Pair side = Pair{c[axis], a[axis]} + second_side[axis] * second_along;
        const Pair second{side[0], foot[axis]};
        const auto moved = [&](Pair point) {
            return more(Pair{low, low}, less(Pair{high, high}, point)) - place[axis];
        };
        first_away[axis] = moved(first);
        second_away[axis] = moved(second);
    }
    const Pair first_squared = dots(first_away, first_away);
    Pair second_squared = dots(second_away, second_away);
    second_squared[1] = has_foot ? second_squared[1] : std::numeric_limits<double>::infinity();
    const auto is_near = (first_squared <= limit) | (second_squared <= limit);
    NearestPoint nearest;
    if ((is_near[0] | is_near[1]) == 0) {
        return nearest;
    }
    const auto consider = [&](const std::array<Pair, 3>& away, Pair squared, std::size_t lane) {
        if (squared[lane] < nearest.squared) {
            nearest = {{away[0][lane], away[1][lane], away[2][lane]}, squared[lane]};
        }
    };
    consider(second_away, second_squared, 1);
    consider(first_away, first_squared, 0);
    consider(first_away, first_squared, 1);
    consider(second_away, second_squared, 0);
    return nearest;
}

} // namespace lsys
