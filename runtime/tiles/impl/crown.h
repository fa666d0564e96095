// SPDX-License-Identifier: MIT
// Crown: a plant seen from above, for tiles that show no single trees.
#pragma once

#include "runtime/meshing/mesh.h"

#include <glm/vec3.hpp>

namespace lsys {

struct Crown {
    double area = 0.0;      // m2 of ground that the plant covers
    double height = 0.0;    // m, mean height of its surface as seen from above
    glm::dvec3 colour{0.0}; // linear; mean of the plant seen from above
};

/// Measures the mesh from above, with kCrownLines by kCrownLines samples.
[[nodiscard]] Crown crown_of(const Mesh& mesh);
inline constexpr int kCrownLines = 128;

} // namespace lsys
