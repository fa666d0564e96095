// SPDX-License-Identifier: MIT
#include "viewer/gl/impl/material_textures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace lsys::view {

namespace {

constexpr float kOpaque = 0.5F; // min opacity of opaque texels

/// Fraction of texels that are opaque after their opacities are scaled by `factor`.
double coverage(const std::vector<std::uint8_t>& texels, float factor) {
    std::size_t opaque_count = 0;
    for (std::size_t i = 3; i < texels.size(); i += 4) {
        opaque_count += static_cast<float>(texels[i]) / 255.0F * factor >= kOpaque ? 1U : 0U;
    }
    return 4.0 * static_cast<double>(opaque_count) / static_cast<double>(texels.size());
}

/// The next mip level; colours are means weighted by opacity.
Texture halved(const Texture& texture) {
    Texture half;
    half.width = std::max(texture.width / 2, 1U);
    half.height = std::max(texture.height / 2, 1U);
    half.texels.resize(std::size_t{4} * half.width * half.height);
    for (std::uint32_t y = 0; y < half.height; ++y) {
        for (std::uint32_t x = 0; x < half.width; ++x) {
            std::array<unsigned, 4> sum{};
            std::array<unsigned, 3> plain{};
            for (std::uint32_t k = 0; k < 4; ++k) {
                const std::uint32_t from_x = std::min(2 * x + (k & 1U), texture.width - 1);
                const std::uint32_t from_y = std::min(2 * y + (k >> 1U), texture.height - 1);
                const std::uint8_t* const texel =
                    texture.texels.data() +
                    std::size_t{4} * (std::size_t{from_y} * texture.width + from_x);
                for (std::size_t c = 0; c < 3; ++c) {
                    sum[c] += unsigned{texel[c]} * texel[3];
                    plain[c] += texel[c];
                }
                sum[3] += texel[3];
            }
            std::uint8_t* const to =
                half.texels.data() + std::size_t{4} * (std::size_t{y} * half.width + x);
            for (std::size_t c = 0; c < 3; ++c) {
                to[c] = static_cast<std::uint8_t>(sum[3] != 0 ? (sum[c] + sum[3] / 2) / sum[3]
                                                              : (plain[c] + 2) / 4);
            }
            to[3] = static_cast<std::uint8_t>((sum[3] + 2) / 4);
        }
    }
    return half;
}

/// Scales opacities so that the fraction `wanted` of the texels is opaque; otherwise leaves would
/// vanish at a distance (Castano 2010, "Computing Alpha Mipmaps").
void keep_coverage(Texture& texture, double wanted) {
    float low = 0.25F;
    float high = 8.0F;
    constexpr int kRounds = 12;
    for (int i = 0; i < kRounds; ++i) {
        const float middle = 0.5F * (low + high);
        (coverage(texture.texels, middle) < wanted ? low : high) = middle;
    }
    for (std::size_t i = 3; i < texture.texels.size(); i += 4) {
        texture.texels[i] = static_cast<std::uint8_t>(
            std::min(std::lround(static_cast<float>(texture.texels[i]) * high), 255L));
    }
}

void set_sampling(GLuint texture, bool clamps) {
    const GLint wrap = clamps ? GL_CLAMP_TO_EDGE : GL_REPEAT;
    glTextureParameteri(texture, GL_TEXTURE_WRAP_S, wrap);
    glTextureParameteri(texture, GL_TEXTURE_WRAP_T, wrap);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

/// A texture of the same memory as `texture`, as an array of one layer.
TextureObject array_of(Device& device, GLuint texture, GLenum format, bool clamps) {
    GLint levels = 0;
    glGetTextureParameteriv(texture, GL_TEXTURE_IMMUTABLE_LEVELS, &levels);
    GLuint name = 0;
    glGenTextures(1, &name);
    glTextureView(name, GL_TEXTURE_2D_ARRAY, texture, format, 0, static_cast<GLuint>(levels), 0, 1);
    TextureObject view(device, name);
    set_sampling(name, clamps);
    return view;
}

/// Makes a texture of pictures of one size. `target`: GL_TEXTURE_2D for a single picture, or
/// GL_TEXTURE_2D_ARRAY.
TextureObject upload(Device& device,
                     std::vector<Texture> layers,
                     GLenum target,
                     GLenum format,
                     bool cut_out,
                     bool repeats) {
    TextureObject object = make_texture(device, target);
    const auto width = static_cast<GLsizei>(layers.front().width);
    const auto height = static_cast<GLsizei>(layers.front().height);
    const auto levels =
        static_cast<GLsizei>(std::bit_width(std::max(layers.front().width, layers.front().height)));
    if (target == GL_TEXTURE_2D) {
        glTextureStorage2D(object.name(), levels, format, width, height);
    } else {
        glTextureStorage3D(object.name(), levels, format, width, height,
                           static_cast<GLsizei>(layers.size()));
    }
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        Texture& texture = layers[layer];
        const double wanted = cut_out ? coverage(texture.texels, 1.0F) : 0.0;
        for (GLsizei level = 0; level < levels; ++level) {
            const auto wide = static_cast<GLsizei>(texture.width);
            const auto high = static_cast<GLsizei>(texture.height);
            if (target == GL_TEXTURE_2D) {
                glTextureSubImage2D(object.name(), level, 0, 0, wide, high, GL_RGBA,
                                    GL_UNSIGNED_BYTE, texture.texels.data());
            } else {
                glTextureSubImage3D(object.name(), level, 0, 0, static_cast<GLint>(layer), wide,
                                    high, 1, GL_RGBA, GL_UNSIGNED_BYTE, texture.texels.data());
            }
            device.add_upload(texture.texels.size());
            texture = halved(texture);
            if (cut_out) {
                keep_coverage(texture, wanted);
            }
        }
        texture = {};
    }
    set_sampling(object.name(), cut_out && !repeats);
    return object;
}

TextureObject
upload(Device& device, Texture texture, GLenum format, bool cut_out, bool repeats = false) {
    std::vector<Texture> layers;
    layers.push_back(std::move(texture));
    return upload(device, std::move(layers), GL_TEXTURE_2D, format, cut_out, repeats);
}

} // namespace

