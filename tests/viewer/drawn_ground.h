// The surface of the ground as the shader draws it, found on the CPU.
#pragma once

#include "viewer/scene/terrain_lod.h"

namespace lsys::tests {

/// The height of the surface that `view` draws at a place, whatever of it is in view. `eye`: the
/// place of the camera that was selected last.
[[nodiscard]] float
drawn_height(const view::TerrainLod& lod, const glm::vec3& eye, float x, float z);

} // namespace lsys::tests
