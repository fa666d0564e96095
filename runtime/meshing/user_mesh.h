// Meshes of `#object X "leaf.obj"`: Wavefront OBJ, the geometry of it (v, vt, vn, f) and the names
// of its materials (mtllib, usemtl). Lines of any other kind are skipped. What is read has unit
// normals, indices in range and no triangle without area; texture coordinates are turned to v
// downwards.
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
/// without a normal get that of the faces around their vertex, weighted by area. The texture
/// coordinates of a file without any are empty. At most `max_bytes` are used beside `text`.
[[nodiscard]] Result<UserMesh> read_obj(std::string_view text, std::uint64_t max_bytes);

/// What a file of materials (MTL) says of the picture of one.
struct MaterialPicture {
    bool has_options = false; // that stand before the picture's name
    ObjName file;             // of map_Kd; no name: it has none
};
/// Those of the materials `wanted`, by their names.
[[nodiscard]] std::unordered_map<std::string, MaterialPicture>
pictures_of(std::string_view mtl, std::span<const ObjName> wanted);

} // namespace lsys
