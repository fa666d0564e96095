// GltfData: the layout of the buffer of a glTF file.
#pragma once

#include "runtime/export/impl/gltf_motion.h"
#include "runtime/export/impl/wind_data.h"
#include "runtime/meshing/mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

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

struct GltfView {
    GltfArray array = GltfArray::Positions;
    std::uint64_t offset = 0; // a multiple of 4
    std::uint64_t bytes = 0;
    std::size_t image = 0; // in GltfData::images
};

struct GltfData {
    std::vector<GltfView> views;
    std::vector<std::string> images; // PNG
    std::uint64_t bytes = 0;         // of the buffer, a multiple of 4
    /// Per part: whether vertices have colours that differ from the material's.
    std::vector<bool> coloured;

    /// The number of the first view of the array; views.size() without one.
    [[nodiscard]] std::size_t first_view(GltfArray array) const;
};

/// Plans the buffer, images last. Without `motion` there is no skin, without `wind` no wind data.
[[nodiscard]] GltfData plan_gltf_data(const Mesh& mesh,
                                      const GltfMotion* motion,
                                      const WindData* wind,
                                      std::vector<std::string> images);

/// Hands over the buffer in order. Normals and tangents that are not of unit length, which glTF
/// does not allow, are replaced on the way.
void write_gltf_data(const Mesh& mesh,
                     const GltfMotion* motion,
                     const WindData* wind,
                     const GltfData& data,
                     const GltfBytes& write);

} // namespace lsys
