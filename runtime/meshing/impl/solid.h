// SPDX-License-Identifier: MIT
// One closed surface around the whole plant: MeshMethod::Solid.
#pragma once

#include "runtime/meshing/impl/mesh_builder.h"
#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <optional>

namespace lsys {

/// Appends the surface of the union of all segments, as cones with round ends, and of all triangles
/// of `flat`; each of them is at least MeshOptions::min_width wide. `flat` has colours and
/// segments; `builder` must be empty. The surface is closed, faces outwards, does not intersect
/// itself and encloses no cavity. `shells`: receives the number of separate pieces. Returns a Stop
/// if the surface needs more memory than the options allow; MeshBuilder::stop() reports other
/// failures.
[[nodiscard]] std::optional<Stop> append_solid(const Skeleton& skeleton,
                                               const Mesh& flat,
                                               const MeshOptions& options,
                                               MeshBuilder& builder,
                                               std::uint64_t& shells);

} // namespace lsys
