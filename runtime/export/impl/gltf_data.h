// Kinds of arrays in glTF files, and checks of their contents.
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
    PositionChanges, // of morph targets
    NormalChanges,
    Indices,
    InverseBinds,
    Times,
    Translations,
    Rotations,
    Scales,
    MorphWeights,
    Image,
};

/// Whether vertices of a part have palette colours that differ from the material's.
[[nodiscard]] bool has_vertex_colours(const Mesh& mesh, const MeshPart& part);
/// The direction itself if it is of unit length, else its unit vector; an axis if it has no length.
[[nodiscard]] glm::vec3 valid_normal(const glm::vec3& normal);
/// As valid_normal(); w is 1 or -1.
[[nodiscard]] glm::vec4 valid_tangent(const glm::vec4& tangent);

} // namespace lsys
