// SPDX-License-Identifier: MIT
// MaterialTextures: the textures of runtime/meshing/texture.h on the device, each made on first
// use.
#pragma once

#include "runtime/meshing/texture.h"
#include "viewer/gl/impl/objects.h"

#include <array>
#include <vector>

namespace lsys::view {

/// Fraction, in 1/256, of the light from behind that passes through a material. `is_thin`: half of
/// the light passes if the material sets no translucency.
[[nodiscard]] int translucency_step(const Material& material, bool is_thin);

class MaterialTextures {
public:
    explicit MaterialTextures(Device& device) : device_(&device) {}

    /// Colour texture of a kind of material. Precondition: has_texture(kind).
    [[nodiscard]] GLuint base_colour(MaterialKind kind);
    [[nodiscard]] GLuint bark_normals();
    /// base_colour() and bark_normals() as array textures of one layer.
    [[nodiscard]] GLuint base_colour_array(MaterialKind kind);
    [[nodiscard]] GLuint bark_normal_array();
    /// Makes the texture of a picture file. If the picture has transparent texels, all mip levels
    /// have the same fraction of opaque texels.
    [[nodiscard]] TextureObject make(const Texture& picture) const;
    /// Makes the texture of a picture file without its opacity: all texels are opaque.
    [[nodiscard]] TextureObject make_opaque(const Texture& picture) const;
    /// Makes the texture of a normal map from a file.
    [[nodiscard]] TextureObject make_normals(const Texture& picture) const;
    /// Makes array textures of pictures of equal size. `has_holes`: texels may be transparent; then
    /// all mip levels of a layer have the same fraction of opaque texels.
    [[nodiscard]] TextureObject make_colour_array(std::vector<Texture> layers,
                                                  bool has_holes) const;
    [[nodiscard]] TextureObject make_normal_array(std::vector<Texture> layers) const;

private:
    Device* device_;
    std::array<TextureObject, 4> bases_; // by MaterialKind
    TextureObject normals_;
    std::array<TextureObject, 4> base_arrays_; // views of bases_
    TextureObject normal_array_;
};

} // namespace lsys::view
