// SPDX-License-Identifier: MIT
// Parts of shapes: surfaces of revolution about +Y, discs and boxes; normals and tangents.
#pragma once

#include "runtime/meshing/shapes.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <span>

namespace lsys {

/// A circle of a surface of revolution, with the normal there in (radius, y).
struct ProfilePoint {
    float radius = 0.0F;
    float y = 0.0F;
    glm::vec2 normal{};
};

/// Appends a vertex; returns its index.
std::uint32_t append_vertex(ShapePart& part,
                            const glm::vec3& position,
                            const glm::vec3& normal,
                            const glm::vec2& texture_coordinate);
/// Smooth normals of a rising profile.
void smooth_normals(std::span<ProfilePoint> profile);
/// Appends the surface that a rising profile makes when it turns about +Y. A point of radius 0 is a
/// pole. The texture coordinate u goes around, v down.
void append_revolution(ShapePart& part, std::span<const ProfilePoint> profile, std::uint32_t sides);
/// Appends a disc of diameter 1 perpendicular to +Y, with its front up or down.
void append_disc(ShapePart& part, float y, bool up, std::uint32_t sides);
/// Appends the cube of side 1 that stands on the origin.
void append_cube(ShapePart& part);

/// Sets normals of vertices from the triangles around them, weighted by area.
void complete_normals(ShapePart& part);
/// Sets tangents along rising u, orthogonal to the normals (Lengyel 2001); any orthogonal vector
/// where the texture coordinates define no tangent.
void complete_tangents(ShapePart& part);

} // namespace lsys
