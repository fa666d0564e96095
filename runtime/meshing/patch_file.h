// SPDX-License-Identifier: MIT
// Surface files (.s) of cpfg, L-studio and vlab: bicubic Bezier patches. The file has a box, the
// number of steps of a patch, the contact point, the directions of heading and up, the size, then
// the patches, each with a name, colours, the names of its neighbours, and 4 x 4 control points.
#pragma once

#include "grammar/base/result.h"
#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lsys {

/// The file and the scale of `#object X "leaf.s#0.5";`.
struct PatchName {
    std::string_view path;
    float scale = 1.0F;
};
/// The parts of the name of a surface file, which ends in `.s` or `.S` and may have a scale above 0
/// behind `#`; nullopt for another name.
[[nodiscard]] std::optional<PatchName> patch_name(std::string_view name);
/// The name without the scale of a surface file; other names as they are.
[[nodiscard]] std::string path_without_scale(const std::string& name);

/// Reads the text of a surface file. The mesh has the contact point at the origin, the heading of
/// the file along +Y and its up direction along +Z, and is scaled by 1 / SIZE, as in cpfg. Colours
/// and names of neighbours are not read; patches that share an edge are smooth across it. Uses at
/// most `max_bytes` beside `text`.
[[nodiscard]] Result<UserMesh> read_patches(std::string_view text, std::uint64_t max_bytes);

/// Reads the mesh of `#object X "name";`: a surface file or Wavefront OBJ, by the name.
[[nodiscard]] Result<UserMesh>
read_object_file(std::string_view name, std::string_view text, std::uint64_t max_bytes);

} // namespace lsys
