// SPDX-License-Identifier: MIT
// The surface of the ground that the shader draws, computed on the CPU.
#pragma once

#include "viewer/scene/terrain_lod.h"

namespace lsys::tests {

/// Height, m, of the drawn surface at a place, also outside of the view. `eye`: the position given to
/// the last TerrainLod::select().
[[nodiscard]] float
drawn_height(const view::TerrainLod& lod, const glm::vec3& eye, float x, float z);

} // namespace lsys::tests
