// SPDX-License-Identifier: MIT
// Tests whether a mesh is a closed surface. An environment of kind Space needs one around its
// markers; in one of kind Solid only closed meshes have an inside.
#pragma once

#include "runtime/environment/environment.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace lsys {

/// Properties of the edges of a mesh. Corners at one place are one vertex; triangles with two equal
/// corners do not count.
struct MeshClosure {
    bool closed = false; // each edge belongs to two triangles, and there is a triangle
    /// Whether all triangles face one side once the triangles in `turned` are turned.
    bool orientable = true;
    /// By triangle of a closed mesh in which some neighbours face opposite sides: 1 if the triangle
    /// must be turned to face the same side as the first triangle connected to it. Otherwise empty.
    std::vector<std::uint8_t> turned;
};

/// If `cancelled` becomes true, returns the result for an open mesh.
[[nodiscard]] MeshClosure mesh_closure(const EnvironmentMesh& mesh,
                                       const std::atomic<bool>* cancelled = nullptr);

} // namespace lsys
