// SPDX-License-Identifier: MIT
// Sheets of organs: grids of vertices whose rings have equal layouts. An organ is one sheet unless
// its contour is switched for one with which it cannot blend.
#pragma once

#include "runtime/meshing/impl/cross_sections.h"
#include "runtime/turtle/skeleton.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace lsys {

/// A ring of a sheet, with one element per column.
struct OrganRing {
    std::vector<glm::dvec3> positions;
    std::vector<double> around;             // texture coordinate u, 0 to 1
    std::vector<glm::dvec2> contour_points; // m, scaled by the width; x: right, y: up
    glm::dvec3 heading{};                   // unit vector
    double along = 0.0;                     // texture coordinate: length / circumference
    double circumference = 0.0;             // m; of an open contour: its length
    ItemColour colour = 0;                  // of the strip that begins here
    [[nodiscard]] bool is_point() const { return circumference == 0.0; }
};

struct OrganSheet {
    ContourLayout layout;
    bool turns_inwards = false; // columns turn from right to up: triangles swap two corners
    std::vector<OrganRing> rings;
};

/// The sheets of an organ with at least two points. `sides`: as make_organ().
[[nodiscard]] std::vector<OrganSheet> organ_sheets(std::span<const OrganPoint> points,
                                                   const std::vector<BytecodeContour>* contours,
                                                   std::uint32_t sides,
                                                   std::uint32_t level);

/// Unit normals of the vertices, ring by ring, smooth except at corners of the contour.
[[nodiscard]] std::vector<glm::dvec3> normals_of(const OrganSheet& sheet);

} // namespace lsys
