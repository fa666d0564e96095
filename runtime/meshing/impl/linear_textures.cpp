// SPDX-License-Identifier: MIT
#include "runtime/meshing/impl/linear_textures.h"

#include "runtime/meshing/impl/raster.h"
#include "runtime/meshing/texture.h"

#include <algorithm>
#include <array>

namespace lsys {

namespace {

constexpr std::uint8_t kHalfOpaque = 128;

/// Linear value of an sRGB value from 0 to 1 (IEC 61966-2-1). Computes the power by Newton's
/// method, because the last bits of pow() differ between libraries.
double linear_of(double value) {
    if (value <= 0.04045) {
        return value / 12.92;
    }
    const double base = (value + 0.055) / 1.055;
    const double square = base * base;
    double root = 1.0; // approaches the fifth root of `square`
    for (int i = 0; i < 60; ++i) {
        const double fourth = root * root * root * root;
        root -= (fourth * root - square) / (5.0 * fourth);
    }
    return square * root;
}

/// sRGB tables: the linear value of each byte, and the thresholds from which a linear value rounds
/// to the next byte.
struct SrgbTables {
    std::array<float, 256> linear{};
    std::array<float, 255> thresholds{};

    SrgbTables() {
        for (std::size_t i = 0; i < linear.size(); ++i) {
            linear[i] = static_cast<float>(linear_of(static_cast<double>(i) / 255.0));
        }
        for (std::size_t i = 0; i < thresholds.size(); ++i) {
            thresholds[i] = static_cast<float>(linear_of((static_cast<double>(i) + 0.5) / 255.0));
        }
    }
    [[nodiscard]] std::uint8_t byte(float value) const {
        return static_cast<std::uint8_t>(
            std::upper_bound(thresholds.begin(), thresholds.end(), value) - thresholds.begin());
    }
};
const SrgbTables& srgb_tables() {
    static const SrgbTables table;
    return table;
}

LinearTexture linear_texture(const Texture& texture) {
    LinearTexture result{texture.width, texture.height, {}, {}};
    for (std::size_t i = 0; i + 3 < texture.texels.size(); i += 4) {
        const bool is_opaque = texture.texels[i + 3] >= kHalfOpaque;
        result.texels.push_back({texture.texels[i], texture.texels[i + 1], texture.texels[i + 2],
                                 static_cast<std::uint8_t>(is_opaque ? 255 : 0)});
        result.opaque.push_back(is_opaque ? 1 : 0);
    }
    return result;
}

} // namespace

glm::vec4 LinearTexture::at(const glm::vec2& place) const {
    if (texels.empty()) {
        return glm::vec4(1.0F);
    }
    const std::array<std::uint8_t, 4>& texel =
        texels[texel_number(place.x, place.y, width, height)];
    const std::array<float, 256>& linear = srgb_tables().linear;
    return {linear[texel[0]], linear[texel[1]], linear[texel[2]], texel[3] != 0 ? 1.0F : 0.0F};
}

bool LinearTexture::is_opaque(const glm::vec2& place) const {
    return opaque.empty() || opaque[texel_number(place.x, place.y, width, height)] != 0;
}

const LinearTexture& LinearTextures::texture_of(const Material& material) {
    static const LinearTexture none;
    static const LinearTexture bark = linear_texture(material_texture(MaterialKind::Bark));
    static const LinearTexture leaf = linear_texture(material_texture(MaterialKind::Leaf));
    if (!material.textured) {
        return none;
    }
    if (material.picture == nullptr) {
        return material.kind == MaterialKind::Bark   ? bark
               : material.kind == MaterialKind::Leaf ? leaf
                                                     : none;
    }
    const auto found = files_.find(material.picture);
    return found != files_.end()
               ? found->second
               : files_.emplace(material.picture, linear_texture(*material.picture)).first->second;
}

std::uint8_t nearest_srgb_byte(float linear) {
    return srgb_tables().byte(linear);
}

} // namespace lsys