int translucency_step(const Material& material, bool is_thin) {
    const float part = material.translucency.value_or(is_thin ? 0.5F : 0.0F);
    return static_cast<int>(std::lround(part * 256.0F));
}

GLuint MaterialTextures::base_colour(MaterialKind kind) {
    TextureObject& object = bases_[static_cast<std::size_t>(kind)];
    if (!object) {
        object =
            upload(*device_, material_texture(kind), GL_SRGB8_ALPHA8, kind == MaterialKind::Leaf);
    }
    return object.name();
}

GLuint MaterialTextures::bark_normals() {
    if (!normals_) {
        normals_ = upload(*device_, lsys::bark_normals(), GL_RGBA8, false);
    }
    return normals_.name();
}

GLuint MaterialTextures::base_colour_array(MaterialKind kind) {
    TextureObject& object = base_arrays_[static_cast<std::size_t>(kind)];
    if (!object) {
        object = array_of(*device_, base_colour(kind), GL_SRGB8_ALPHA8, kind == MaterialKind::Leaf);
    }
    return object.name();
}

GLuint MaterialTextures::bark_normal_array() {
    if (!normal_array_) {
        normal_array_ = array_of(*device_, bark_normals(), GL_RGBA8, false);
    }
    return normal_array_.name();
}

TextureObject MaterialTextures::make_colour_array(std::vector<Texture> layers,
                                                  bool has_holes) const {
    return upload(*device_, std::move(layers), GL_TEXTURE_2D_ARRAY, GL_SRGB8_ALPHA8, has_holes,
                  true);
}

TextureObject MaterialTextures::make_normal_array(std::vector<Texture> layers) const {
    return upload(*device_, std::move(layers), GL_TEXTURE_2D_ARRAY, GL_RGBA8, false, true);
}

TextureObject MaterialTextures::make_opaque(const Texture& picture) const {
    Texture opaque = picture;
    for (std::size_t i = 3; i < opaque.texels.size(); i += 4) {
        opaque.texels[i] = 255;
    }
    return upload(*device_, std::move(opaque), GL_SRGB8_ALPHA8, false);
}

TextureObject MaterialTextures::make_normals(const Texture& picture) const {
    return upload(*device_, picture, GL_RGBA8, false);
}

TextureObject MaterialTextures::make(const Texture& picture) const {
    return upload(*device_, picture, GL_SRGB8_ALPHA8, has_holes(picture), true);
}

} // namespace lsys::view
