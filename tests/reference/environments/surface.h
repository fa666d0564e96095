// SPDX-License-Identifier: MIT
// Surfaces of triangles, and what is inside them (docs/language.md section 13.4, `solid`).

#pragma once

#include "tests/reference/environments/vector.h"

#include <cstddef>
#include <vector>

namespace lsys::reference {

using Triangle = std::array<Vector, 3>;

// In the order of the file; a face with more than three corners is a fan.
using Surface = std::vector<Triangle>;

// The way from `place` to the nearest point of the triangle, by the arithmetic that
// runtime/environment/impl/triangle_distance.h defines.
Vector way_to(const Triangle& triangle, const Vector& place);

bool has_area(const Triangle& triangle);

// Whether each edge belongs to exactly two triangles. Corners at one place are one vertex;
// triangles with two equal corners do not count.
bool is_closed(const Surface& surface);

// A closed surface whose triangles face one side: all inwards or all outwards in each connected
// part. Precondition: is_closed(surface), and no part has one side only.
Surface oriented(const Surface& surface);

// How often the surface winds around the place: the sum of the solid angles of its triangles (van
// Oosterom & Strackee 1983) in units of 4 pi, rounded. Precondition: the surface is closed, and
// the place is not on it.
int winding_number(const Surface& surface, const Vector& place);

} // namespace lsys::reference
