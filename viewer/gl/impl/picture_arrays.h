// SPDX-License-Identifier: MIT
// PictureArrays: the pictures of the materials of a forest as layers of array textures, so that one
// draw call draws the branches of many materials. Layers repeat like single textures do.
#pragma once

#include "viewer/gl/impl/material_textures.h"
#include "viewer/gl/impl/objects.h"
#include "viewer/scene/forest_model.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace lsys::view {

/// The pictures of a material; one of them may be null.
struct MaterialPictures {
    std::shared_ptr<const Texture> colour;
    std::shared_ptr<const Texture> normal_map;

    friend bool operator==(const MaterialPictures&, const MaterialPictures&) = default;
};

/// Pictures that are drawn by one program.
struct PictureArray {
    std::vector<MaterialPictures> layers;
    std::uint32_t width = 0; // texels of a layer
    std::uint32_t height = 0;
    bool has_holes = false;       // pictures may have transparent texels
    bool has_normal_maps = false; // each layer has a normal map
    TextureObject colours;        // empty: there are only normal maps
    TextureObject normal_maps;
};

/// Max layers of an array: the index of a layer has 4 bits in shaders/branch.frag.glsl.
inline constexpr std::size_t kMaxPictureLayers = 16;

/// Arranges pictures in arrays, whose textures are empty. Pictures with holes or normal maps and
/// those without are in different arrays. A picture becomes as large as the layers of an array if
/// no side grows by more than half and the layer by no more than 1 MiB.
[[nodiscard]] std::vector<PictureArray> arrange_pictures(std::vector<MaterialPictures> pictures);

/// A texture enlarged to `width` x `height` texels by bilinear interpolation of a repeated texture;
/// colours are means weighted by opacity.
[[nodiscard]] Texture enlarged(const Texture& texture, std::uint32_t width, std::uint32_t height);

class PictureArrays {
public:
    struct Place {
        std::size_t array = 0; // index in arrays()
        std::uint32_t layer = 0;
    };

    /// Makes the arrays for all materials of a forest. Arrays that do not change are kept.
    void upload(const ForestModel& model, const MaterialTextures& textures);
    /// The layer of a material; nullopt: it has no pictures.
    [[nodiscard]] std::optional<Place> place_of(const Material& material) const;
    [[nodiscard]] const std::vector<PictureArray>& arrays() const { return arrays_; }
    /// Bytes of memory of the textures.
    [[nodiscard]] std::uint64_t texture_bytes() const { return texture_bytes_; }

private:
    std::vector<PictureArray> arrays_;
    std::uint64_t texture_bytes_ = 0;
};

} // namespace lsys::view
