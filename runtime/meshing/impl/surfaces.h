// Pieces that shapes are made of: surfaces of revolution about +Y, discs, boxes, and what completes
// a mesh with normals and tangents.
#pragma once

#include "runtime/meshing/shapes.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>

namespace lsys {

/// A circle of a surface of revolution, with the normal there in (radius, y).
struct ProfilePoint {
    float radius = 0.0F;
    float y = 0.0F;
    glm::vec2 normal{};
};

/// Profile normals that turn evenly from one piece to the next. The profile rises.
void smooth_normals(std::span<ProfilePoint> profile);
/// Turns a rising profile about +Y. A point of radius 0 is a pole. u goes around, v down.
void append_revolution(ShapePart& part, std::span<const ProfilePoint> profile, std::uint32_t sides);
/// A disc of diameter 1 across +Y, its front up or down.
void append_disc(ShapePart& part, float y, bool up, std::uint32_t sides);
/// The cube of side 1 that stands on the origin.
void append_cube(ShapePart& part);

/// Normals of vertices from the triangles around them, weighted by area.
void complete_normals(ShapePart& part);
/// Tangents along rising u, made orthogonal to the normals (Lengyel 2001). Where the texture
/// coordinates give none, any.
void complete_tangents(ShapePart& part);

} // namespace lsys
