// SPDX-License-Identifier: MIT
// The nearest point of a triangle, with the arithmetic that defines its bits (environments of kind
// Solid).
#pragma once

#include "runtime/environment/impl/lanes.h"
#include "runtime/environment/impl/vectors.h"

#include <algorithm>
#include <array>
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

/// Two vectors, one in each lane.
using PairVector = std::array<Pair, 3>;

[[nodiscard]] inline Pair dot(const PairVector& a, const PairVector& b) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/// t of candidates 2 to 4 of nearest_point(). `way`: vector from the start of the side to the place.
[[nodiscard]] inline Pair part_of_side(const PairVector& side, const PairVector& way) {
    const Pair length_squared = dot(side, side);
    const Pair part = dot(way, side) / length_squared;
    return lesser(Pair{1.0, 1.0}, greater(Pair{}, length_squared > 0.0 ? part : Pair{}));
}

/// The foot of a place on the plane of a triangle.
struct Foot {
    Vector3 point{};
    bool is_within = false; // in the triangle
};

/// Candidate 1 of nearest_point().
[[nodiscard]] inline Foot foot_of(const Triangle& triangle, const Vector3& place) {
    const Vector3 u = minus(triangle.b, triangle.a);
    const Vector3 v = minus(triangle.c, triangle.a);
    const Vector3 normal = cross(u, v);
    const double area_squared = squared_length(normal);
    const Vector3 w = minus(place, triangle.a);
    // beta and gamma; NaN or infinite without an area
    const Pair shares = Pair{dot(cross(w, v), normal), dot(cross(u, w), normal)} / area_squared;
    const double beta = shares[0];
    const double gamma = shares[1];
    const bool is_within =
        (area_squared > 0.0) & (beta >= 0.0) & (gamma >= 0.0) & (beta + gamma <= 1.0);
    return {plus(plus(triangle.a, times(u, beta)), times(v, gamma)), is_within};
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
    // Two candidates at once: the sides a b and b c in `first`, the side c a and the foot in
    // `second`.
    const auto& [a, b, c] = triangle;
    const Foot foot = foot_of(triangle, place);
    PairVector first_side;
    PairVector second_side;
    PairVector first_way;
    PairVector second_way;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first_side[axis] = Pair{b[axis], c[axis]} - Pair{a[axis], b[axis]};
        second_side[axis] = Pair{a[axis], a[axis]} - Pair{c[axis], a[axis]};
        first_way[axis] = place[axis] - Pair{a[axis], b[axis]};
        second_way[axis] = place[axis] - Pair{c[axis], a[axis]};
    }
    const Pair first_part = part_of_side(first_side, first_way);
    const Pair second_part = part_of_side(second_side, second_way);
    PairVector first_away;
    PairVector second_away;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = std::min(std::min(a[axis], b[axis]), c[axis]);
        const double high = std::max(std::max(a[axis], b[axis]), c[axis]);
        const auto away = [&](Pair point) {
            return greater(Pair{low, low}, lesser(Pair{high, high}, point)) - place[axis];
        };
        const Pair side = Pair{c[axis], a[axis]} + second_side[axis] * second_part;
        first_away[axis] = away(Pair{a[axis], b[axis]} + first_side[axis] * first_part);
        second_away[axis] = away(Pair{side[0], foot.point[axis]});
    }
    const Pair first_squared = dot(first_away, first_away);
    Pair second_squared = dot(second_away, second_away);
    second_squared[1] =
        foot.is_within ? second_squared[1] : std::numeric_limits<double>::infinity();
    const auto is_near = (first_squared <= limit) | (second_squared <= limit);
    NearestPoint nearest;
    if ((is_near[0] | is_near[1]) == 0) {
        return nearest;
    }
    const auto consider = [&](const PairVector& away, Pair squared, std::size_t lane) {
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
