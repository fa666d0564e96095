// SPDX-License-Identifier: MIT
// Surface files (.s) of cpfg, L-studio and vlab: bicubic Bezier patches. The file has a box, the
// number of steps of a patch, the contact point, the directions of heading and up, the size, then
// the patches, each with a name, colours, the names of its neighbours, and 4 x 4 control points.
#pragma once

#include "grammar/base/result.h"
#include "runtime/meshing/mesh.h"
#include "runtime/turtle/surface_name.h"

#include <cstdint>
#include <string_view>

namespace lsys {

/// Reads the text of a surface file. The mesh has the contact point at the origin, the heading of
/// the file along +Y and its up direction along -Z, which are the axes H and -U of the turtle: up
/// of cpfg is left x heading, and turns to the ground where a branch bends down. It is scaled by
/// 1 / SIZE. `name` sets scale, steps, texture coordinates. Colours and names of neighbours are not
/// read; patches that share an edge are smooth across it. Uses at most `max_bytes` beside `text`.
[[nodiscard]] Result<UserMesh>
read_patches(std::string_view text, const SurfaceName& name, std::uint64_t max_bytes);

/// Reads the mesh of `#object X "name";`: a surface file or Wavefront OBJ, by the name.
[[nodiscard]] Result<UserMesh>
read_object_file(std::string_view name, std::string_view text, std::uint64_t max_bytes);

} // namespace lsys
