// SPDX-License-Identifier: MIT
// The mesh of a standing person of 1.8 m, made of rounded limbs.
#pragma once

#include "runtime/meshing/mesh.h"

namespace lsys::view {

/// A person who stands with the feet at `feet`, m, and looks along +Z. One plain red material.
[[nodiscard]] Mesh make_figure_mesh(const glm::vec3& feet);

} // namespace lsys::view
