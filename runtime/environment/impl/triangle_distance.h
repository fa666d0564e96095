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
/// the nearest triangle.
[[nodiscard]] inline NearestPoint nearest_point(const Triangle& triangle, const Vector3& place) {
    const auto& [a, b, c] = triangle;
    Vector3 low;
    Vector3 high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(std::min(a[axis], b[axis]), c[axis]);
        high[axis] = std::max(std::max(a[axis], b[axis]), c[axis]);
    }
    NearestPoint nearest;
    const auto consider = [&](const Vector3& point) {
        Vector3 away;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            away[axis] = std::max(std::min(point[axis], high[axis]), low[axis]) - place[axis];
        }
        const double squared = squared_length(away);
        if (squared < nearest.squared) {
            nearest = {away, squared};
        }
    };
    const Vector3 u = minus(b, a);
    const Vector3 v = minus(c, a);
    const Vector3 normal = cross(u, v);
    const double area_squared = squared_length(normal);
    if (area_squared > 0.0) {
        const Vector3 w = minus(place, a);
        const double beta = dot(cross(w, v), normal) / area_squared;
        const double gamma = dot(cross(u, w), normal) / area_squared;
        if (beta >= 0.0 && gamma >= 0.0 && beta + gamma <= 1.0) {
            consider(plus(plus(a, times(u, beta)), times(v, gamma)));
        }
    }
    const auto consider_side = [&](const Vector3& from, const Vector3& to) {
        const Vector3 side = minus(to, from);
        const double length_squared = squared_length(side);
        const double along =
            length_squared > 0.0 ? dot(minus(place, from), side) / length_squared : 0.0;
        consider(plus(from, times(side, std::min(std::max(along, 0.0), 1.0))));
    };
    consider_side(a, b);
    consider_side(b, c);
    consider_side(c, a);
    return nearest;
}

} // namespace lsys
