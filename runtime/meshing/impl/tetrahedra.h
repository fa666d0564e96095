// SPDX-License-Identifier: MIT
// Extracts a surface from a distance function by marching tetrahedra. A cube is divided into
// tetrahedra, which are bisected at their longest edges (Maubach 1995) until each tetrahedron is
// small relative to the shapes near it.
#pragma once

#include "runtime/meshing/impl/solid_shapes.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace lsys {

/// A union of shapes, cut off flat below `ground`.
struct Solid {
    std::vector<SolidShape> shapes;
    std::optional<double> ground; // m
    double cell = 0.5;            // edge of a cell / radius of its shape, at most 0.9
};

struct SolidVertex {
    glm::dvec3 position{};
    std::uint32_t shape = 0; // number of the nearest shape
    bool on_ground = false;  // lies on the flat base
};

struct SolidSurface {
    std::vector<SolidVertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles; // counter-clockwise from outside
};

/// The surface of a solid. Each edge belongs to two triangles, in opposite directions. Triangles
/// meet only at common vertices and edges, because each triangle lies in one tetrahedron. Vertices
/// lie on the surface after it was moved outwards so that faceted cones have the volume of round
/// cones. The result is the same for any number of threads. Returns nullopt if more than
/// `max_bytes` are needed. Throws std::bad_alloc. Precondition: the shapes have finite corners and
/// radii above 0.
[[nodiscard]] std::optional<SolidSurface>
extract_surface(const Solid& solid, std::uint64_t max_bytes, std::uint32_t threads);

} // namespace lsys
