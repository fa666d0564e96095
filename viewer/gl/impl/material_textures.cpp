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
    constexpr int kRounds = 12; // of bisection
    for (int i = 0; i < kRounds; ++i) {
        const float middle = 0.5F * (low + high);
        (coverage(texture.texels, middle) < wanted ? low : high) = middle;
    }
    for (std::size_t i = 3; i < texture.texels.size(); i += 4) {
        texture.texels[i] = static_cast<std::uint8_t>(
            std::min(std::lround(static_cast<float>(texture.texels[i]) * high), 255L));
    }
}

TextureObject
upload(Device& device, Texture texture, GLenum format, bool cut_out, bool repeats = false) {
    TextureObject object = make_texture(device, GL_TEXTURE_2D);
    const auto levels =
        static_cast<GLsizei>(std::bit_width(std::max(texture.width, texture.height)));
    glTextureStorage2D(object.name(), levels, format, static_cast<GLsizei>(texture.width),
                       static_cast<GLsizei>(texture.height));
    const double wanted = cut_out ? coverage(texture.texels, 1.0F) : 0.0;
    for (GLsizei level = 0; level < levels; ++level) {
        glTextureSubImage2D(object.name(), level, 0, 0, static_cast<GLsizei>(texture.width),
                            static_cast<GLsizei>(texture.height), GL_RGBA, GL_UNSIGNED_BYTE,
                            texture.texels.data());
        device.add_upload(texture.texels.size());
        texture = halved(texture);
        if (cut_out) {
            keep_coverage(texture, wanted);
        }
    }
    const GLint wrap = cut_out && !repeats ? GL_CLAMP_TO_EDGE : GL_REPEAT;
    glTextureParameteri(object.name(), GL_TEXTURE_WRAP_S, wrap);
    glTextureParameteri(object.name(), GL_TEXTURE_WRAP_T, wrap);
    glTextureParameteri(object.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(object.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return object;
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
