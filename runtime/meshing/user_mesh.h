// SPDX-License-Identifier: MIT
// Meshes of `#object X "leaf.obj"`: Wavefront OBJ, its geometry (v, vt, vn, f) and the names
// of its materials (mtllib, usemtl). Other lines are skipped. The resulting mesh has unit normals,
// valid indices, no triangle without area, and v that goes down.
#pragma once

#include "grammar/base/result.h"
#include "runtime/meshing/mesh.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

namespace lsys {

/// Reads the text of an OBJ file, in time linear in its length. Polygons become fans. Corners
/// without a normal get the mean normal of the faces around their vertex, weighted by area. Texture
/// coordinates are empty if the file has none. Uses at most `max_bytes` beside `text`.
[[nodiscard]] Result<UserMesh> read_obj(std::string_view text, std::uint64_t max_bytes);

/// Pictures of a material in an MTL file; an empty name: no picture.
struct MaterialPicture {
    bool has_options = false; // a name has options other than -bm of a normal map
    ObjName file;             // file of map_Kd
    ObjName opacity;          // file of map_d
    ObjName normal_map;       // file of map_Bump, bump or norm
    float bump = 1.0F;        // factor of the heights of map_Bump, by -bm
};
/// Pictures of the materials `wanted`, by material name. Omits materials that `mtl` lacks.
[[nodiscard]] std::unordered_map<std::string, MaterialPicture>
pictures_of(std::string_view mtl, std::span<const ObjName> wanted);

} // namespace lsys
