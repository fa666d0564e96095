// SPDX-License-Identifier: MIT
// Outlines of the opaque parts of a picture, for drawings.
#pragma once

#include "runtime/meshing/texture.h"

#include <glm/vec2.hpp>

#include <vector>

namespace lsys {

/// Closed lines around the texels of at least half opacity and around holes, filled by the even-odd
/// rule. In texture coordinates, v downwards. `low` and `high`: corners of the part of the picture
/// to trace. The error is about a texel, or 1/200 of the longer side of a large picture; lines
/// around less than 1/10,000 of the picture are left out.
[[nodiscard]] std::vector<std::vector<glm::vec2>>
opacity_outline(const Texture& picture, const glm::vec2& low, const glm::vec2& high);

} // namespace lsys
