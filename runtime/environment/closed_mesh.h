// SPDX-License-Identifier: MIT
// Whether a mesh is the closed surface that bounds an environment of kind Space, and has an inside
// for one of kind Solid.
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
    /// Whether the triangles have a common orientation after those in `turned` are turned.
    bool orientable = true;
    /// Closed, but neighbours face opposite sides: 1 for each triangle that is turned to face the
    /// side of the first triangle that it is connected with. Otherwise empty.
    std::vector<std::uint8_t> turned;
};

/// When `cancelled` became true, the result is that of an open mesh.
[[nodiscard]] MeshClosure mesh_closure(const EnvironmentMesh& mesh,
                                       const std::atomic<bool>* cancelled = nullptr);

} // namespace lsys
