// SPDX-License-Identifier: MIT
// Pictures: textures of the materials of a file. Readers of glTF multiply a picture by the colour
// of the material. Many readers of OBJ and USDA take either a picture or a colour, so their
// pictures contain the colour, one picture for each material.
#pragma once

#include "runtime/export/export.h"
#include "runtime/meshing/texture.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

enum class PictureKind : std::uint8_t {
    Colour,  // with opacity
    Opacity, // in all channels, because readers of MTL use different ones
    NormalMap,
};

struct Picture {
    PictureKind kind = PictureKind::Colour;
    MaterialKind material = MaterialKind::Bark;
    glm::vec3 tint{1.0F}; // linear
    std::shared_ptr<const Texture>
        file_texture; // replaces the texture of the material's kind; null: none
    std::string name; // name of the picture file, or of the image in the document
};

/// Numbers of the pictures of a material.
struct MaterialPictures {
    std::optional<std::size_t> colour;
    std::optional<std::size_t> opacity;
    std::optional<std::size_t> normal_map;
};

struct Pictures {
    std::vector<Picture> list;
    std::vector<MaterialPictures> of_materials; // by material of the mesh
};

/// Finds the pictures of the materials in use. Empty for ExportPictures::None, without
/// ExportInfo::textures, and for pictures in files if ExportInfo::picture_prefix is empty.
[[nodiscard]] Pictures find_pictures(const Mesh& mesh, ExportPictures kind, const ExportInfo& info);

/// The value rounded to six decimals, so that its text as a double has at most six decimals.
[[nodiscard]] inline double six_decimals(float value) {
    return std::round(static_cast<double>(value) * 1e6) / 1e6;
}
/// The roughness of a material as written to files, 0 to 1.
[[nodiscard]] inline double roughness(const Material& material) {
    return six_decimals(roughness_of(material));
}

/// Encodes the pictures as PNG. Throws std::bad_alloc.
[[nodiscard]] std::vector<std::string> encode_pictures(const std::vector<Picture>& pictures,
                                                       std::uint32_t threads);

} // namespace lsys
