// SPDX-License-Identifier: MIT
// Orientation predicates whose sign is exact: a filter in binary64, and behind it expansions
// (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric
// predicates"). Exact while products of three coordinates stay within the range of binary64, which
// holds for magnitudes between 1e-80 and 1e90.
#pragma once

#include "runtime/environment/environment.h"

#include <array>

namespace lsys {

using Vector2 = std::array<double, 2>;

/// Sign of (a - p) x (b - p): 1 if p, a, b turn left, -1 if they turn right, 0 on one line.
[[nodiscard]] int orientation(const Vector2& a, const Vector2& b, const Vector2& p);

/// Sign of the determinant of the rows a - p, b - p, c - p; 0 if p is in the plane of a, b, c.
[[nodiscard]] int
orientation(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p);

} // namespace lsys
