// Pictures: which textures the materials of a file show. glTF multiplies them by the colour of the
// material. Many readers of OBJ and USDA take either a picture or a colour, so there the colour is
// in the picture, and there is one for each material.
#pragma once

#include "runtime/export/export.h"
#include "runtime/meshing/texture.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lsys {

enum class PictureKind : std::uint8_t {
    Colour,  // and opacity
    Opacity, // in all channels, as readers of MTL differ in which one they look at
    Relief,  // normals
};

struct Picture {
    PictureKind kind = PictureKind::Colour;
    MaterialKind material = MaterialKind::Bark;
    glm::vec3 tint{1.0F};                // linear
    std::shared_ptr<const Texture> file; // shown in place of that of the material's kind
    std::string name;                    // of the file for OBJ and USDA
};

/// Numbers of pictures.
struct MaterialPictures {
    std::optional<std::size_t> colour;
    std::optional<std::size_t> opacity;
    std::optional<std::size_t> relief;
};

struct Pictures {
    std::vector<Picture> list;
    std::vector<MaterialPictures> of_materials; // of the mesh
};

/// Empty for ExportPictures::None, and without ExportInfo::textures or a name for files.
[[nodiscard]] Pictures find_pictures(const Mesh& mesh, ExportPictures kind, const ExportInfo& info);

/// PNG files. Throws std::bad_alloc.
[[nodiscard]] std::vector<std::string> encode_pictures(const std::vector<Picture>& pictures,
                                                       std::uint32_t threads);

} // namespace lsys
