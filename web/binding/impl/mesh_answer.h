// SPDX-License-Identifier: MIT
// Meshes and skeletons as blocks of an answer.
#pragma once

#include "runtime/meshing/mesh.h"
#include "runtime/turtle/skeleton.h"
#include "web/binding/answer.h"

namespace lsys::web {

/// Moves the arrays of `mesh` into blocks, and describes them with parts, materials and pictures.
/// Pictures that are computed, not read from files, have an `id`, so that callers store them once.
[[nodiscard]] Json add_mesh(Mesh mesh, Answer& answer);
/// Adds the arrays of `skeleton`: segments as start, end, radii, parent, order, colour; objects;
/// polygons.
[[nodiscard]] Json add_skeleton(const Skeleton& skeleton, Answer& answer);

} // namespace lsys::web
