// SPDX-License-Identifier: MIT
// Computes, on the CPU, the surface of the ground that the shader draws.
#pragma once

#include "viewer/scene/terrain_lod.h"

namespace lsys::tests {

/// Height in m of the drawn surface at a place, which may be outside of the view. `eye`: the
/// position of the eye in the last TerrainLod::select().
[[nodiscard]] float
drawn_height(const view::TerrainLod& lod, const glm::vec3& eye, float x, float z);

} // namespace lsys::tests
