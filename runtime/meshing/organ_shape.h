// SPDX-License-Identifier: MIT
// The surface of an organ (docs/language.md section 15): rings of vertices across its axis, which
// follow its contours, and caps at the ends of a closed surface.
#pragma once

#include "runtime/meshing/shapes.h"
#include "runtime/turtle/skeleton.h"

#include <cstdint>
#include <vector>

namespace lsys {

/// Triangles of one colour, with complete normals, texture coordinates and tangents.
struct OrganPart {
    ItemColour colour = 0;
    ShapePart shape; // its material is set
};

/// A surface in the frame of its object, at size 1.
struct OrganShape {
    std::vector<OrganPart> parts;
};

/// The surface of an organ. `sides`: of its rings; 0: the largest number that its points state. At
/// level k > 0 it has fewer sides and rings. Precondition: is_organ(object).
[[nodiscard]] OrganShape make_organ(const Skeleton& skeleton,
                                    const PlacedObject& object,
                                    std::uint32_t sides,
                                    std::uint32_t level);

/// A strip of the surface between two rings, for drawings.
struct OrganStrip {
    ItemColour colour = 0;
    std::vector<glm::vec3> corners;
};
/// The surface of an organ as strips.
[[nodiscard]] std::vector<OrganStrip> organ_strips(const Skeleton& skeleton,
                                                   const PlacedObject& object);

} // namespace lsys
