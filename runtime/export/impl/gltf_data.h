// Arrays of glTF files, and the rules for what is in them.
#pragma once

#include "runtime/meshing/mesh.h"

#include <cstdint>

namespace lsys {

enum class GltfArray : std::uint8_t {
    Positions,
    Normals,
    TextureCoordinates,
    Tangents,
    Colours,
    Joints,
    Weights,
    WindPivots,
    WindMotions,
    Indices,
    InverseBinds,
    Times,
    Translations,
    Rotations,
    Image,
};

/// Whether vertices of a part have palette colours that differ from the material's.
[[nodiscard]] bool has_vertex_colours(const Mesh& mesh, const MeshPart& part);
/// The direction itself if it is of unit length, else its unit vector; where it has none, an axis.
[[nodiscard]] glm::vec3 valid_normal(const glm::vec3& normal);
/// As valid_normal(); w is 1 or -1.
[[nodiscard]] glm::vec4 valid_tangent(const glm::vec4& tangent);

} // namespace lsys
