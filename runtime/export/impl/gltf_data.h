// SPDX-License-Identifier: MIT
// Kinds of arrays in glTF files, and checks of their contents.
#pragma once

#include "runtime/meshing/mesh.h"

#include <glm/geometric.hpp>

#include <cmath>
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
    Items,           // numbers of Mesh::segments
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
/// Whether a vector has length 1, up to 0.0005: a tenth of what the glTF validator tolerates.
[[nodiscard]] inline bool is_unit(const glm::vec3& v) {
    return std::abs(glm::dot(v, v) - 1.0F) < 1e-3F;
}
/// The unit vector of a direction; +Y if it has no length.
[[nodiscard]] glm::vec3 unit_normal(const glm::vec3& normal);
/// Like unit_normal(), but +X for a direction without length; w is 1 or -1.
[[nodiscard]] glm::vec4 unit_tangent(const glm::vec4& tangent);

/// The normal itself if it has unit length, else unit_normal(). Inline, because nearly all normals
/// have unit length.
[[nodiscard]] inline glm::vec3 valid_normal(const glm::vec3& normal) {
    return is_unit(normal) ? normal : unit_normal(normal);
}
/// Like valid_normal(); w is 1 or -1.
[[nodiscard]] inline glm::vec4 valid_tangent(const glm::vec4& tangent) {
    const bool valid = is_unit(glm::vec3(tangent)) && std::abs(tangent.w) == 1.0F;
    return valid ? tangent : unit_tangent(tangent);
}

} // namespace lsys
