// SPDX-License-Identifier: MIT
// Environments of kind `solid`, computed from every plane and every triangle.

#pragma once

#include "tests/reference/environments/place.h"
#include "tests/reference/environments/surface.h"

namespace lsys::reference {

// a x + b y + c z + d = 0
using Plane = std::array<double, 4>;

// The planes and meshes of `#sense NAME solid`, both in the order of the statement.
struct Solid {
    std::vector<Plane> planes;
    std::vector<Surface> meshes;
};

// For each place: signed distance d to the nearest surface, and the direction x y z to it.
Answers solid_answers(const Solid& solid, const std::vector<Place>& places);

// The answer for the meshes alone; its distance has no sign.
std::vector<double> nearest_of_meshes(const std::vector<Surface>& meshes, const Vector& place);

} // namespace lsys::reference
